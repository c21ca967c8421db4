// SPDX-License-Identifier: GPL-3.0-only
#include "scene/pair_closed_form.h"

#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    /// Turn of a lever from rest that keeps it on the cylinder; < 0 where it would have to be pulled.
    double opening(const Device &device, const unsigned int lever, const double x)
    {
      return kinematics(lever_geometry(device, lever), x).theta - rest_inclination(device);
    }

    /// Rotations of a pair's lever and of its spring [rad].
    struct Turns
    {
      double opening; ///< of the lever
      double spring;  ///< half of both with a joint that is free
      double rest;    ///< of the spring

      bool touches() const
      {
        return spring >= rest;
      }

      /// Rotation of the lever; out of contact it is that without moment.
      double lever_rotation() const
      {
        return opening - std::min(spring - rest, 0.);
      }
    };

    std::array<Turns, 2> turns(const Device &device, const double x)
    {
      const double first  = opening(device, 0, x);
      const double second = opening(device, 1, x);
      const double rest   = device.spring.rest_angle;
      if (!swings(device))
        return { { { first, first, rest }, { second, second, rest } } };
      const double mean = 0.5 * (first + second);
      return { { { first, mean, rest }, { second, mean, rest } } };
    }

    PairedLever lever_at(const Device &device, const unsigned int lever, const Turns &turn, const double x, const double v)
    {
      if (!turn.touches())
        return { { { rest_inclination(device) + turn.lever_rotation(), 0., 0. }, 0., 0., 0., 0., 0. }, false, 0. };
      const auto law      = moment_law(lever_spring(device, lever));
      const auto geometry = lever_geometry(device, lever);
      return { closed_form(geometry, lever_friction(device, lever), law.moment(turn.spring), kinematics(geometry, x), v), true,
               law.energy(turn.spring) };
    }
  } // namespace

  std::array<double, 2> pair_inclinations(const Device &device, const double x)
  {
    const auto [first, second] = turns(device, x);
    const double rest          = rest_inclination(device);
    return { { rest + first.lever_rotation(), rest + second.lever_rotation() } };
  }

  std::array<PairedLever, 2> pair_closed_form(const Device &device, const double x, const double v)
  {
    const auto [first, second] = turns(device, x);
    return { { lever_at(device, 0, first, x, v), lever_at(device, 1, second, x, v) } };
  }

  std::array<Work, 2> pair_work_between(const Device &device, const double begin, const double end)
  {
    const auto lever_work = [&](const unsigned int lever)
    {
      return work_between(
          device.drive,
          [&](const DrivePoint &point) { return lever_at(device, lever, turns(device, point.x)[lever], point.x, point.v).state; },
          begin, end);
    };
    return { { lever_work(0), lever_work(1) } };
  }
} // namespace sprag
