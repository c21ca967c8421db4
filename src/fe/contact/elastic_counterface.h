// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/contact_face.h"
#include "fe/contact/face_pair_rows.h"

#include <map>

namespace sprag
{
  /// The places where a step begins and ends, and the share of it at which forces are balanced.
  struct StepPlaces
  {
    FaceConfiguration begin;
    FaceConfiguration end;
    double balance  = 1.;
    bool static_end = false; ///< without inertia: forces are those of the end, whatever was before

    /// Returns whether beginning and end differ.
    bool moves() const
    {
      return begin.displacement != end.displacement || begin.x != end.x;
    }

    /// Returns whether the end is all that counts for the forces.
    bool balanced_at_end() const
    {
      return static_end || !moves();
    }

    double balanced(const double at_begin, const double at_end) const
    {
      return (1. - balance) * at_begin + balance * at_end;
    }
  };

  /// Contact with an elastic cylinder below the lever's face; functions that FaceContact has as well are as there. The points of
  /// the friction face are facets, see FacePair: pressure and traction are those of the facet's mean gap and slip. The dofs of
  /// the cylinder's nodes follow those of the lever's. Elements and points are indices in `face`.
  class ElasticCounterface
  {
  public:
    using Indices = FaceElements<2>::Indices;

    /// All must outlive the counterface; `face` are the lever's elements.
    ElasticCounterface(const FrictionFace<2> &lever, const FrictionFace<2> &cylinder, const FaceElements<2> &face,
                       const FaceCandidates<2> &candidates, const FaceProperties &properties);

    void evaluate(const InterfaceStep &step, FaceEvaluation<2> &found, const std::optional<StaticTerms> &statics);

    void evaluate_sliding(const SlidingState &sliding, FaceEvaluation<2> &found)
    {
      slide(sliding, false, found);
    }

    /// Friction delays at each point in contact.
    LinearisedForces linearise(const SlidingState &sliding, FaceEvaluation<2> &found);

    void touch(const dealii::Vector<double> &displacements, const DrivePoint &drive, FaceEvaluation<2> &found);
    double gap_change(const FacePointState<2> &point, const FaceEvaluation<2> &found, const dealii::Vector<double> &moved);
    double mean_slip(const FaceEvaluation<2> &found, const dealii::Vector<double> &from, double from_x,
                     const dealii::Vector<double> &to, double to_x);

  private:
    /// The facets of an element at one end of the step.
    struct Side
    {
      PairConfiguration at;
      ElementFacets element_facets;
      double first_slip = 0.; ///< slip coordinate of the cylinder's first node without load [mm]
    };

    /// A step, and the history of the points in contact where it begins, by increasing point.
    struct FaceStep : StepTerms
    {
      const std::vector<ContactHistory> &history;
    };

    /// Friction's part of the tangent of an element that slides steadily, where it is wanted apart; see LinearisedForces.
    struct FrictionParts
    {
      dealii::FullMatrix<double> by_displacement;
      dealii::FullMatrix<double> by_velocity;
      std::vector<FrictionDelay> delays; ///< at the interface of the element
    };

    void slide(const SlidingState &sliding, bool in_parts, FaceEvaluation<2> &found);
    void set_places(const StepPlaces &places);
    void begin_element(unsigned int element);
    FacePointState<2> &add_point(unsigned int point, FaceEvaluation<2> &found) const;
    void step_element(const FaceStep &step, FaceEvaluation<2> &found);
    void step(FacePointState<2> &state, const ContactHistory &history, const FaceStep &step, ContactSums &sums);
    void slide_point(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums);
    void end_element();
    double slip(const FacePointState<2> &state);

    double first_slip(const FaceConfiguration &at) const;
    double undeformed_slip(const FaceConfiguration &at, const dealii::Point<2> &place) const;
    Indices near(const PairConfiguration &at) const;
    const ElementFacets &facets_at_begin(unsigned int element_index);
    double slip_at_begin(unsigned int point);

    double slip_at_end(const unsigned int point) const
    {
      return slip_coordinate(facet_at_end(point), places.end, end.first_slip, point);
    }

    double slip_coordinate(const Facet &facet, const FaceConfiguration &at, double slip_offset, unsigned int point) const;
    std::array<unsigned int, 2> neighbours(unsigned int point) const;
    double distance(unsigned int from, unsigned int to) const;
    double slope(unsigned int point) const;
    void prepare_sums();

    const Facet &facet_at_end(const unsigned int point) const
    {
      return end.element_facets.facets[point - first];
    }

    void add_tangent(const StepResponse<2> &response, const Facet &facet, double stretch, double run, double end_stretch);
    void add_shift(const Facet &facet, unsigned int point, const SlipShift &shift, double d_shift);
    dealii::Tensor<1, 4> on_lever(double normal, double along_slip, const FacetRows &rows) const;
    InterfaceCoordinates interface_coordinates() const;
    dealii::Vector<double> change(const dealii::Vector<double> &from, const dealii::Vector<double> &to) const;

    const FrictionFace<2> &lever_face;
    const FaceElements<2> &face;
    const FaceCandidates<2> &candidates;
    const FaceProperties &properties;
    const FacePair pair;
    const dealii::Point<2> first_node; ///< of the cylinder's face, about its centre
    StepPlaces places{};
    Side end;

    // State at the balance, if the forces of a step are those between its ends.
    Side balance_side;
    dealii::Vector<double> between; ///< displacements at the balance

    // State at the begin of the step, the same in all its iterations.
    StepBegin begin;
    Side begin_side;
    std::map<unsigned int, ElementFacets> begin_facets; ///< by elements

    // State of the present element.
    unsigned int element = 0;
    unsigned int first   = 0;       ///< of its points
    FaceElements<2>::Nodal nodal{}; ///< its displacements at the end
    bool has_forces  = false;
    bool at_face_end = false;
    PairCoordinates coordinates;
    FacetRows end_rows, balance_rows, at_left, at_right;
    dealii::Vector<double> force_row; ///< derivative of a force
    dealii::Vector<double> movement;  ///< in the step
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
    FrictionParts friction;

    // Sums over the elements of an evaluation.
    double force_on_cylinder = 0.;       ///< generalised, of the position x, in the step [N]
    std::vector<InterfaceForces> loaded; ///< dofs in any order
    bool in_parts = false;               ///< whether steady sliding gives its tangent in parts
    std::vector<LinearisedForces> parts; ///< of the elements loaded
  };
} // namespace sprag
