// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_speed.h"

#include "analysis/design/design_search.h"
#include "analytic/harmonic_balance.h"
#include "base/text.h"
#include "base/unknown.h"
#include "input/read.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    double table_speed(const Scene &lever, const double amplitude)
    {
      return 2. * M_PI * lever.isolation.base_frequency * amplitude;
    }

    /// Returns the largest amplitude of the table over a base that vibrates [mm]; NaN where the design has no such table, or no
    /// motion that the levers hold.
    double table_amplitude(const Scene &lever)
    {
      const auto &isolation = lever.isolation;
      if (!asks_for(lever.design, is_table_quantity) || isolation.base != BaseMotionType::harmonic)
        return unknown;
      const double omega = 2. * M_PI * isolation.base_frequency;
      double amplitude   = unknown;
      for (const auto &motion : harmonic_balance(isolation_system(lever), isolation.base_amplitude, omega))
        amplitude = std::fmax(amplitude, motion.amplitude);
      return amplitude > 0. ? amplitude : unknown;
    }

    double changed(const double value, const double by_closed_form, const double there)
    {
      return by_closed_form > 0. && there > 0. ? value * there / by_closed_form : value + there - by_closed_form;
    }
  } // namespace

  Scene at_table_speed(const Scene &design)
  {
    constexpr unsigned int most_rounds = 8;
    constexpr double same              = 0.01; // of the speed
    Scene result                       = design;
    const bool is_open = asks_for(design.design, is_table_quantity) && design.isolation.base == BaseMotionType::harmonic &&
                         design.specified.count("Drive/Speed") == 0 && design.drive.profile() != DriveProfile::table;
    for (unsigned int round = 0; is_open && round < most_rounds; ++round)
    {
      const auto found = best_lever(DesignProblem(result)).lever;
      if (!(found.rule.violation < 0.))
        break;
      const Scene lever      = variant(result, design_overrides(result, found));
      const double amplitude = table_amplitude(lever), speed = table_speed(lever, amplitude);
      if (!(std::abs(speed / lever.drive.peak_speed() - 1.) > same))
        break;
      result = variant(result, { override_text("Drive/Speed", speed) });
    }
    return result;
  }

  DesignSpeed design_speed(const Scene &lever, const std::vector<double> &values)
  {
    constexpr double slower = 0.1;
    const auto mu_at        = [&](const double speed) { return closed_form(lever, 0., speed).mu; };
    const double speed      = lever.drive.peak_speed();
    const double amplitude  = table_amplitude(lever);
    const double other      = std::isnan(amplitude) ? slower * speed : table_speed(lever, amplitude);
    DesignSpeed result      = { speed, mu_at(speed), other, mu_at(other), amplitude, lever.drive.maximum(), {}, {} };
    Scene there             = lever;
    if (result.mu > 0.)
      there.friction.factor *= result.other_mu / result.mu;
    if (const auto rule = hardest_rule(there, false); !(rule.violation < 0.))
    {
      result.broken_rule = rule.text;
      return result;
    }
    const auto by_closed_form = lever_quantities(lever), at_other = lever_quantities(there);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const auto &demand = lever.design.demanded[i];
      if (demand.term.quantity == DesignQuantity::parameter)
        continue;
      const double value  = changed(values[i], by_closed_form[demand.term.quantity], at_other[demand.term.quantity]);
      const double missed = demand_violation(demand, value);
      if (demand_violation(demand, values[i]) <= 1e-9 && missed > 1e-9)
        result.missed.push_back({ i, value, missed });
    }
    return result;
  }
} // namespace sprag
