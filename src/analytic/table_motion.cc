// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/table_motion.h"

#include "analytic/step_polynomial.h"
#include "base/errors.h"
#include "base/text.h"
#include "scene/scene.h"

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Steps of a smooth piece resolve its sines, so that polynomials through their ends show all events.
    constexpr double steps_a_period = 24.;

    constexpr double epsilon = std::numeric_limits<double>::epsilon();

    int signum(const double value)
    {
      return value < 0. ? -1 : 1;
    }
  } // namespace

  double IsolationSystem::natural_frequency() const
  {
    return std::sqrt(stiffness / mass);
  }

  IsolationSystem isolation_system(const Scene &scene)
  {
    return { scene.isolation.mass, scene.isolation.stiffness, make_damper(scene), base_motion(scene.isolation) };
  }

  TableMotion::TableMotion(IsolationSystem system_, const double z, const double rate, const double error)
      : system(std::move(system_))
      , tolerance(error)
      , longest_step(std::min(2. * M_PI / system.natural_frequency(), system.base.shortest_period) / steps_a_period)
      , next_step(0.1 * longest_step)
  {
    now.z     = z;
    now.rate  = rate;
    side      = signum(z != 0. ? z : rate);
    direction = rate != 0. ? signum(rate) : 0;
    if (rate == 0.)
      set_out(way_out());
    begin();
  }

  Resistance TableMotion::resistance(const double z, const double rate) const
  {
    return system.damper.resistance(side * z, direction * rate, side * direction);
  }

  double TableMotion::moving_acceleration(const double z, const double rate, const BasePoint &base) const
  {
    return -(system.stiffness * z + side * resistance(z, rate).force) / system.mass - base.a;
  }

  double TableMotion::force_needed(const BasePoint &base) const
  {
    return -system.mass * base.a - system.stiffness * now.z;
  }

  TableMotion::Range TableMotion::friction_at_rest() const
  {
    const double y    = std::abs(now.z);
    const double away = system.damper.resistance(y, 0., 1).force;
    const double back = now.z == 0. ? -away : system.damper.resistance(y, 0., -1).force;
    return side > 0 || now.z == 0. ? Range{ back, away } : Range{ -away, -back };
  }

  /// Holding force beyond the limit of friction at rest [N]. The error of a step is subtracted, so that it alone moves no table.
  double TableMotion::excess(const BasePoint &base) const
  {
    const auto [low, high] = friction_at_rest();
    const double needed    = force_needed(base);
    const double share     = std::max(tolerance, 8. * epsilon);
    const double doubt =
        share * (system.mass * std::abs(base.a) + system.stiffness * std::abs(now.z) + std::max(std::abs(low), std::abs(high)));
    return std::max(needed - high, low - needed) - doubt;
  }

  int TableMotion::way_out() const
  {
    if (excess(base()) <= 0.)
      return 0;
    const auto [low, high] = friction_at_rest();
    return 2. * force_needed(base()) > low + high ? 1 : -1;
  }

  void TableMotion::set_out(const int towards)
  {
    direction = towards;
    side      = now.z == 0. && towards != 0 ? towards : signum(now.z);
  }

  BasePoint TableMotion::base() const
  {
    return system.base.at(now.time, piece);
  }

  double TableMotion::damper_force() const
  {
    return rests() ? force_needed(base()) : side * resistance(now.z, now.rate).force;
  }

  double TableMotion::acceleration() const
  {
    return -(system.stiffness * now.z + damper_force()) / system.mass;
  }

  double TableMotion::damper_energy() const
  {
    return system.damper.energy(std::abs(now.z));
  }

  double TableMotion::energy() const
  {
    const double speed = now.rate + base().v;
    return 0.5 * system.mass * speed * speed + 0.5 * system.stiffness * now.z * now.z + damper_energy();
  }

  void TableMotion::derivatives(const Values &values, Values &rates, const double time) const
  {
    const auto base   = system.base.at(time, piece);
    const auto [z, w] = std::make_pair(values[0], values[1]);
    double absolute = base.a, dissipated = 0.;
    if (!rests())
    {
      const auto damper = resistance(z, w);
      absolute          = -(system.stiffness * z + side * damper.force) / system.mass;
      dissipated        = damper.dissipated;
    }
    const double phase   = 2. * M_PI * system.base.frequency * time;
    const bool has_sines = system.base.frequency > 0.;
    rates = { { rests() ? 0. : w, absolute - base.a, system.mass * absolute * base.v, dissipated, absolute * absolute,
                has_sines ? absolute * std::cos(phase) : 0., has_sines ? absolute * std::sin(phase) : 0., base.a * base.a } };
  }

  /// The error is over the amplitude.
  TableMotion::Values TableMotion::tried(const double duration, double &error) const
  {
    boost::numeric::odeint::runge_kutta_fehlberg78<Values> stepper;
    const Values begin = { { now.z, now.rate, now.base_work, now.dissipated, now.square, now.cosine, now.sine,
                             now.base_square } };
    Values end, errors;
    stepper.do_step([this](const Values &values, Values &rates, const double time) { derivatives(values, rates, time); }, begin,
                    now.time, end, duration, errors);
    const double w         = system.natural_frequency();
    const double amplitude = std::max({ std::abs(begin[0]), std::abs(begin[1]) / w, std::abs(end[0]), std::abs(end[1]) / w });
    error                  = amplitude > 0. ? std::max(std::abs(errors[0]), std::abs(errors[1]) / w) / amplitude : 0.;
    return end;
  }

  TableMotion::Values TableMotion::stepped(const double duration) const
  {
    double ignored = 0.;
    return tried(duration, ignored);
  }

  void TableMotion::fail(const std::string &what) const
  {
    throw AnalysisError("At t = " + rounded_text(now.time) + " s, z = " + mm(now.z) + ": " + what);
  }

  void TableMotion::pass_kink()
  {
    if (piece == system.base.kinks.size() || now.time != system.base.kinks[piece])
      return;
    ++piece;
    if (rests())
      set_out(way_out());
    peak_acceleration = std::max(peak_acceleration, std::abs(acceleration()));
  }

  double TableMotion::step_end(const double until) const
  {
    return piece == system.base.kinks.size() ? until : std::min(until, system.base.kinks[piece]);
  }

  TableEvent TableMotion::advance(const double until)
  {
    pass_kink();
    return rests() ? advance_at_rest(until) : advance_moving(until);
  }

  TableEvent TableMotion::advance_at_rest(const double until)
  {
    const double end   = std::min(step_end(until), now.time + system.base.shortest_period / steps_a_period);
    const auto held    = [this](const double time) { return -excess(system.base.at(time, piece)); };
    const double begin = now.time;
    std::optional<double> loose; // an instant at which it moves
    if (held(end) < 0.)
      loose = end;
    const auto jerk       = [this](const double time) { return system.base.at(time, piece).jerk; };
    const double at_begin = jerk(begin);
    if (!loose && at_begin * jerk(end) < 0.)
    {
      const double extreme = falling_root([&](const double time) { return signum(at_begin) * jerk(time); }, begin, end);
      if (held(extreme) < 0.)
        loose = extreme;
    }
    const double last = loose ? falling_root(held, begin, *loose) : end;
    take(last - begin, stepped(last - begin));
    now.time = last;
    if (!loose)
      return TableEvent::none;
    const auto [low, high] = friction_at_rest();
    set_out(2. * force_needed(system.base.at(*loose, piece)) > low + high ? 1 : -1);
    return TableEvent::release;
  }

  /// A step of the error asked for; returns its duration.
  double TableMotion::accepted_step(const double until, Values &end)
  {
    const double room = step_end(until) - now.time;
    for (double duration = std::min({ next_step, longest_step, room });;)
    {
      double error        = 0.;
      end                 = tried(duration, error);
      const bool is_whole = duration == room;
      const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-30) / tolerance, -0.125), 0.2, 4.);
      if (error <= tolerance)
      {
        next_step = is_whole ? std::max(next_step, factor * duration) : factor * duration;
        return duration;
      }
      duration *= std::isfinite(error) ? std::min(factor, 0.9) : 0.2;
      if (duration < 4. * epsilon * now.time || duration < 1e-12 * longest_step)
        fail("steps of the error Isolation/Tolerance = " + rounded_text(tolerance) + " become too short. Try a larger one");
    }
  }

  void TableMotion::take(const double duration, const Values &end)
  {
    const TableState from = now;
    now.z                 = end[0];
    now.rate              = end[1];
    now.base_work         = end[2];
    now.dissipated        = end[3];
    now.square            = end[4];
    now.cosine            = end[5];
    now.sine              = end[6];
    now.base_square       = end[7];
    note_peaks(from, duration);
  }
} // namespace sprag
