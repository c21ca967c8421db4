#pragma once

#include "fe/face_pair_rows.h"
#include "fe/face_step_point.h"

#include <map>

namespace sprag
{
  /// What FaceStep sees of an elastic cylinder below the lever's face, the interface of CircleSurface. Points of the friction
  /// face are facets, see FacePair.
  class PairSurface
  {
  public:
    /// `face` must outlive the surface.
    PairSurface(const ElasticBody<2> &body, const FacePatches &face, const FaceStepProperties &properties);

    void enter(const FaceStepPlaces &places);
    FacePatches::Range near() const;
    void enter(unsigned int patch);
    double place(FacePointState &state) const;
    void step(FacePointState &state, double begin_gap, const ContactMemory &memory, const StepContactLaw &law, double surface_run,
              FaceStepSums &sums);
    void slide(FacePointState &state, const SlidingState &sliding, const FrictionLaw &law, FaceStepSums &sums);
    void leave(FaceStepSums &sums);
    FacePointRows rows(const FacePointState &state);
    double slip(const FacePointState &state) const;

  private:
    struct Side
    {
      PairConfiguration at;
      PatchFacets of;
    };

    void enter_begin(const FaceConfiguration &at);
    void enter_balance(const FaceStepPlaces &places);
    const PatchFacets &facets_at_begin();
    void touch();
    void add_force(double weight, double normal, double along_slip, const FacetRows &rows);
    dealii::Tensor<1, 4> on_lever(double normal, double along_slip, const FacetRows &rows) const;
    std::vector<FaceCoordinate> ports() const;
    dealii::Vector<double> change(const dealii::Vector<double> &from, const dealii::Vector<double> &to) const;

    const FacePatches &face;
    const FaceStepProperties &properties;
    const FacePair pair;
    Side end;
    bool moves = false; ///< whether end is not beginning and balance as well

    // Where it moves.
    Side of_balance;
    dealii::Vector<double> between; ///< displacements at the balance
    PairConfiguration of_begin;
    dealii::Vector<double> known_begin;
    FacePatches::Range near_begin{ 0, 0 };
    std::map<unsigned int, PatchFacets> begin_facets; ///< by patches

    // Of the patch.
    unsigned int patch = 0;
    unsigned int first = 0;     ///< of its points
    FacePatches::Nodal nodal{}; ///< its displacements at the end
    const PatchFacets *at_begin = nullptr;
    bool touched                = false;
    bool at_end_of_face         = false;
    PairCoordinates coordinates;
    FacetRows end_rows, balance_rows;
    dealii::Vector<double> force_row; ///< derivative of a force
    dealii::Vector<double> movement;  ///< in the step
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
  };
} // namespace sprag
