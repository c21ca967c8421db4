// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/step_polynomial.h"
#include "analytic/table_motion.h"
#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
  }

  /// Looks for the first event within a step; `end` and the duration returned are those of the step as far as there.
  double TableMotion::step_to_event(const double duration, Values &end, TableEvent &event)
  {
    const double h  = duration;
    const double a0 = moving_acceleration(now.z, now.rate, base());
    const double a1 = moving_acceleration(end[0], end[1], system.base.at(now.time + h, piece));
    auto z          = quintic({ now.z, now.rate * h, a0 * h * h }, { end[0], end[1] * h, a1 * h * h });
    // In a short step z hardly changes, and round-off of the difference would turn its rate.
    const bool is_short = h < 1e-2 * longest_step;
    auto rate           = is_short ? cubic({ now.rate, a0 * h, 0. }, { end[1], a1 * h, 0. }) : differentiate(z);
    auto room           = z;
    for (double &c : rate)
      c *= direction;
    for (double &c : room)
      c *= -side;
    for (double &c : z)
      c *= side;
    room[0] += system.damper.reach;

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
          room, [this](const Values &v) { return system.damper.reach - side * v[0]; }, TableEvent::end);
    if (event != TableEvent::none)
      end = stepped(first);
    return first;
  }

  void TableMotion::check_locking(const double duration, const Values &end)
  {
    if (!system.damper.locking_margin || side * direction > 0)
      return;
    const auto margin = [this](const Values &v) { return system.damper.locking_margin(std::abs(v[0]), std::abs(v[1])); };
    if (margin(end) > 0.)
      return;
    const double at = falling_root([&](const double time) { return margin(stepped(time)); }, 0., duration);
    take(at, stepped(at));
    now.time += at;
    fail("the damper locks: friction holds the table whatever pulls it back. Try less friction, a smaller motion of the base or "
         "of "
         "the beginning, or levers with a smaller e");
  }

  /// Updates the peaks. The acceleration's is the extreme of a quartic through five instants of the step.
  void TableMotion::note_peaks(const TableState &from, const double duration)
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

  TableEvent TableMotion::turn()
  {
    last_force     = damper_force();
    now.rate       = 0.;
    const double y = std::abs(now.z);
    if (system.damper.locking_margin && system.damper.locking_margin(y, 0.) <= 0.)
      fail(
          "the damper locks where the table came to rest: friction holds it whatever pulls it back. Try less friction, a smaller "
          "motion of the base or of the beginning, or levers with a smaller e");
    set_out(way_out());
    return rests() ? TableEvent::stop : TableEvent::turn;
  }

  TableEvent TableMotion::advance_moving(const double until)
  {
    Values end;
    const double duration = accepted_step(until, end);
    TableEvent event      = TableEvent::none;
    const double taken    = step_to_event(duration, end, event);
    check_locking(taken, end);
    take(taken, end);
    now.time =
        event == TableEvent::none && now.time + taken >= step_end(until) * (1. - epsilon) ? step_end(until) : now.time + taken;
    events_at_once = taken > 1e-9 * longest_step ? 0 : events_at_once + 1;
    if (events_at_once > 100)
      fail("the table turns again and again at one instant. Try an Initial displacement that is a little different");
    if (event == TableEvent::end)
      fail(system.damper.end + ". Try a smaller motion of the base or of the beginning, more damping, or levers with a longer "
                               "way: a larger Geometry/Pivot distance");
    if (event == TableEvent::centre)
    {
      now.z = 0.;
      side  = direction;
    }
    return event == TableEvent::turn ? turn() : event;
  }
} // namespace sprag
