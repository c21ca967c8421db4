#include "analysis/isolation/lever_table.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_iterations   = 25;
    constexpr unsigned int most_halvings     = 12; ///< of Time/Step
    constexpr unsigned int errors_of_growth  = 8;  ///< small ones in a row before a step is doubled
    constexpr double small_error             = 1. / 24.;
    constexpr double steps_of_natural_period = 200.;

    /// Behind its rest no lever follows the cylinder so far: there the place of the cylinder does not matter [mm].
    constexpr double out_of_contact = -10.;

    /// Without the last digits, so that steps of equal duration are so to the last bit and what a model prepares for one serves
    /// again.
    double rounded(const double duration)
    {
      int exponent          = 0;
      const double mantissa = std::frexp(duration, &exponent);
      return std::ldexp(std::round(std::ldexp(mantissa, 28)), exponent - 28);
    }

    constexpr double same_place = 1e-7; ///< of the cylinder for a lever that touches nothing [mm]

    /// Damping may take all pressure from a contact that is still closed.
    bool touches(const Row &row)
    {
      return row[Column::P] > 0. || row[Column::penetration] > 0. || row[Column::indentation] > 0.;
    }

    double sum_of(const StoredEnergy &energy)
    {
      return energy.kinetic + energy.spring + energy.elastic + energy.support + energy.contact;
    }
  } // namespace

  LeverTable::LeverTable(const Scene &scene, DynamicModel &outward, DynamicModel &inward, const TransientSettings &given)
      : m(scene.isolation.mass)
      , K(scene.isolation.stiffness)
      , levers(scene.isolation.levers)
      , settings(given)
      , motion_of_base(base_motion(scene.isolation))
      , largest_z(scene.drive.maximum())
      , sides{ { { outward, 1, {}, {}, true }, { inward, -1, {}, {}, true } } }
      , step(given.time.step)
      , tangent(given.contact_stiffness)
  {
    now.z    = scene.isolation.initial_displacement;
    now.rate = scene.isolation.initial_velocity;
    for (auto &side : sides)
    {
      const auto at = drive_of(side, 0., now.z, now.rate);
      side.motion   = side.model.initial_motion({ 0., std::max(0., at.x), 0., 0. });
      Row row;
      side.model.observe(side.motion, row);
      side.stored = side.model.stored_energy(side.motion);
      force += side.sign * levers * row.drive_force();
      side.motion.drive = at;
    }
    begin();
  }

  BasePoint LeverTable::base() const
  {
    return motion_of_base.at(now.time, piece);
  }

  DrivePoint LeverTable::drive_of(const Side &side, const double time, const double z, const double rate) const
  {
    const double x = side.sign * z;
    return x < out_of_contact ? DrivePoint{ time, out_of_contact, 0., 0. } : DrivePoint{ time, x, side.sign * rate, 0. };
  }

  /// What a lever that touches nothing did in the trial before holds for this one as well where both end at the same place.
  std::optional<LeverTable::Trial> LeverTable::tried(const double h, const double way_of_table, std::optional<Trial> before)
  {
    auto weights        = generalised_alpha(settings.time.spectral_radius, h);
    weights.wants_error = settings.time.tolerance > 0.;
    const double z = now.z + way_of_table, rate = 2. * way_of_table / h - now.rate;
    Trial trial{ z, rate, 0., 0., {}, {}, {} };
    double row_force = 0.;
    for (unsigned int i = 0; i < sides.size(); ++i)
    {
      auto &side    = sides[i];
      const auto to = drive_of(side, now.time + h, z, rate);
      auto &outcome = trial.levers[i];
      if (before && !before->touches[i] && !side.touches && std::abs(before->z - z) < same_place)
      {
        outcome               = std::move(before->levers[i]);
        outcome.motion->drive = to;
        trial.stored[i]       = before->stored[i];
        continue;
      }
      outcome          = side.model.step(side.motion, to, weights);
      const double way = to.x - side.motion.drive.x;
      if (!outcome.motion)
        return {};
      trial.stored[i] = side.model.stored_energy(*outcome.motion);
      Row row;
      side.model.observe(*outcome.motion, row);
      row_force += side.sign * levers * row.drive_force();
      trial.touches[i] = touches(row);
      trial.force += way != 0. ? side.sign * levers * outcome.work.drive / way : side.sign * levers * row.drive_force();
    }
    const double base_change = motion_of_base.at(now.time + h, piece).v - base().v;
    trial.unbalanced         = m * (rate - now.rate + base_change) / h + 0.5 * K * (z + now.z) + trial.force;
    trial.force              = row_force;
    return trial;
  }

  /// Newton's method for the table's way; the levers' tangent comes from the last two tried.
  std::optional<LeverTable::Trial> LeverTable::solved(const double h)
  {
    const double inertia = 2. * m / (h * h);
    double way           = h * now.rate + 0.5 * h * h * (acceleration() - base().a);
    double last_way = 0., last = 0.;
    std::optional<Trial> trial;
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      ++iterations;
      trial = tried(h, way, std::move(trial));
      if (!trial)
        return {};
      const double scale = std::abs(K * trial->z) + std::abs(trial->force) + std::abs(m * base().a) + settings.force_scale;
      if (std::abs(trial->unbalanced) <= 1e-8 * scale)
        return trial;
      if (i > 0 && way != last_way)
        tangent = (trial->unbalanced - last) / (way - last_way) - inertia - 0.5 * K;
      last     = trial->unbalanced;
      last_way = way;
      way -= trial->unbalanced / std::max(inertia + 0.5 * K + tangent, 0.5 * inertia);
    }
    return {};
  }

  /// Of levers that touch: swinging out of contact the others move nothing.
  double LeverTable::error_of(const Trial &trial) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < sides.size(); ++i)
      if (trial.touches[i] || sides[i].touches)
        largest = std::max(largest, trial.levers[i].error);
    return largest * settings.contact_stiffness / settings.force_scale / std::pow(0.5 * settings.time.tolerance, 1.5);
  }

  TableEvent LeverTable::advance(const double until)
  {
    const bool adapts    = settings.time.tolerance > 0.;
    const double longest = adapts
                               ? std::min(2. * M_PI * std::sqrt(m / K), motion_of_base.shortest_period) / steps_of_natural_period
                               : settings.time.step;
    while (piece < motion_of_base.kinks.size() && motion_of_base.kinks[piece] <= now.time)
      ++piece;
    const double end = piece < motion_of_base.kinks.size() ? std::min(until, motion_of_base.kinks[piece]) : until;
    // Instants that differ by round-off are one.
    if (end - now.time < 1e-9 * settings.time.step)
    {
      now.time = end;
      return TableEvent::none;
    }
    for (;;)
    {
      // Whole steps up to the end, so that none is a sliver; few different durations.
      const double room = end - now.time, parts = std::max(1., std::ceil(room / std::min(step, longest) - 1e-6));
      const double h = rounded(room / parts);
      std::optional<Trial> trial;
      std::string failure = "no balance of table and levers is found";
      try
      {
        trial = solved(h);
      }
      catch (const AnalysisError &error)
      {
        failure = error.what();
      }
      const double error = trial && adapts ? error_of(*trial) : 0.;
      const bool is_last = step < std::ldexp(settings.time.step, 1 - static_cast<int>(most_halvings));
      if (trial && (error <= 1. || is_last))
      {
        const TableState before = now;
        accept(h, *trial);
        now.time     = parts == 1. ? end : now.time;
        small_errors = error < small_error ? small_errors + 1 : 0;
        if (small_errors >= errors_of_growth && step < longest)
        {
          step *= 2.;
          small_errors = 0;
        }
        return event_of(before);
      }
      if (is_last)
        throw AnalysisError("no step beyond t = " + rounded_text(now.time) + " s (z = " + mm(now.z) + "): " + failure +
                            ". Try a larger Time/Tolerance or a smaller Contact/Stiffness");
      step *= 0.5;
    }
  }

  void LeverTable::accept(const double h, Trial &trial)
  {
    const auto base_before = base();
    const double a_before = acceleration(), w = 2. * M_PI * motion_of_base.frequency, t = now.time;
    const double mean_force = -m * ((trial.rate - now.rate) + motion_of_base.at(t + h, piece).v - base_before.v) / h;
    for (unsigned int i = 0; i < sides.size(); ++i)
    {
      const auto &work = trial.levers[i].work;
      now.dissipated += levers * (work.friction + work.damping + work.algorithmic);
      sides[i].motion  = std::move(*trial.levers[i].motion);
      sides[i].stored  = trial.stored[i];
      sides[i].touches = trial.touches[i];
    }
    now.z    = trial.z;
    now.rate = trial.rate;
    force    = trial.force;
    now.time = t + h;
    ++steps;
    const auto base_behind = base();
    const double a_behind  = acceleration();
    now.base_work -= mean_force * h * 0.5 * (base_before.v + base_behind.v);
    const auto add = [h](double &sum, const double before, const double behind) { sum += 0.5 * h * (before + behind); };
    add(now.square, a_before * a_before, a_behind * a_behind);
    add(now.cosine, a_before * std::cos(w * t), a_behind * std::cos(w * now.time));
    add(now.sine, a_before * std::sin(w * t), a_behind * std::sin(w * now.time));
    add(now.base_square, base_before.a * base_before.a, base_behind.a * base_behind.a);
    peak_acceleration = std::max(peak_acceleration, std::abs(a_behind));
    peak_displacement = std::max(peak_displacement, std::abs(now.z));
    peak_base         = std::max(peak_base, std::abs(base_behind.a));
    if (std::abs(now.z) > largest_z)
      throw AnalysisError("At t = " + rounded_text(now.time) + " s, z = " + mm(now.z) + ": the levers are made for a way of " +
                          mm(largest_z) +
                          ". Try a larger Drive/Stroke, a smaller motion of the base or of the beginning, or more damping");
  }

  TableEvent LeverTable::event_of(const TableState &before) const
  {
    if (before.rate * now.rate < 0.)
      return TableEvent::turn;
    return before.z * now.z < 0. ? TableEvent::centre : TableEvent::none;
  }

  double LeverTable::damper_energy() const
  {
    return levers * (sum_of(sides[0].stored) + sum_of(sides[1].stored));
  }

  double LeverTable::energy() const
  {
    const double speed = now.rate + base().v;
    return 0.5 * m * speed * speed + 0.5 * K * now.z * now.z + damper_energy();
  }

} // namespace sprag
