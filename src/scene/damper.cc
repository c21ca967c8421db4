// SPDX-License-Identifier: GPL-3.0-only
#include "scene/damper.h"
#include "laws/friction_law.h"
#include "scene/scene.h"

#include "base/monotone_cubic.h"
#include "scene/closed_form.h"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    const auto no_energy = [](double) { return 0.; };

    /// Nothing is stored: all work is dissipated.
    template <class Force>
    Damper dissipating(const Force &force)
    {
      Damper damper;
      damper.resistance = [force](const double y, const double speed, const int away)
      {
        const double f = away * force(y, speed, away);
        return Resistance{ f, away * f * speed };
      };
      damper.energy = no_energy;
      return damper;
    }

    Damper friction(const double constant, const double slope, const double viscous)
    {
      return dissipating([=](const double y, const double speed, int) { return constant + slope * y + viscous * speed; });
    }

    /// Largest displacement of a lever: there the contact point begins to move against the cylinder, s cos(th) = e sin(th), or
    /// the cylinder reaches the pivot [mm].
    double lever_reach(const Geometry &geometry)
    {
      constexpr double margin = 1e-9; // of the normal force, which is infinite at the pivot where e = 0
      const double touched =
          std::abs(geometry.pivot_height) <= geometry.cylinder_radius ? pivot_contact(geometry) : geometry.pivot_distance;
      const double last = (1. - margin) * touched;
      const auto speed  = [&](const double x) { return sliding_speed(geometry, x, 1.); };
      if (speed(last) > 0. || speed(0.) <= 0.)
        return last;
      boost::uintmax_t most = 200;
      return boost::math::tools::toms748_solve(speed, 0., last, boost::math::tools::eps_tolerance<double>(), most).first;
    }

    Damper levers(const Scene &scene)
    {
      const double n     = scene.isolation.levers;
      const double reach = lever_reach(scene.geometry);
      const auto law     = moment_law(scene.spring);
      const double begin = kinematics(scene.geometry, 0.).theta, rest = scene.spring.rest_angle;
      const auto turn  = [=](const double x) { return kinematics(scene.geometry, std::min(x, reach)).theta - begin; };
      const auto lever = [=, friction = scene.friction, geometry = scene.geometry](const double x, const double speed, int away)
      {
        const auto contact = kinematics(geometry, std::min(x, reach));
        const auto state =
            closed_form(geometry, friction, law.moment(contact.theta - begin), contact, std::copysign(std::max(0., speed), away));
        return Resistance{ n * state.Q, n * std::abs(state.F * state.v_rel) };
      };

      Damper damper;
      // A preload presses those for the other sign of z as well, to where their springs are at rest.
      damper.resistance = [=](const double y, const double speed, const int away)
      {
        const auto here = lever(y, speed, away);
        if (rest == 0. || turn(-y) <= rest)
          return here;
        const auto other = lever(-y, speed, -away);
        return Resistance{ here.force - other.force, here.dissipated + other.dissipated };
      };
      damper.energy         = [=](const double y) { return n * (law.energy(turn(y)) + law.energy(std::max(turn(-y), rest))); };
      damper.reach          = reach;
      damper.end            = "the cylinder reaches the lever's pivot, or would slide the other way along the lever";
      damper.locking_margin = [=](const double y, const double speed)
      {
        const auto state = closed_form(scene, std::min(y, reach), -std::max(0., speed));
        return state.contact.s - state.mu * scene.geometry.interface_offset;
      };
      return damper;
    }

    /// Moments about the lever's pivot: K z r = N (1 + away mu q), all arms over that of the normal force N.
    Damper restoring_lever(const Scene &scene)
    {
      const auto &settings = scene.isolation;
      const double spring = settings.stiffness * settings.lever_ratio, q = settings.friction_arm_ratio;
      const auto mu = [friction = scene.friction](const double speed)
      { return friction_coefficient(friction, std::max(0., speed)).coefficient; };
      Damper damper         = dissipating([=](const double y, const double speed, const int away)
                                  { return mu(speed) * spring * y / (1. + away * mu(speed) * q); });
      damper.locking_margin = [=](double, const double speed) { return 1. - mu(speed) * q; };
      return damper;
    }

    /// Energy of the mean of both ways, by Simpson's rule, which is exact for the cubics between two samples.
    std::function<double(double)> loop_energy(const MonotoneCubic &out, const MonotoneCubic &back, std::vector<double> knots)
    {
      const auto mean  = [=](const double y) { return 0.5 * (out.value(y) + back.value(y)); };
      const auto piece = [=](const double from, const double to)
      { return (to - from) / 6. * (mean(from) + 4. * mean(0.5 * (from + to)) + mean(to)); };
      std::vector<double> energies = { 0. };
      for (std::size_t i = 1; i < knots.size(); ++i)
        energies.push_back(energies.back() + piece(knots[i - 1], knots[i]));
      return [=](const double y)
      {
        const auto next     = std::upper_bound(knots.begin() + 1, knots.end() - 1, y);
        const std::size_t i = static_cast<std::size_t>(next - knots.begin()) - 1;
        return energies[i] + piece(knots[i], y);
      };
    }

    Damper loop(const DamperLoop &loop)
    {
      const MonotoneCubic out(loop.out.at, loop.out.values), back(loop.back.at, loop.back.values);
      std::vector<double> knots = loop.out.at;
      knots.insert(knots.end(), loop.back.at.begin(), loop.back.at.end());
      std::sort(knots.begin(), knots.end());
      Damper damper;
      damper.resistance = [=](const double y, const double speed, const int away)
      {
        const double there = out.value(y), again = back.value(y);
        return Resistance{ away > 0 ? there : again, 0.5 * (there - again) * speed };
      };
      damper.energy = loop_energy(out, back, knots);
      damper.reach  = knots.back();
      damper.end    = "the loop of Isolation/Loop table ends";
      return damper;
    }
  } // namespace

  Damper make_damper(const Scene &scene)
  {
    const auto &settings = scene.isolation;
    switch (settings.damper)
    {
    case DamperType::lever:
      return levers(scene);
    case DamperType::constant_friction:
      return friction(settings.friction_force, 0., 0.);
    case DamperType::linear_friction:
      return friction(0., settings.friction_slope, 0.);
    case DamperType::Beucke:
      return friction(settings.friction_force, settings.friction_slope, settings.viscous_coefficient);
    case DamperType::restoring_lever:
      return restoring_lever(scene);
    case DamperType::viscous:
      return friction(0., 0., settings.viscous_coefficient);
    case DamperType::loop:
      return loop(settings.loop);
    case DamperType::none:
      break;
    }
    return friction(0., 0., 0.);
  }
} // namespace sprag
