// SPDX-License-Identifier: GPL-3.0-only
#include "scene/sprung_closed_form.h"

#include "base/errors.h"
#include "base/text.h"
#include "scene/device.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  /// The frame follows with Q: the cylinder passes it at v / (1 + Q_x / k_f).
  ClosedFormState SprungClosedForm::sliding(const double at, const double v) const
  {
    const double h     = 1e-4 * device.geometry.cylinder_radius;
    const double slope = (closed_form(device, at + h, v).Q - closed_form(device, at - h, v).Q) / (2. * h);
    return closed_form(device, at, v / (1. + slope / stiffness));
  }

  double SprungClosedForm::sliding_position(const double x, const double v) const
  {
    const auto residual = [&](const double at) { return x - at - sliding(at, v).Q / stiffness; };
    const double first  = residual(x);
    if (first == 0.)
      return x;
    double from = x;
    double to   = x + 2. * first;
    for (unsigned int i = 0; i < 20 && residual(to) * first > 0.; ++i)
      to += 2. * first;
    if (!(residual(to) * first <= 0.))
      throw AnalysisError("no position of the pivot frame balances Q at x = " + mm(x) + ". Try a larger Support/Stiffness.");
    if (to < from)
      std::swap(from, to);
    boost::uintmax_t iterations = 100;
    const auto root =
        boost::math::tools::toms748_solve(residual, from, to, boost::math::tools::eps_tolerance<double>(), iterations);
    return 0.5 * (root.first + root.second);
  }

  /// P and F from the moment about the pivot, M = P s + F e, and Q = P sin theta + F cos theta = k_f (x - relative).
  ClosedFormState SprungClosedForm::sticking(const double x, const double at) const
  {
    const auto &geometry  = device.geometry;
    ClosedFormState lever = closed_form(device, at, 0.);
    const double theta    = lever.contact.theta;
    const double moment   = moment_law(device.spring).moment(theta - kinematics(geometry, 0.).theta);
    const double e        = geometry.interface_offset;
    lever.v_rel           = 0.;
    lever.Q               = stiffness * (x - at);
    lever.P               = (moment - e * lever.Q / std::cos(theta)) / (lever.contact.s - e * std::tan(theta));
    lever.F               = (lever.Q - lever.P * std::sin(theta)) / std::cos(theta);
    return lever;
  }

  void SprungClosedForm::set(const double x, const double at, const ClosedFormState &lever)
  {
    relative             = at;
    state.lever          = lever;
    state.displacement   = x - at;
    state.support_energy = 0.5 * stiffness * (x - at) * (x - at);
  }

  SprungClosedForm::State SprungClosedForm::start(const double x, const double v)
  {
    const double at = sliding_position(x, v);
    set(x, at, sliding(at, v));
    speed = v;
    return state;
  }

  const SprungClosedForm::State &SprungClosedForm::advance(const double x, const double v)
  {
    const double before     = state.support_energy;
    const double from_speed = drive_direction(speed) == drive_direction(v) ? speed : v;
    speed                   = v;
    const double slid       = sliding_position(x, v);
    state.sticks            = (slid - relative) * drive_direction(v) <= 0.;
    if (state.sticks)
    {
      set(x, relative, sticking(x, relative));
      state.work.drive += state.support_energy - before;
      return state;
    }
    // Along the way past the frame the closed form's own power: Q dx = Q d(x - u) + k_f u du.
    const double from   = relative;
    const double length = slid - from;
    const auto integral = [&](const auto &force)
    {
      return length * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                          [&](const double part)
                          { return force(sliding(from + part * length, from_speed + part * (v - from_speed))); },
                          0., 1., 5, 1e-10);
    };
    state.work.drive += integral([](const ClosedFormState &at) { return at.Q; });
    state.work.friction +=
        integral([&](const ClosedFormState &at)
                 { return at.F * (std::cos(at.contact.theta) - device.geometry.interface_offset * at.contact.theta_x); });
    set(x, slid, sliding(slid, v));
    state.work.drive += state.support_energy - before;
    return state;
  }
} // namespace sprag
