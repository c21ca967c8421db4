// SPDX-License-Identifier: GPL-3.0-only
#include "run/design_report.h"

#include "base/append.h"
#include "base/text.h"
#include "base/unknown.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace sprag
{
  namespace
  {
    std::string unit_text(const std::string &unit)
    {
      return unit == "1" ? "" : ' ' + unit;
    }

    std::string unit_of(const DesignSettings &design, const DesignTerm &term)
    {
      return term.quantity == DesignQuantity::parameter ? design.free_parameters[term.parameter].unit
                                                        : info_of(term.quantity).unit;
    }

    /// What the last judge that tells a quantity found; by the closed form where none does.
    double best_known(const DesignTerm &term, const Proposal &lever, const DesignFindings &findings)
    {
      double value = value_of(term, lever);
      if (term.quantity != DesignQuantity::parameter)
        for (const auto &judgement : findings.judgements)
          if (judgement.lever.parameters == lever.parameters && !std::isnan(judgement.found[term.quantity]))
            value = judgement.found[term.quantity];
      return value;
    }

    std::string lever_text(const DesignSettings &design, const Proposal &lever)
    {
      std::string text;
      for (std::size_t i = 0; i < lever.parameters.size(); ++i)
        text += (i > 0 ? ", " : "") + design.free_parameters[i].name + " = " + rounded_text(lever.parameters[i]) +
                unit_text(design.free_parameters[i].unit);
      return text;
    }

    std::string padded(std::string text, const std::size_t width)
    {
      text.resize(std::max(width, text.size()), ' ');
      return text;
    }

    /// Demands in the order of how much a lever misses them.
    std::vector<std::size_t> missed_demands(const DesignSettings &design, const Proposal &lever)
    {
      constexpr double met = 1e-6;
      std::vector<std::size_t> missed;
      for (std::size_t i = 0; i < design.demanded.size(); ++i)
        if (lever.violations[i] > met)
          missed.push_back(i);
      std::sort(missed.begin(), missed.end(),
                [&](const auto a, const auto b) { return lever.violations[a] > lever.violations[b]; });
      return missed;
    }

    Group judgement_group(const DesignSettings &design, const std::vector<Judgement> &judgements)
    {
      Group group{ "judgements", {}, {} };
      const auto add = [&](const ColumnInfo &info, const auto &value)
      { group.datasets.push_back(dataset_of(judgements, info, value)); };
      add({ "round", "1", "of this judge" }, [](const Judgement &judgement) { return static_cast<double>(judgement.round); });
      add({ "passes", "1", "1: it meets what is demanded of what the judge tells" },
          [&](const Judgement &judgement) { return judgement.passes(design.demanded) ? 1. : 0.; });
      add({ "in_time", "1", "1: the drive was followed in time as well" },
          [](const Judgement &judgement) { return judgement.in_time ? 1. : 0.; });
      add({ "cpu_time", "s", "of the judge" }, [](const Judgement &judgement) { return judgement.cpu_seconds; });
      for (std::size_t i = 0; i < design.free_parameters.size(); ++i)
        add({ identifier_of(design.free_parameters[i].name), design.free_parameters[i].unit, design.free_parameters[i].name },
            [i](const Judgement &judgement) { return judgement.lever.parameters[i]; });
      for (const auto &info : design_quantities())
      {
        add({ identifier_of(info.name), info.unit, info.definition + ", by the judge" },
            [&](const Judgement &judgement) { return judgement.found[info.quantity]; });
        add({ "expected_" + identifier_of(info.name), info.unit, "as it was proposed, corrections included" },
            [&](const Judgement &judgement) { return judgement.lever.quantities[info.quantity]; });
      }
      TextDataset judge{ "judge", "which", {} }, failure{ "failure", "why it tells nothing", {} };
      for (const auto &judgement : judgements)
      {
        judge.values.push_back(judge_name(judgement.judge));
        failure.values.push_back(judgement.failure);
      }
      group.texts = { judge, failure };
      return group;
    }

    Group demand_group(const DesignSettings &design, const DesignFindings &findings)
    {
      const auto &lever = findings.found->lever;
      Group group{ "demands", {}, { { "demand", "as it was given", {} } } };
      std::vector<std::size_t> indices;
      for (std::size_t i = 0; i < design.demanded.size(); ++i)
      {
        indices.push_back(i);
        group.texts.front().values.push_back(design.demanded[i].text);
      }
      group.datasets.push_back(dataset_of(indices, { "value", "", "by the last judge that tells it, or the closed form" },
                                          [&](const std::size_t i)
                                          { return best_known(design.demanded[i].term, lever, findings); }));
      group.datasets.push_back(dataset_of(indices, { "attainable", "", "nearest value with all others met; NaN: not stopping" },
                                          [&](const std::size_t i)
                                          {
                                            for (const auto &demand_that_stops : findings.stopping)
                                              if (demand_that_stops.demand == i)
                                                return demand_that_stops.attainable;
                                            return unknown;
                                          }));
      return group;
    }

    bool is_asked_for(const DesignSettings &design, const DesignQuantity quantity)
    {
      const auto is_it = [&](const auto &asked) { return asked.term.quantity == quantity; };
      return std::any_of(design.demanded.begin(), design.demanded.end(), is_it) ||
             std::any_of(design.aims.begin(), design.aims.end(), is_it);
    }

    void print_judgements(std::ostream &stream, const DesignSettings &design, const std::vector<Judgement> &judgements)
    {
      for (const auto &judgement : judgements)
      {
        const bool passes = judgement.passes(design.demanded);
        stream << "\nJudged by " << judge_name(judgement.judge) << (judgement.in_time ? ", in time as well" : "") << ", round "
               << judgement.round << ", " << formatted("%.3g", judgement.cpu_seconds) << " CPU s: "
               << (passes                      ? "passes"
                   : judgement.failure.empty() ? "does not pass"
                                               : judgement.failure)
               << '\n';
        if (!passes)
          stream << "  " << lever_text(design, judgement.lever) << '\n';
        for (const auto &info : design_quantities())
          if (!std::isnan(judgement.found[info.quantity]) && is_asked_for(design, info.quantity))
            stream << "  " << padded(info.name, 34) << padded(rounded_text(judgement.found[info.quantity]), 14)
                   << (std::isnan(judgement.lever.quantities[info.quantity])
                           ? std::string()
                           : "expected " + rounded_text(judgement.lever.quantities[info.quantity]) + unit_text(info.unit))
                   << '\n';
      }
    }
  } // namespace

  std::vector<ColumnInfo> design_columns(const DesignSettings &design)
  {
    std::vector<ColumnInfo> columns;
    for (const auto &parameter : design.free_parameters)
      columns.push_back({ identifier_of(parameter.name), parameter.unit, parameter.name });
    for (const auto &info : design_quantities())
      columns.push_back({ identifier_of(info.name), info.unit, info.definition });
    columns.push_back({ "largest_violation", "1", "of the demands, over their targets; <= 0: all met" });
    return columns;
  }

  std::vector<double> design_row(const DesignSettings &, const Proposal &lever)
  {
    auto values = lever.parameters;
    for (const auto &info : design_quantities())
      values.push_back(lever.quantities[info.quantity]);
    double largest = -std::numeric_limits<double>::infinity();
    for (const double violation : lever.violations)
      if (!std::isnan(violation))
        largest = std::max(largest, violation);
    values.push_back(lever.violations.empty() ? 0. : largest);
    return values;
  }

  std::vector<Entry> design_summary(const DesignSettings &design, const DesignFindings &findings)
  {
    std::vector<Entry> entries;
    if (!findings.found)
      return entries;
    const auto &lever = findings.found->lever;
    for (std::size_t i = 0; i < lever.parameters.size(); ++i)
    {
      const auto &parameter = design.free_parameters[i];
      entries.push_back({ identifier_of(parameter.name), lever.parameters[i], parameter.unit, parameter.name });
    }
    for (const auto &info : design_quantities())
      if (const double value = best_known({ info.quantity, 0 }, lever, findings); !std::isnan(value))
        entries.push_back({ identifier_of(info.name), value, info.unit, info.definition });
    append<Entry>(entries,
                  { { "meets_demands", findings.unmet.empty() ? 1. : 0., "1", "1: the lever meets all demands" },
                    { "distance", findings.found->distance, "1", "largest violation of a demand over its target; 0: none" },
                    { "evaluations", static_cast<double>(findings.evaluations), "1", "of the closed form" },
                    { "cpu_time_search", findings.search_seconds, "s", "of all searches" },
                    { "front_points", static_cast<double>(findings.front.size()), "1", "levers that none beats in both aims" },
                    { "judgements", static_cast<double>(findings.judgements.size()), "1", "levers proposed to judges" } });
    return entries;
  }

  std::vector<Group> design_groups(const DesignSettings &design, const DesignFindings &findings)
  {
    std::vector<Group> groups;
    if (findings.found && !design.demanded.empty())
      groups.push_back(demand_group(design, findings));
    if (!findings.judgements.empty())
      groups.push_back(judgement_group(design, findings.judgements));
    return groups;
  }

  std::string unmet_text(const DesignSettings &design, const DesignFindings &findings)
  {
    std::string text = "No lever within the bounds meets all demands";
    if (!findings.judgements.empty())
      text += " when the closed form is corrected by what the judge " + judge_name(findings.judgements.back().judge) + " found";
    text += ". ";
    if (findings.stopping.empty() && !(findings.found->lever.rule.violation < 0.))
      text += "Every lever breaks the rule that " + findings.found->lever.rule.text + ". ";
    else if (findings.stopping.empty() && findings.each_left_out)
      text += "No single one stops it: two or more exclude others. ";
    for (const auto &[index, attainable, lever] : findings.stopping)
    {
      const auto &demand = design.demanded[index];
      text += "Without '" + demand.text + "' the others can be met; with them it comes to " + rounded_text(attainable) +
              unit_text(unit_of(design, demand.term)) + " at the nearest (" + lever_text(design, lever) + "). ";
    }
    text += "The lever that misses all by the least, " + formatted("%.3g", 100. * findings.found->distance) + " %, has " +
            lever_text(design, findings.found->lever);
    for (const auto i : missed_demands(design, findings.found->lever))
      text += "; '" + design.demanded[i].text + "' becomes " +
              rounded_text(value_of(design.demanded[i].term, findings.found->lever)) +
              unit_text(unit_of(design, design.demanded[i].term));
    return text;
  }

  std::string missed_text(const DesignSettings &design, const Judgement &judgement)
  {
    const std::string by = "by the judge " + judge_name(judgement.judge);
    if (!judgement.failure.empty())
      return "The lever proposed cannot be followed " + by + ": " + judgement.failure;
    std::string text = "No lever proposed meets all demands " + by + "; of the last one";
    for (const auto &demand : design.demanded)
      if (demand.term.quantity != DesignQuantity::parameter)
        if (const double value = judgement.found[demand.term.quantity]; violation_of(demand, value) > 0.)
          text += " '" + demand.text + "' becomes " + rounded_text(value) + unit_text(unit_of(design, demand.term)) + ';';
    text.pop_back();
    return text + ". More Design/Rounds may help";
  }

  void print_design(std::ostream &stream, const DesignSettings &design, const DesignFindings &findings)
  {
    if (!findings.found)
      return;
    const auto &lever = findings.found->lever;
    stream << (findings.unmet.empty() ? "\nThe lever found" : "\nThe nearest lever") << ", " << findings.evaluations
           << " levers of the closed form, " << formatted("%.3g", findings.search_seconds) << " CPU s:\n";
    for (std::size_t i = 0; i < lever.parameters.size(); ++i)
      stream << "  " << padded(design.free_parameters[i].name, 34) << rounded_text(lever.parameters[i])
             << unit_text(design.free_parameters[i].unit) << '\n';
    for (const auto &aim : design.aims)
      stream << "  " << padded(aim.text, 34) << rounded_text(best_known(aim.term, lever, findings))
             << unit_text(unit_of(design, aim.term)) << '\n';
    for (const auto &demand : design.demanded)
    {
      const double value = best_known(demand.term, lever, findings);
      stream << "  " << padded(demand.text, 34) << rounded_text(value) << unit_text(unit_of(design, demand.term))
             << (std::isnan(value) || violation_of(demand, value) <= 1e-9 ? "" : "  MISSED") << '\n';
    }
    if (!findings.front.empty())
      stream << "  front of both aims: " << findings.front.size() << " levers\n";
    print_judgements(stream, design, findings.judgements);
  }
} // namespace sprag
