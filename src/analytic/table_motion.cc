// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/table_motion.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

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

    /// A polynomial over the share of a step, 0 to 1: the coefficients of its powers, the constant first.
    using StepPolynomial = std::vector<double>;

    double evaluate(const StepPolynomial &polynomial, const double share)
    {
      double value = 0.;
      for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c)
        value = value * share + *c;
      return value;
    }

    StepPolynomial differentiate(const StepPolynomial &polynomial)
    {
      StepPolynomial result;
      for (std::size_t i = 1; i < polynomial.size(); ++i)
        result.push_back(static_cast<double>(i) * polynomial[i]);
      return result;
    }

    /// An end of a step: a quantity with its first and second derivative over the share.
    struct StepEnd
    {
      double value, first, second;
    };

    /// Returns the quintic through both ends.
    StepPolynomial quintic(const StepEnd &begin, const StepEnd &end)
    {
      const double half = begin.second / 2.;
      const double d0   = end.value - begin.value - begin.first - half;
      const double d1   = end.first - begin.first - begin.second;
      const double d2   = end.second - begin.second;
      return {
        begin.value, begin.first, half, 10. * d0 - 4. * d1 + d2 / 2., -15. * d0 + 7. * d1 - d2, 6. * d0 - 3. * d1 + d2 / 2.
      };
    }

    /// Returns the cubic through values and first derivatives of both ends.
    StepPolynomial cubic(const StepEnd &begin, const StepEnd &end)
    {
      const double rise = end.value - begin.value;
      return { begin.value, begin.first, 3. * rise - 2. * begin.first - end.first, begin.first + end.first - 2. * rise };
    }

    /// Returns the quartic through values at 0, 1/4, 1/2, 3/4 and 1.
    StepPolynomial quartic(const std::vector<double> &y)
    {
      return { y[0], (-25. * y[0] + 48. * y[1] - 36. * y[2] + 16. * y[3] - 3. * y[4]) / 3.,
               (70. * y[0] - 208. * y[1] + 228. * y[2] - 112. * y[3] + 22. * y[4]) / 3.,
               (-80. * y[0] + 288. * y[1] - 384. * y[2] + 224. * y[3] - 48. * y[4]) / 3.,
               (32. * y[0] - 128. * y[1] + 192. * y[2] - 128. * y[3] + 32. * y[4]) / 3. };
    }

    /// The root of a function that is positive at `from` and negative at `to`, to round-off.
    template <class Function>
    double falling_root(const Function &function, const double from, const double to)
    {
      const double before = function(from), behind = function(to);
      if (before <= 0.)
        return from;
      if (behind >= 0.)
        return to;
      boost::uintmax_t most = 100;
      const auto found      = boost::math::tools::toms748_solve(function, from, to, before, behind,
                                                                boost::math::tools::eps_tolerance<double>(), most);
      return 0.5 * (found.first + found.second);
    }

    /// Returns the places strictly between 0 and 1 where the polynomial changes its sign, increasing, to round-off. Between its
    /// own turns, 0 and 1 it is monotone.
    std::vector<double> sign_changes(const StepPolynomial &polynomial);

    /// Between which a polynomial rises or falls: 0, its turns, 1.
    std::vector<double> monotone_pieces(const StepPolynomial &polynomial)
    {
      std::vector<double> result = { 0. };
      if (polynomial.size() > 2)
        append(result, sign_changes(differentiate(polynomial)));
      result.push_back(1.);
      return result;
    }

    std::vector<double> sign_changes(const StepPolynomial &polynomial)
    {
      std::vector<double> result;
      const auto pieces = monotone_pieces(polynomial);
      const auto value  = [&](const double share) { return evaluate(polynomial, share); };
      for (std::size_t i = 1; i < pieces.size(); ++i)
      {
        const double from = pieces[i - 1], to = pieces[i], before = value(from), behind = value(to);
        if (!((before < 0. && behind > 0.) || (before > 0. && behind < 0.)))
          continue;
        result.push_back(falling_root([&](const double share) { return before > 0. ? value(share) : -value(share); }, from, to));
      }
      return result;
    }

    /// Encloses a sign change, as fractions of the step from 0 to 1.
    struct Bracket
    {
      double from, to;
    };

    /// Returns the first stretch without a turn on which the polynomial falls below 0 by more than round-off; none where it never
    /// does.
    std::optional<Bracket> first_fall(const StepPolynomial &polynomial)
    {
      constexpr double round_off = 1e-13;
      const auto pieces          = monotone_pieces(polynomial);
      const double scale         = largest(pieces, [&](const double share) { return evaluate(polynomial, share); });
      for (std::size_t i = 1; i < pieces.size(); ++i)
        if (evaluate(polynomial, pieces[i]) < -round_off * scale)
          return Bracket{ pieces[i - 1], pieces[i] };
      return {};
    }

    class TableMotion : public IsolatedTable
    {
    public:
      TableMotion(IsolationSystem system_, const double z, const double rate, const double error)
          : system(std::move(system_))
          , tolerance(error)
          , longest_step(std::min(2. * M_PI / system.natural_frequency(), system.base.shortest_period) / steps_a_period)
      {
        now.z     = z;
        now.rate  = rate;
        side      = signum(z != 0. ? z : rate);
        direction = rate != 0. ? signum(rate) : 0;
        if (rate == 0.)
          set_out(way_out());
        begin();
      }

      BasePoint base() const override
      {
        return system.base.at(now.time, piece);
      }

      bool rests() const override
      {
        return direction == 0;
      }

      double force_before_turn() const override
      {
        return last_force;
      }

      double damper_force() const override
      {
        return rests() ? force_needed(base()) : side * resistance(now.z, now.rate).force;
      }

      double acceleration() const override
      {
        return -(system.stiffness * now.z + damper_force()) / system.mass;
      }

      double damper_energy() const override
      {
        return system.damper.energy(std::abs(now.z));
      }

      double energy() const override
      {
        const double speed = now.rate + base().v;
        return 0.5 * system.mass * speed * speed + 0.5 * system.stiffness * now.z * now.z + damper_energy();
      }

      TableEvent advance(const double until) override
      {
        pass_kink();
        return rests() ? advance_at_rest(until) : advance_moving(until);
      }

    private:
      using Values = std::array<double, 8>;

      const IsolationSystem system;
      const double tolerance;
      const double longest_step;
      std::size_t piece           = 0; ///< of the base's motion
      int side                    = 1; ///< sign of z
      int direction               = 0; ///< of z'; 0: the table rests
      double next_step            = 0.1 * longest_step;
      double last_force           = 0.;
      unsigned int events_at_once = 0;

      Resistance resistance(const double z, const double rate) const
      {
        return system.damper.resistance(side * z, direction * rate, side * direction);
      }

      double moving_acceleration(const double z, const double rate, const BasePoint &base) const
      {
        return -(system.stiffness * z + side * resistance(z, rate).force) / system.mass - base.a;
      }

      double force_needed(const BasePoint &base) const
      {
        return -system.mass * base.a - system.stiffness * now.z;
      }

      /// The smallest and the largest force that friction holds.
      std::pair<double, double> friction_at_rest() const
      {
        const double y    = std::abs(now.z);
        const double away = system.damper.resistance(y, 0., 1).force;
        const double back = now.z == 0. ? -away : system.damper.resistance(y, 0., -1).force;
        return side > 0 || now.z == 0. ? std::pair(back, away) : std::pair(-away, -back);
      }

      /// Holding force beyond the limit of friction at rest [N]. The error of a step is subtracted, so that it alone moves no
      /// table.
      double excess(const BasePoint &base) const
      {
        const auto [low, high]  = friction_at_rest();
        const double needed     = force_needed(base);
        const double share      = std::max(tolerance, 8. * epsilon);
        const double step_error = share * (system.mass * std::abs(base.a) + system.stiffness * std::abs(now.z) +
                                           std::max(std::abs(low), std::abs(high)));
        return std::max(needed - high, low - needed) - step_error;
      }

      int way_out() const
      {
        if (excess(base()) <= 0.)
          return 0;
        const auto [low, high] = friction_at_rest();
        return 2. * force_needed(base()) > low + high ? 1 : -1;
      }

      void set_out(const int towards)
      {
        direction = towards;
        side      = now.z == 0. && towards != 0 ? towards : signum(now.z);
      }

      void derivatives(const Values &values, Values &rates, const double time) const
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
      Values tried(const double duration, double &error) const
      {
        boost::numeric::odeint::runge_kutta_fehlberg78<Values> stepper;
        const Values begin = { { now.z, now.rate, now.base_work, now.dissipated, now.square, now.cosine, now.sine,
                                 now.base_square } };
        Values end, errors;
        stepper.do_step([this](const Values &values, Values &rates, const double time) { derivatives(values, rates, time); },
                        begin, now.time, end, duration, errors);
        const double w         = system.natural_frequency();
        const double amplitude = std::max({ std::abs(begin[0]), std::abs(begin[1]) / w, std::abs(end[0]), std::abs(end[1]) / w });
        error                  = amplitude > 0. ? std::max(std::abs(errors[0]), std::abs(errors[1]) / w) / amplitude : 0.;
        return end;
      }

      Values stepped(const double duration) const
      {
        double ignored = 0.;
        return tried(duration, ignored);
      }

      [[noreturn]] void fail(const std::string &what) const
      {
        throw AnalysisError("At t = " + rounded_text(now.time) + " s, z = " + mm(now.z) + ": " + what);
      }

      void pass_kink()
      {
        if (piece == system.base.kinks.size() || now.time != system.base.kinks[piece])
          return;
        ++piece;
        if (rests())
          set_out(way_out());
        peak_acceleration = std::max(peak_acceleration, std::abs(acceleration()));
      }

      double step_end(const double until) const
      {
        return piece == system.base.kinks.size() ? until : std::min(until, system.base.kinks[piece]);
      }

      TableEvent advance_at_rest(const double until)
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

      /// Takes a step within the tolerance and returns its duration.
      double accepted_step(const double until, Values &end)
      {
        const double remaining = step_end(until) - now.time;
        for (double duration = std::min({ next_step, longest_step, remaining });;)
        {
          double error        = 0.;
          end                 = tried(duration, error);
          const bool is_whole = duration == remaining;
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

      void take(const double duration, const Values &end)
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

      /// Looks for the first event within a step and shortens the step to it: `end` and the duration returned.
      double step_to_event(const double duration, Values &end, TableEvent &event)
      {
        const double h  = duration;
        const double a0 = moving_acceleration(now.z, now.rate, base());
        const double a1 = moving_acceleration(end[0], end[1], system.base.at(now.time + h, piece));
        auto z          = quintic({ now.z, now.rate * h, a0 * h * h }, { end[0], end[1] * h, a1 * h * h });
        // In a short step z hardly changes, and round-off of the difference would turn its rate.
        const bool is_short = h < 1e-2 * longest_step;
        auto rate           = is_short ? cubic({ now.rate, a0 * h, 0. }, { end[1], a1 * h, 0. }) : differentiate(z);
        auto clearance      = z;
        for (double &c : rate)
          c *= direction;
        for (double &c : clearance)
          c *= -side;
        for (double &c : z)
          c *= side;
        clearance[0] += system.damper.reach;

        double first       = duration;
        const auto look_at = [&](const StepPolynomial &polynomial, const auto &value, const TableEvent what)
        {
          const auto fall = first_fall(polynomial);
          if (!fall || fall->from * h > first)
            return;
          const double at = falling_root([&](const double time) { return value(stepped(time)); }, fall->from * h, fall->to * h);
          if (at > first || (at == first && event != TableEvent::none))
            return;
          first = at;
          event = what;
        };
        look_at(
            rate, [this](const Values &v) { return direction * v[1]; }, TableEvent::turn);
        look_at(
            z, [this](const Values &v) { return side * v[0]; }, TableEvent::centre);
        if (std::isfinite(system.damper.reach))
          look_at(
              clearance, [this](const Values &v) { return system.damper.reach - side * v[0]; }, TableEvent::end);
        if (event != TableEvent::none)
          end = stepped(first);
        return first;
      }

      void check_locking(const double duration, const Values &end)
      {
        if (!system.damper.locking_margin || side * direction > 0)
          return;
        const auto margin = [this](const Values &v) { return system.damper.locking_margin(std::abs(v[0]), std::abs(v[1])); };
        if (margin(end) > 0.)
          return;
        const double at = falling_root([&](const double time) { return margin(stepped(time)); }, 0., duration);
        take(at, stepped(at));
        now.time += at;
        fail("the damper locks: friction holds the table whatever pulls it back. Try less friction, a smaller motion of the base "
             "or of the beginning, or levers with a smaller e");
      }

      /// Updates the peaks. The acceleration's is the extreme of a quartic through five instants of the step.
      void note_peaks(const TableState &from, const double duration)
      {
        const double h         = duration;
        const auto base_at     = [&](const double share) { return system.base.at(from.time + share * h, piece); };
        const auto absolute_at = [&](const double z, const double rate, const BasePoint &base)
        { return rests() ? base.a : moving_acceleration(z, rate, base) + base.a; };
        const auto first = base_at(0.), last = base_at(1.);
        const double a0 = absolute_at(from.z, from.rate, first), a1 = absolute_at(now.z, now.rate, last);
        const auto z               = quintic({ from.z, from.rate * h, rests() ? 0. : (a0 - first.a) * h * h },
                                             { now.z, now.rate * h, rests() ? 0. : (a1 - last.a) * h * h });
        const auto rate            = differentiate(z);
        std::vector<double> values = { a0 };
        for (const double share : { 0.25, 0.5, 0.75 })
          values.push_back(absolute_at(evaluate(z, share), h > 0. ? evaluate(rate, share) / h : from.rate, base_at(share)));
        values.push_back(a1);
        const auto curve = quartic(values);
        for (const double share : sign_changes(differentiate(curve)))
          values.push_back(evaluate(curve, share));
        for (const double value : values)
          peak_acceleration = std::max(peak_acceleration, std::abs(value));
        peak_displacement = std::max(peak_displacement, std::abs(now.z));
        for (const double share : { 0., 0.5, 1. })
          peak_base = std::max(peak_base, std::abs(base_at(share).a));
      }

      TableEvent turn()
      {
        last_force     = damper_force();
        now.rate       = 0.;
        const double y = std::abs(now.z);
        if (system.damper.locking_margin && system.damper.locking_margin(y, 0.) <= 0.)
          fail("the damper locks where the table came to rest: friction holds it whatever pulls it back. Try less friction, a "
               "smaller motion of the base or of the beginning, or levers with a smaller e");
        set_out(way_out());
        return rests() ? TableEvent::stop : TableEvent::turn;
      }

      TableEvent advance_moving(const double until)
      {
        Values end;
        const double duration = accepted_step(until, end);
        TableEvent event      = TableEvent::none;
        const double taken    = step_to_event(duration, end, event);
        check_locking(taken, end);
        take(taken, end);
        now.time       = event == TableEvent::none && now.time + taken >= step_end(until) * (1. - epsilon) ? step_end(until)
                                                                                                           : now.time + taken;
        events_at_once = taken > 1e-9 * longest_step ? 0 : events_at_once + 1;
        if (events_at_once > 100)
          fail("the table turns again and again at one instant. Try an Initial displacement that is a little different");
        if (event == TableEvent::end)
          fail(system.damper.end +
               ". Try a smaller motion of the base or of the beginning, more damping, or levers with a longer "
               "way: a larger Geometry/Pivot distance");
        if (event == TableEvent::centre)
        {
          now.z = 0.;
          side  = direction;
        }
        return event == TableEvent::turn ? turn() : event;
      }
    };
  } // namespace

  IsolationSystem isolation_system(const Scene &scene)
  {
    return { scene.isolation.mass, scene.isolation.stiffness, make_damper(scene), base_motion(scene.isolation) };
  }

  std::unique_ptr<IsolatedTable> make_table_motion(IsolationSystem system, const double z, const double rate,
                                                   const double tolerance)
  {
    return std::make_unique<TableMotion>(std::move(system), z, rate, tolerance);
  }
} // namespace sprag
