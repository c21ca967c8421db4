// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/held_run.h"

#include "base/errors.h"
#include "base/system/interrupt.h"
#include "base/text.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_halvings = 12;

    [[noreturn]] void give_up(const DrivePoint &at, const double dt)
    {
      throw AnalysisError("no step beyond t = " + rounded_text(at.time) + " s (held at x = " + mm(at.x) +
                          "): Newton's method does not converge even in a step of " + rounded_text(dt) +
                          " s. Try more Sprag slip/Steps per period, or a smaller Contact/Stiffness or Contact/Penalty.");
    }
  } // namespace

  DrivePath held_path(const DrivePoint &from, const HeldSlide &slide)
  {
    return [from, x = slide.drive.x, speed = slide.speed](const double time) -> DrivePoint {
      return { time, x, 0., 0., from.surface + speed * (time - from.time) };
    };
  }

  DrivePath moving_path(const DrivePoint &from, const HeldSlide &begin, const HeldSlide &end, const double duration)
  {
    const double dx = end.drive.x - begin.drive.x;
    // Speed of the slip, and the slip by a motion of the centre over that motion; both between the slides by straight lines.
    const double speed = begin.speed, d_speed = end.speed - speed;
    const double ratio = speed / begin.drive.v, d_ratio = end.speed / end.drive.v - ratio;
    return [=](const double time) -> DrivePoint
    {
      const double u       = std::min((time - from.time) / duration, 1.);
      const double beyond  = time - from.time - u * duration;
      const double s       = u * u * u * (10. + u * (-15. + 6. * u));
      const double rate    = 30. * u * u * (1. - u) * (1. - u) / duration;
      const double change  = 60. * u * (1. - u) * (1. - 2. * u) / (duration * duration);
      const double slipped = duration * (speed * u + d_speed * u * u * u * u * (2.5 + u * (-3. + u)));
      const double by_move = dx * s * (ratio + 0.5 * d_ratio * s);
      return { time, begin.drive.x + dx * s, dx * rate, dx * change,
               from.surface + slipped - by_move + (speed + d_speed) * beyond };
    };
  }

  void HeldRun::begin(Motion motion)
  {
    const auto energy = model.stored_energy(motion);
    resume({ std::move(motion), energy });
  }

  void HeldRun::resume(RunState state)
  {
    worst = ledger();
    if (account)
      state.motion.drive.time = now.motion.drive.time;
    now = std::move(state);
    forces.begin(now.motion.forces);
    account.emplace(now.energy);
  }

  const Row &HeldRun::step(const DrivePath &path)
  {
    end_if_interrupted();
    const auto &at          = now.motion.drive;
    const double x          = at.x;
    const auto iterations   = advance(path, dt, 0);
    row                     = Row(at);
    row[Column::step]       = at.x - x;
    row[Column::time_step]  = dt;
    row[Column::iterations] = iterations;
    model.observe(now.motion, row);
    account->fill(row);
    ++count;
    return row;
  }

  unsigned int HeldRun::advance(const DrivePath &path, const double duration, const unsigned int halvings)
  {
    const double time   = now.motion.drive.time;
    auto weights        = generalised_alpha(spectral_radius, duration);
    weights.wants_error = false;
    now.motion.forces   = forces.guess(duration);
    auto outcome        = model.step(now.motion, path(time + duration), weights);
    if (outcome.motion)
    {
      now.motion = std::move(*outcome.motion);
      forces.accept(now.motion.forces, duration);
      now.energy = model.stored_energy(now.motion);
      account->add(time + duration, now.energy, outcome.work);
      return outcome.iterations;
    }
    if (halvings == most_halvings)
      give_up(now.motion.drive, duration);
    const auto first = advance(path, 0.5 * duration, halvings + 1);
    return outcome.iterations + first + advance(path, 0.5 * duration, halvings + 1);
  }

  bool HeldRun::slides(const double speed) const
  {
    const auto sticks = [speed](const ContactHistory &point)
    { return point.traction[0] != 0. && point.step > 0. && !(point.slip_speed[0] * speed > 0.); };
    return std::none_of(now.motion.contact.begin(), now.motion.contact.end(), sticks);
  }

  LedgerReport HeldRun::ledger() const
  {
    return account && account->report().share() > worst.share() ? account->report() : worst;
  }
} // namespace sprag
