#pragma once

#include "fe/face_step_point.h"

namespace sprag
{
  /// What FaceStep sees of a rigid cylinder below the lever's face. Per point: displacement along xi and eta, rotation, position
  /// of the circle.
  class CircleSurface
  {
  public:
    /// `face` must outlive the surface.
    CircleSurface(const ElasticBody<2> &body, const FacePatches &face, const FaceStepProperties &properties);

    /// Sets the configurations of all that follows; for steady sliding beginning and end are one.
    void enter(const FaceStepPlaces &places);

    /// Patches within reach in one of the configurations.
    FacePatches::Range near() const;

    /// Sets the patch of all that follows.
    void enter(unsigned int patch);

    /// Gives a point of the patch its position and gap. Returns the gap at the beginning of the step.
    double place(FacePointState &state) const;

    /// Response of a point in contact to the step, and its forces. `surface_run` [mm]: of the cylinder by turning.
    void step(FacePointState &state, double begin_gap, const ContactMemory &memory, const StepContactLaw &law, double surface_run,
              FaceStepSums &sums);

    /// Of a point in contact that slides steadily.
    void slide(FacePointState &state, const SlidingState &sliding, const FrictionLaw &law, FaceStepSums &sums);

    /// Adds the forces of the patch, if it has any.
    void leave(FaceStepSums &sums);

    /// At the end of the step.
    FacePointRows rows(const FacePointState &state) const;

    /// Slip of a point of the patch from one configuration to the other of the step [mm].
    double slip(const FacePointState &state) const;

  private:
    static constexpr unsigned int n_local     = 2 * FacePatches::max_nodes + 2;
    static constexpr unsigned int theta_index = 2 * FacePatches::max_nodes;
    static constexpr unsigned int x_index     = theta_index + 1;

    void add(const FacePatches::Point &point, const dealii::Tensor<1, 4> &force, const dealii::Tensor<2, 4> &tangent);
    std::vector<FaceCoordinate> ports() const;

    const FacePatches &face;
    const FaceStepProperties &properties;
    FaceStepPlaces places{};
    double balance_theta = 0.;
    double balance_x     = 0.;
    unsigned int patch   = 0;
    FacePatches::Nodal at_begin{};
    FacePatches::Nodal at_end{};

    // Of the patch.
    bool touched = false;
    double values[n_local]{};
    double tangents[n_local][n_local]{};
  };
} // namespace sprag
