#pragma once

#include "fe/solid/step_in_lanes.h"

namespace sprag
{
  using dealii::Tensor;

  struct StepInLanes::Block
  {
    PointsInLanes position; ///< undeformed
    Lanes weight;           ///< 0 beyond the patch's last point
    SomeLanes<Patches::max_nodes> shapes;
    SomeLanes<Patches::max_nodes> slopes; ///< of the shapes along xi [1/mm]
    unsigned int first;                   ///< point
    unsigned int n;                       ///< of points
    double clear_until;                   ///< length of the patch's travel until which no point comes to the cylinder [mm]
    bool is_clear;                        ///< as the patch was pressed last: nothing was computed
  };

  struct StepInLanes::Begin
  {
    PointsInLanes place;
    Lanes gap;
    Lanes right, upward, along; ///< parts of the place in the cylinder's axes
    LaneMask known;             ///< whether the point remembers a contact
    TwoLanes traction;
    TwoLanes slip_speed;
    Lanes step;
    Lanes multiplier;                     ///< of the gap [MPa]
    Lanes shift, elastic_shift, by_slope; ///< see SlipShift; with a slope of 0
    bool is_placed;                       ///< else the rest is unknown
    bool touches;                         ///< a point does, or remembers a contact
  };

  struct StepInLanes::End
  {
    PointsInLanes place;
    Lanes gap;
    LaneMask takes_part;
    Lanes pressure;
    TwoLanes slip_change;
    FrictionInLanes friction;
    Lanes mean_pressure; ///< of the step
    TwoLanes mean_traction;
    Lanes shift;             ///< of the slip round the cylinder, without its elastic part [mm]
    PointsInLanes direction; ///< of the deformed face along xi, in the axes of the world
  };

  /// A block of a patch as it was pressed last. Where it is clear, begin and end are unknown.
  struct StepInLanes::Pressed
  {
    const Block &block;
    const Begin &begin;
    const End &end;

    SPRAG_PART bool takes_part() const
    {
      return !block.is_clear && any(end.takes_part);
    }
  };

  SPRAG_PART StepInLanes::Pressed StepInLanes::pressed(const unsigned int patch, const unsigned int b) const
  {
    const auto &of_patch = blocks[patch];
    return { of_patch.all[b], begins[of_patch.first + b], ends[of_patch.first + b] };
  }

  /// Linear unilateral spring, see mean_normal_force().
  SPRAG_PART Lanes pressure_of(const double stiffness, const Lanes &gap)
  {
    return gap < 0. ? -stiffness * gap : Lanes{};
  }

  SPRAG_PART Lanes mean_pressure_of(const double stiffness, const Lanes &begin, const Lanes &end)
  {
    const Lanes p_begin = pressure_of(stiffness, begin), p_end = pressure_of(stiffness, end);
    const Lanes change   = end - begin;
    const Lanes by_end   = (p_begin + 4. * pressure_of(stiffness, 0.5 * (begin + end)) + p_end) / 6.;
    const LaneMask small = (absolute(change) < 1e-3 * larger(-begin, -end)) | (change == 0.);
    const Lanes quotient = 0.5 / stiffness * (p_begin * p_begin - p_end * p_end) / (small ? all_lanes(1.) : change);
    return small ? by_end : quotient;
  }

  SPRAG_PART Lanes d_mean_pressure_of(const double stiffness, const Lanes &begin, const Lanes &end)
  {
    const auto slope     = [stiffness](const Lanes &gap) { return gap < 0. ? all_lanes(-stiffness) : Lanes{}; };
    const Lanes change   = end - begin;
    const LaneMask small = (absolute(change) < 1e-3 * larger(-begin, -end)) | (change == 0.);
    const Lanes quotient =
        (pressure_of(stiffness, end) - mean_pressure_of(stiffness, begin, end)) / (small ? all_lanes(1.) : change);
    return small ? (2. * slope(0.5 * (begin + end)) + slope(end)) / 6. : quotient;
  }

  /// A vector along the axes of the lever.
  SPRAG_PART PointsInLanes in_lever(const PointsInLanes &a, const double c, const double s)
  {
    return { s * a.y - c * a.x, s * a.x + c * a.y, a.z };
  }

  /// How a point moves with theta.
  SPRAG_PART PointsInLanes with_theta(const PointsInLanes &at, const double c, const double s)
  {
    return { at.x * s + at.y * c, at.x * c - at.y * s, Lanes{} };
  }

  SPRAG_PART PointsInLanes at_points(const SomeLanes<FacePatches<3>::max_nodes> &shapes, const PointsInLanes &position,
                                     const FacePatches<3>::Nodal &displacement)
  {
    PointsInLanes result = position;
    for (unsigned int a = 0; a < FacePatches<3>::max_nodes; ++a)
    {
      result.x += shapes[a] * displacement[3 * a];
      result.y += shapes[a] * displacement[3 * a + 1];
      result.z += shapes[a] * displacement[3 * a + 2];
    }
    return result;
  }

  /// The force of a pressure and of tractions on a point, in the axes of the world.
  SPRAG_PART PointsInLanes force_of(const PlacesInLanes &place, const Tensor<1, 3> &axis, const double radius,
                                    const Lanes &pressure, const TwoLanes &traction)
  {
    const PointsInLanes round = cross(axis, place.normal);
    return pressure * place.normal - (traction[0] * radius / place.radius) * round -
           times(traction[1] - pressure * place.profile_slope, axis);
  }
} // namespace sprag
