// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact_point.h"
#include "laws/friction.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  Obstacle cylinder(const Geometry &geometry)
  {
    return [geometry](const double x, const double theta)
    {
      const auto circle = placed_for_points(geometry, x, theta);
      return PlacedObstacle([circle](const LeverPoint &point) { return moving_circle_contact(circle, point); },
                            [circle](const LeverPoint &point) { return circle_gap(circle, point); });
    };
  }

  void set_cylinder(const Geometry &geometry, FaceContactProperties &properties)
  {
    properties.obstacle = cylinder(geometry);
    properties.centre   = [geometry](const double x, const double theta) { return cylinder_centre(geometry, x, theta); };
    properties.radius   = geometry.cylinder_radius;
  }

  ContactMemory FaceStep::memory_of(const unsigned int point) const
  {
    const auto is_before = [](const ContactMemory &entry, const unsigned int q) { return entry.point < q; };
    const auto found     = std::lower_bound(memory.begin(), memory.end(), point, is_before);
    return found != memory.end() && found->point == point ? *found : ContactMemory{};
  }

  SlipShift slip_shift(const FacePatches<2> &face, const unsigned int point, const double slope, const FaceStep &step,
                       const std::function<double(unsigned int)> &slip_at_begin)
  {
    const auto &points = face.points;
    const double xi    = points[point].position[0] - step.travel;
    if (step.travel == 0. || xi < points.front().position[0] || xi > points.back().position[0])
      return {};
    const auto after    = std::upper_bound(points.begin() + 1, points.end() - 1, xi,
                                           [](const double value, const auto &at) { return value < at.position[0]; });
    const auto i        = static_cast<unsigned int>(after - points.begin());
    const double before = (after - 1)->position[0];
    const double share  = (xi - before) / (after->position[0] - before);
    const auto between  = [share](const double a, const double b) { return (1. - share) * a + share * b; };
    const double slip   = slip_at_begin(point) - between(slip_at_begin(i - 1), slip_at_begin(i)) - step.travel * slope;
    const double unwinding =
        between(step.memory_of(i - 1).traction[0], step.memory_of(i).traction[0]) - step.memory_of(point).traction[0];
    return { slip, step.augmented ? 0. : unwinding / step.law.slip.stiffness, -step.travel };
  }

  SlidingTangent slide(const FaceContactProperties &properties, const FrictionLaw &law, const SlidingState &sliding,
                       const double weight, FacePointState<2> &state, ContactSums &sums)
  {
    const auto &penalty        = properties.penalties;
    const bool slides          = sliding.friction == ContactFriction::sliding;
    const double speed         = state.slip_change[0];
    const auto share           = slides ? sliding_friction(law, speed) : SlidingFriction{};
    state.pressure             = -penalty.normal * state.gap;
    state.traction[0]          = share.coefficient * state.pressure;
    state.mu                   = slides ? friction_coefficient(law, std::abs(speed)).coefficient : 0.;
    state.slipping             = slides;
    state.memory.traction      = state.traction;
    state.memory.slip_speed[0] = sliding.speed;
    state.memory.point         = state.index;
    state.elastic_slip         = state.traction.norm() / penalty.tangential;
    const double elastic       = law.regularisation_speed > 0. ? 0. : 0.5 * state.traction.norm_square() / penalty.tangential;
    sums.stored += weight * (0.5 * penalty.normal * state.gap * state.gap + elastic);
    sums.compression = std::max(sums.compression, -state.gap);

    SlidingTangent of;
    of.normal   = -penalty.normal;
    of.coupled  = share.coefficient * penalty.normal;
    of.stuck    = sliding.friction == ContactFriction::stuck ? -penalty.tangential : 0.;
    of.by_speed = -share.derivative * state.pressure;
    of.delay    = law.regularisation_speed > 0. ? 0. : std::max(0., -of.by_speed / penalty.tangential);
    return of;
  }

  FrictionDelay delay_of(const SlidingTangent &of, const double speed, const FacePointRows &rows)
  {
    FrictionDelay result{ of.delay, rows.slip, rows.gap, rows.slip };
    result.force *= -rows.weight;
    result.stiffness_row *= -of.coupled;
    result.stiffness_row.add(-of.by_speed * speed, rows.stretch);
    result.rate_row *= -of.by_speed;
    return result;
  }
} // namespace sprag
