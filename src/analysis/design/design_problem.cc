// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_problem.h"

#include "base/text.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// What a violation of a demand with the target 0 is measured by.
    double scale_of(const Demand &demand)
    {
      if (demand.term.quantity == DesignQuantity::growth_rate)
        return 100.;
      if (demand.target != 0.)
        return std::abs(demand.target);
      return demand.tolerance > 0. ? demand.tolerance : 1.;
    }

    double or_else(const double value, const double otherwise)
    {
      return std::isnan(value) ? otherwise : value;
    }

    constexpr double most_counted = 10.; ///< violation of what is far off or unknown

    double counted(const double violation)
    {
      return std::isnan(violation) ? most_counted : std::clamp(violation, -most_counted, most_counted);
    }

    double room_of(const Demand &demand, const double room)
    {
      return demand.kind == DemandKind::equal ? std::min(room, 0.25 * demand.tolerance / scale_of(demand)) : room;
    }

    std::vector<DesignQuantity> quantities_asked(const DesignSettings &design)
    {
      std::vector<DesignQuantity> asked;
      for (const auto &demand : design.demanded)
        asked.push_back(demand.term.quantity);
      for (const auto &aim : design.aims)
        asked.push_back(aim.term.quantity);
      return asked;
    }
  } // namespace

  double violation_of(const Demand &demand, const double value)
  {
    const double scale = scale_of(demand);
    if (demand.kind == DemandKind::at_most)
      return (value - demand.target) / scale;
    if (demand.kind == DemandKind::at_least)
      return (demand.target - value) / scale;
    return (std::abs(value - demand.target) - demand.tolerance) / scale;
  }

  double value_of(const DesignTerm &term, const Proposal &proposal)
  {
    return term.quantity == DesignQuantity::parameter ? proposal.parameters.at(term.parameter)
                                                      : proposal.quantities[term.quantity];
  }

  std::vector<std::string> overrides_of(const Scene &design, const Proposal &lever)
  {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < lever.parameters.size(); ++i)
      result.push_back(override_text(design.design.free_parameters[i].name, lever.parameters[i]));
    return result;
  }

  DesignProblem::DesignProblem(const Scene &scene)
      : given(scene)
      , input(std::make_unique<SceneSettings>())
      , asked(quantities_asked(scene.design))
  {
    input->scene        = given;
    const auto declared = scene_parameters(*input);
    for (const auto &parameter : given.design.free_parameters)
      free.push_back(*find_parameter(declared, parameter.name));
  }

  bool DesignProblem::is_dear() const
  {
    return dear || std::any_of(asked.begin(), asked.end(),
                               [](const DesignQuantity quantity)
                               { return is_of_table(quantity) && quantity != DesignQuantity::friction_ratio; });
  }

  const Scene &DesignProblem::scene_at(const std::vector<double> &parameters) const
  {
    for (std::size_t i = 0; i < free.size(); ++i)
      free[i].store(number_text(parameters[i]));
    if (std::any_of(given.design.free_parameters.begin(), given.design.free_parameters.end(),
                    [](const auto &parameter) { return parameter.name == "Friction/Factor"; }))
      input->scene.friction.factor = input->friction.factor;
    return input->scene;
  }

  Proposal DesignProblem::at(const std::vector<double> &place) const
  {
    Proposal result;
    const auto &bounds = given.design.free_parameters;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      result.parameters.push_back(bounds[i].from + std::clamp(place[i], 0., 1.) * (bounds[i].to - bounds[i].from));
    const Scene &scene = scene_at(result.parameters);
    ++*count;
    const bool is_judged_by_models = std::any_of(given.design.judged_by.begin(), given.design.judged_by.end(),
                                                 [](const DesignJudge judge) { return judge != DesignJudge::table; });
    result.rule                    = hardest_rule(scene, is_judged_by_models);
    if (result.rule.violation < 0.)
    {
      result.quantities = lever_quantities(scene);
      add_table_quantities(scene, asked, result.quantities);
      if (dear)
        dear(scene, result.quantities);
      for (const auto &[quantity, name, unit, definition] : design_quantities())
        result.quantities[quantity] =
            or_else(factors[quantity], 1.) * result.quantities[quantity] + or_else(differences[quantity], 0.);
    }
    for (const auto &demand : given.design.demanded)
      result.violations.push_back(violation_of(demand, value_of(demand.term, result)));
    return result;
  }

  void DesignProblem::correct(const DesignQuantity quantity, const double by_closed_form, const double found)
  {
    const bool by_factor  = by_closed_form > 0. && found > 0. && quantity != DesignQuantity::growth_rate;
    factors[quantity]     = by_factor ? found / by_closed_form : 1.;
    differences[quantity] = by_factor ? 0. : found - by_closed_form;
  }

  double DesignProblem::uncorrected(const DesignQuantity quantity, const double corrected) const
  {
    return (corrected - or_else(differences[quantity], 0.)) / or_else(factors[quantity], 1.);
  }

  std::vector<double> DesignProblem::place_of(const std::vector<double> &parameters) const
  {
    std::vector<double> place;
    const auto &bounds = given.design.free_parameters;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      place.push_back((parameters[i] - bounds[i].from) / (bounds[i].to - bounds[i].from));
    return place;
  }

  BoxProblem DesignProblem::box(const std::optional<DesignAim> &aim, const std::optional<std::size_t> &spared,
                                const std::optional<Demand> &limit) const
  {
    BoxProblem problem;
    std::vector<std::size_t> counting;
    for (std::size_t i = 0; i < given.design.demanded.size(); ++i)
      if (i != spared && (dear || given.design.demanded[i].term.quantity != DesignQuantity::growth_rate))
        counting.push_back(i);
    problem.dimension     = free.size();
    problem.n_constraints = 1 + counting.size() + (limit ? 1 : 0);
    problem.evaluate      = [this, aim, limit, counting](const std::vector<double> &place)
    {
      constexpr double least_room = 1e-6; // of the rules, which are strict
      const auto lever            = at(place);
      BoxProblem::Evaluation result{ most_counted, { counted(lever.rule.violation + least_room) } };
      const bool is_possible = lever.rule.violation < 0.;
      // What breaks a rule is farther away than what misses a demand, the more so the more it breaks it.
      const auto take = [&](const Demand &demand)
      {
        const double missed = violation_of(demand, value_of(demand.term, lever)) + room_of(demand, room);
        result.constraints.push_back(is_possible ? counted(missed) : counted(1. + lever.rule.violation));
      };
      for (const auto i : counting)
        take(given.design.demanded[i]);
      if (limit)
        take(*limit);
      if (aim && is_possible)
        result.objective = (aim->maximises ? -1. : 1.) * value_of(aim->term, lever);
      // A table that no lever holds is of no use, whatever else the lever is good for.
      const bool is_finite = std::all_of(given.design.aims.begin(), given.design.aims.end(),
                                         [&](const DesignAim &other) { return std::isfinite(value_of(other.term, lever)); });
      if (!is_finite)
      {
        result.objective           = most_counted;
        result.constraints.front() = std::max(result.constraints.front(), 1.);
      }
      return result;
    };
    return problem;
  }
} // namespace sprag
