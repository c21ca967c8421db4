// SPDX-License-Identifier: GPL-3.0-only
#include "scene/closed_form.h"
#include "base/unknown.h"
#include "laws/friction_law.h"
#include "scene/device.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace sprag
{
  namespace
  {
    double arm(const Geometry &geometry)
    {
      return geometry.cylinder_radius - geometry.interface_offset;
    }

    /// dQ/dtheta * dtheta/dx of eqs. 10-12 for a spring of unit stiffness [1/mm].
    double slope_per_stiffness(const Geometry &geometry, const double coefficient, const int sign)
    {
      const double theta = kinematics(geometry, 0.).theta;
      const double s     = arm(geometry) * std::cos(theta) - geometry.pivot_height;
      const double sine  = std::sin(theta);
      const double lever = s + sign * coefficient * geometry.interface_offset * sine;
      if (lever <= 0.)
        return unknown;
      const double dP = sine / lever;
      return (sign * coefficient * std::cos(theta) + sine) * dP * sine * sine / s;
    }

    double sliding_speed(const Geometry &geometry, const Kinematics &contact, const double v)
    {
      return v * (std::cos(contact.theta) - geometry.interface_offset * contact.theta_x);
    }

    constexpr unsigned int smooth_drive_depth = 12;
    constexpr unsigned int table_depth        = 4;

    /// Integral over time of a power without a jump in v. Over the unit interval, because the library compares its error there
    /// with the tolerance times the interval's length. Late in a long drive the rounding of the time limits what can be asked
    /// for. The interval is halved at most `depth` times.
    double integral(const std::function<double(double)> &power, const double begin, const double end, const unsigned int depth)
    {
      const double duration  = end - begin;
      const double rounding  = std::numeric_limits<double>::epsilon() * end / duration;
      const double tolerance = std::max(1e-12, 8. * rounding);
      return duration * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                            [&](const double part) { return power(begin + part * duration); }, 0., 1., depth, tolerance);
    }

    std::optional<Locking> locking_between(const Device &device, const double from, const double to)
    {
      const double search_step = 0.1;
      const auto &drive        = device.drive;
      for (DrivePoint point = drive.at(from, Drive::Side::after); point.time < to;)
      {
        const double begin = point.time;
        point              = drive.step(point.time, search_step);
        if (!(point.x < drive.at(begin).x))
          continue;
        for (const double time : { begin, point.time })
        {
          const auto at    = drive.at(time, time == begin ? Drive::Side::after : Drive::Side::before);
          const auto state = closed_form(device, at.x, at.v);
          if (state.contact.s <= state.mu * device.geometry.interface_offset)
            return Locking{ at.x, state.contact.s, state.mu };
        }
      }
      return {};
    }
  } // namespace

  Kinematics kinematics(const Geometry &geometry, const double x)
  {
    const double a     = geometry.pivot_distance - x;
    const double h     = geometry.pivot_height;
    const double theta = std::asin(arm(geometry) / std::hypot(a, h)) - std::atan2(h, a);
    const double s     = a * std::cos(theta) - h * std::sin(theta);
    return { theta, s, std::sin(theta) / s };
  }

  double sliding_speed(const Geometry &geometry, const double x, const double v)
  {
    return sliding_speed(geometry, kinematics(geometry, x), v);
  }

  ClosedFormState closed_form(const Geometry &geometry, const FrictionLaw &friction, const double moment,
                              const Kinematics &contact, const double v)
  {
    ClosedFormState state;
    const double sign = std::copysign(1., v);
    state.contact     = contact;
    state.v_rel       = sliding_speed(geometry, contact, v);
    const double w    = friction.speed == FrictionSpeed::drive ? v : state.v_rel;
    state.mu          = friction_coefficient(friction, std::abs(w)).coefficient;
    state.P           = moment / (state.contact.s + sign * state.mu * geometry.interface_offset);
    state.F           = sign * state.mu * state.P;
    state.Q           = state.P * std::sin(state.contact.theta) + state.F * std::cos(state.contact.theta);
    return state;
  }

  ClosedFormState closed_form(const Device &device, const double x, const double v)
  {
    const auto contact = kinematics(device.geometry, x);
    const double turn  = contact.theta - kinematics(device.geometry, 0.).theta;
    return closed_form(device.geometry, device.friction, moment_law(device.spring).moment(turn), contact, v);
  }

  double representative_slope(const Geometry &geometry, const double spring_stiffness, const double coefficient, const int sign)
  {
    return spring_stiffness * slope_per_stiffness(geometry, coefficient, sign);
  }

  double dimensionless_slope(const Geometry &geometry, const double coefficient, const int sign)
  {
    return geometry.cylinder_radius * geometry.pivot_distance * slope_per_stiffness(geometry, coefficient, sign);
  }

  double pivot_contact(const Geometry &geometry)
  {
    const double R = geometry.cylinder_radius;
    const double h = geometry.pivot_height;
    return geometry.pivot_distance - std::sqrt(std::max(0., R * R - h * h));
  }

  std::optional<Locking> locking(const Device &device)
  {
    // Strokes of a periodic drive are equal except the first and the last.
    const auto &turns = device.drive.reversals();
    const double end  = device.drive.duration();
    if (device.drive.profile() == DriveProfile::table || turns.size() <= 3)
      return locking_between(device, 0., end);
    const auto found = locking_between(device, 0., turns[2]);
    return found ? found : locking_between(device, turns.back(), end);
  }

  Work work_between(const Device &device, const double begin, const double end)
  {
    return work_between(
        device.drive, [&](const DrivePoint &point) { return closed_form(device, point.x, point.v); }, begin, end);
  }

  Work work_between(const Drive &drive, const std::function<ClosedFormState(const DrivePoint &)> &state_at, const double begin,
                    const double end)
  {
    const auto drive_power = [&](const double time)
    {
      const auto point = drive.at(time);
      return state_at(point).Q * point.v;
    };
    const auto friction_power = [&](const double time)
    {
      const auto state = state_at(drive.at(time));
      return state.F * state.v_rel;
    };

    // The acceleration jumps at the rows of a table. A short one has them as kinks; in a long one they lie so close that
    // works are within 1e-7 with fewer points than rows, whose number a step would cost otherwise.
    const bool is_table      = drive.profile() == DriveProfile::table;
    const unsigned int depth = is_table ? table_depth : smooth_drive_depth;
    Work work;
    const auto add = [&](const double from, const double to)
    {
      work.drive += integral(drive_power, from, to, depth);
      work.friction += integral(friction_power, from, to, depth);
    };
    double from       = begin;
    const auto &kinks = is_table ? drive.kinks() : drive.reversals();
    for (auto kink = std::upper_bound(kinks.begin(), kinks.end(), begin); kink != kinks.end() && *kink < end; ++kink)
    {
      add(from, *kink);
      from = *kink;
    }
    add(from, end);
    return work;
  }
} // namespace sprag
