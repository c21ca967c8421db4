// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"

#include <map>

namespace sprag
{
  /// A rigid obstacle below the lever's face, in two dimensions. FaceContact enters it with a step, then with one patch after the
  /// other, by their indices in `face`. A point has four coordinates: its displacement along xi and eta, the rotation, and the
  /// position of the obstacle.
  class RigidObstacle
  {
  public:
    /// `face`, the lever's patches, and `properties` must outlive the obstacle.
    RigidObstacle(const FrictionFace<2> &lever, const FacePatches<2> &face, const FaceContactProperties &properties);

    /// Sets the configurations of all that follows; for steady sliding beginning and end are one.
    void enter(const StepPlaces &places);

    /// Patches within reach at the end of the step, and where the step's mean counts at its beginning as well; at least one that
    /// is closest up to the margin, 0.02 of its length.
    FacePatches<2>::Indices near() const;

    /// Sets the patch of all that follows.
    void enter(unsigned int patch);

    /// Gives a point of the patch its position and gap, and makes it that of step() and slide(). Returns whether the obstacle can
    /// touch it.
    bool place(FacePointState<2> &state);

    /// Returns the gap of a point of the patch, by its index in the face, at the beginning of the step [mm].
    double gap_at_begin(unsigned int point) const;

    /// Response of the point placed last to the step, and its forces.
    void step(FacePointState<2> &state, const ContactMemory &memory, const FaceStep &step, ContactSums &sums);

    /// Forces of the point placed last, in contact, that slides steadily.
    void slide(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums);

    /// Adds the forces of the patch, if it has any.
    void leave(ContactSums &sums);

    /// Returns the rows of a point of the patch at the end of the step.
    FacePointRows rows(const FacePointState<2> &state) const;

    /// Slip of a point of the patch from one configuration to the other of the step [mm].
    double slip(const FacePointState<2> &state) const;

  private:
    static constexpr unsigned int n_local     = 2 * FacePatches<2>::max_nodes + 2;
    static constexpr unsigned int theta_index = 2 * FacePatches<2>::max_nodes;
    static constexpr unsigned int x_index     = theta_index + 1;
    using Local                               = dealii::Tensor<1, n_local>;
    using LocalMatrix                         = dealii::Tensor<2, n_local>;

    /// A point where a step begins.
    struct BeginPoint
    {
      dealii::Point<2> position;
      double gap;
      double slip;
    };

    FacePatches<2>::Indices near(const FaceConfiguration &at, const PlacedObstacle &obstacle) const;
    void enter_begin(const FaceConfiguration &at);
    const std::vector<BeginPoint> &points_at_begin(unsigned int patch_index);
    const BeginPoint &at_begin(unsigned int point) const;
    StepKinematics<4> over_step(const FacePointState<2> &state, double slip_change) const;
    using Slopes = std::array<double, FacePatches<2>::max_nodes>;

    dealii::Tensor<1, 4> face_direction(unsigned int point) const;
    void add_slope(unsigned int point, double traction_by_slope);
    static Local spread(const FacePatches<2>::Point &point, const dealii::Tensor<1, 4> &row);
    void add_force(const FacePatches<2>::Point &point, const dealii::Tensor<1, 4> &force);
    void add_tangent(const FacePatches<2>::Point &point, const dealii::Tensor<2, 4> &point_tangent, LocalMatrix &sum) const;
    PortCoordinates ports() const;

    const FacePatches<2> &face;
    const FaceContactProperties &properties;
    std::vector<Slopes> slopes; ///< of the shapes of a point's nodes along xi [1/mm]
    StepPlaces places{};
    PlacedObstacle end;
    PlacedObstacle balance; ///< where forces are not those at the end
    unsigned int patch = 0;
    FacePatches<2>::Nodal at_end{};
    LeverPoint last_place{};       ///< of the point placed last
    ContactKinematics<4> placed{}; ///< of it, once step() or slide() need it

    // State at the begin of the step, the same in all its iterations.
    FaceConfiguration begin_configuration{};
    PlacedObstacle begin;
    dealii::Vector<double> known_begin;
    FacePatches<2>::Indices near_begin;
    std::map<unsigned int, std::vector<BeginPoint>> begin_points; ///< by patches

    // State of the patch at hand.
    const std::vector<BeginPoint> *patch_begin_points = nullptr; ///< none where beginning and end are one
    bool touched                                      = false;
    Local values;
    LocalMatrix tangent;
    FrictionParts<LocalMatrix> friction;
  };
} // namespace sprag
