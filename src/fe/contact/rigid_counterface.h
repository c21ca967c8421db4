// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"

namespace sprag
{
  /// A rigid counterface below the lever's face, in two dimensions. FaceContact sets a step, see set_places(), then one element
  /// after the other, by their indices in `face`. A point has four coordinates: its displacement along xi and eta, the rotation,
  /// and the position of the counterface.
  class RigidCounterface
  {
  public:
    /// `face`, the lever's elements, and `properties` must outlive the counterface.
    RigidCounterface(const FrictionFace<2> &lever, const FaceElements<2> &face, const FaceProperties<2> &properties);

    /// Sets the configurations of all that follows; for steady sliding beginning and end are one. `begins_anew`: the beginning is
    /// another than that of the last step.
    void set_places(const StepPlaces &places, bool begins_anew);

    // Elements near the counterface at the end of the step and at its beginning; at least one that is closest up to the margin,
    // 0.02 of its length.
    FaceElements<2>::Indices near_end() const
    {
      return near(places.end, end);
    }
    FaceElements<2>::Indices near_begin() const
    {
      return near(places.begin, begin);
    }

    /// Sets the element of all that follows.
    void begin_element(unsigned int element);

    /// Gives a point of the element its position and gap, and makes it that of step() and slide(). Returns whether the
    /// counterface can touch it.
    bool place(FacePointState<2> &state);

    /// Returns the gap of a point of the element, by its index in the face, at the beginning of the step [mm].
    double gap_at_begin(const unsigned int point) const
    {
      return moves ? begin_points[point].gap : placed.gap;
    }

    /// Response of the point placed last to the step, and its forces.
    void step(FacePointState<2> &state, const ContactHistory &history, const FaceStep &step, ContactSums &sums);

    /// Forces of the point placed last, in contact, that slides steadily.
    void slide(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums);

    /// Adds the forces of the element, if it has any.
    void end_element(ContactSums &sums);

    /// Returns the rows of a point of the element at the end of the step.
    FacePointRows rows(const FacePointState<2> &state) const;

    /// Slip of a point of the element from one configuration to the other of the step [mm].
    double slip(const FacePointState<2> &state) const;

  private:
    static constexpr unsigned int n_local     = 2 * FaceElements<2>::max_nodes + 2;
    static constexpr unsigned int theta_index = 2 * FaceElements<2>::max_nodes;
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

    FaceElements<2>::Indices near(const FaceConfiguration &at, const PlacedCounterface &counterface) const;
    void find_begin_points(unsigned int element_index);
    StepKinematics<4> over_step(const FacePointState<2> &state, double slip_change) const;
    using Slopes = std::array<double, FaceElements<2>::max_nodes>;

    dealii::Tensor<1, 4> face_direction(unsigned int point) const;
    void add_slope(unsigned int point, double traction_by_slope);
    static Local spread(const FaceElements<2>::Point &point, const dealii::Tensor<1, 4> &row);
    void add_force(const FaceElements<2>::Point &point, const dealii::Tensor<1, 4> &force);
    static void add_tangent(const FaceElements<2>::Point &point, const dealii::Tensor<2, 4> &point_tangent, LocalMatrix &sum);
    InterfaceCoordinates interface_coordinates() const;

    const FaceElements<2> &face;
    const FaceProperties<2> &properties;
    std::vector<Slopes> slopes; ///< of the shapes of a point's nodes along xi [1/mm]
    StepPlaces places{};
    PlacedCounterface end;
    PlacedCounterface balance; ///< where forces are not those at the end
    unsigned int element = 0;
    FaceElements<2>::Nodal at_end{};
    ContactKinematics<4> placed{}; ///< of the point placed last

    // State at the begin of the step, the same in all its iterations.
    PlacedCounterface begin;
    std::vector<BeginPoint> begin_points; ///< those of the elements that were met
    std::vector<bool> is_begun;           ///< whether an element was met
    bool moves = false;                   ///< whether beginning and end differ

    // State of the present element.
    bool has_forces = false;
    Local values;
    LocalMatrix tangent;
    FrictionParts<LocalMatrix> friction;
  };
} // namespace sprag
