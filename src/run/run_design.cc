// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_search.h"
#include "analysis/design/design_speed.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "base/text.h"
#include "base/unknown.h"
#include "input/read.h"
#include "program/output_folder.h"
#include "program/result_writer.h"
#include "report/summary_lines.h"
#include "results/page_tables.h"
#include "results/result_file.h"
#include "run/design_checks.h"
#include "run/run.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iosfwd>
#include <iostream>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace sprag
{
  namespace
  {
    /// Holds what a design has found until its end or failure.
    struct DesignFindings
    {
      std::optional<Found> found; ///< by the closed form; of the last round with its corrections
      std::vector<StoppingDemand> stopping;
      bool tried_without_each = false; ///< whether `stopping` is known
      std::vector<Proposal> front;     ///< of two aims
      std::vector<ModelCheck> checks;
      std::optional<DesignSpeed> speed; ///< of the lever found, if it is one that can slide
      std::string unmet;                ///< why there is no lever, sentences; empty: there is one
      std::size_t evaluations = 0;      ///< of the closed form
      double search_seconds   = 0.;     ///< CPU time of all searches
    };

    std::string unit_text(const std::string &unit)
    {
      return unit == "1" ? "" : ' ' + unit;
    }

    std::string term_unit(const DesignSettings &design, const DesignTerm &term)
    {
      return unit_text(term.quantity == DesignQuantity::parameter ? design.free_parameters[term.parameter].unit
                                                                  : design_quantity_info(term.quantity).unit);
    }

    /// Returns `value` of the closed form, or that of the last check model that computes the term for this lever.
    template <class Value>
    double last_known(const DesignTerm &term, const Proposal &lever, const DesignFindings &findings, double value,
                      const Value &by_check)
    {
      if (term.quantity != DesignQuantity::parameter)
        for (const auto &check : findings.checks)
          if (check.lever.parameters == lever.parameters && !std::isnan(check.found[term.quantity]))
            value = by_check(check);
      return value;
    }

    double best_known(const DesignTerm &term, const Proposal &lever, const DesignFindings &findings)
    {
      return last_known(term, lever, findings, term_value(term, lever),
                        [&](const ModelCheck &check) { return check.found[term.quantity]; });
    }

    /// Returns the values of the demands where they are missed most within Design/Tolerances.
    std::vector<double> worst_known(const DesignSettings &design, const DesignFindings &findings)
    {
      std::vector<double> values;
      for (const auto &demand : design.demanded)
        values.push_back(last_known(demand.term, findings.found->lever, findings, findings.found->lever.worst[values.size()],
                                    [&](const ModelCheck &check) { return check.worst(demand); }));
      return values;
    }

    std::string lever_text(const DesignSettings &design, const Proposal &lever)
    {
      std::string text;
      for (std::size_t i = 0; i < lever.parameters.size(); ++i)
        text += (i > 0 ? ", " : "") + design.free_parameters[i].name + " = " + rounded_text(lever.parameters[i]) +
                unit_text(design.free_parameters[i].unit);
      return text;
    }

    /// Returns the demands that a lever misses, the largest violation first.
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

    Group check_group(const DesignSettings &design, const std::vector<ModelCheck> &checks)
    {
      Group group{ "judgements", {}, {} };
      const auto add = [&](const ColumnInfo &info, const auto &value)
      { group.datasets.push_back(make_dataset(checks, info, value)); };
      const auto check_column = [](const std::string &name) { return page_column("judgements", name); };
      add(check_column("round"), [](const ModelCheck &check) { return static_cast<double>(check.round); });
      add(check_column("passes"), [&](const ModelCheck &check) { return check.passes(design.demanded) ? 1. : 0.; });
      add(check_column("in_time"), [](const ModelCheck &check) { return check.in_time ? 1. : 0.; });
      add(check_column("cpu_time"), [](const ModelCheck &check) { return check.cpu_seconds; });
      for (std::size_t i = 0; i < design.free_parameters.size(); ++i)
        add({ to_identifier(design.free_parameters[i].name), design.free_parameters[i].unit, design.free_parameters[i].name },
            [i](const ModelCheck &check) { return check.lever.parameters[i]; });
      for (const auto &info : design_quantities())
      {
        add({ to_identifier(info.name), info.unit, info.definition + ", by the judge" },
            [&](const ModelCheck &check) { return check.found[info.quantity]; });
        add({ "expected_" + to_identifier(info.name), info.unit, "as it was proposed, corrections included" },
            [&](const ModelCheck &check) { return check.lever.quantities[info.quantity]; });
      }
      group.texts = {
        make_texts(checks, "judge", "which", [](const ModelCheck &check) { return enumerator_name(check.check_model); }),
        make_texts(checks, "failure", "why it tells nothing", [](const ModelCheck &check) { return check.failure; })
      };
      return group;
    }

    Group demand_group(const DesignSettings &design, const DesignFindings &findings)
    {
      const auto &lever = findings.found->lever;
      std::vector<double> attainable(design.demanded.size(), unknown);
      for (const auto &stopping : findings.stopping)
        attainable[stopping.demand] = stopping.attainable;
      return { "demands",
               { make_dataset(design.demanded, { "value", "", "by the last judge that tells it, or the closed form" },
                              [&](const Demand &demand) { return best_known(demand.term, lever, findings); }),
                 { { "worst", "", "value that misses the demand most, of the combinations of Design/Tolerances" },
                   worst_known(design, findings),
                   {} },
                 { { "attainable", "", "nearest value with all others met; NaN: not stopping" }, attainable, {} } },
               { make_texts(design.demanded, "demand", "as it was given", [](const Demand &demand) { return demand.text; }) } };
    }

    /// Returns ", at worst 0.0979" of demands on a quantity where there are tolerances.
    std::string worst_text(const DesignSettings &design, const ModelCheck &check, const DesignQuantity quantity)
    {
      std::string text;
      for (const auto &demand : design.demanded)
        if (!check.at_corners.empty() && demand.term.quantity == quantity)
          text += ", at worst " + rounded_text(check.worst(demand));
      return text;
    }

    void print_checks(std::ostream &stream, const DesignSettings &design, const std::vector<ModelCheck> &checks)
    {
      for (const auto &check : checks)
      {
        const bool passes = check.passes(design.demanded);
        stream << "\nJudged by " << enumerator_name(check.check_model) << (check.in_time ? ", in time as well" : "") << ", round "
               << check.round << ", " << formatted("%.3g", check.cpu_seconds) << " CPU s: "
               << (passes                  ? "passes"
                   : check.failure.empty() ? "does not pass"
                                           : check.failure)
               << '\n';
        if (!passes)
          stream << "  " << lever_text(design, check.lever) << '\n';
        for (const auto &info : design_quantities())
          if (!std::isnan(check.found[info.quantity]) && asks_for(design, info.quantity))
            stream << "  " << padded(info.name, -34) << padded(rounded_text(check.found[info.quantity]), -14)
                   << (std::isnan(check.lever.quantities[info.quantity])
                           ? std::string()
                           : "expected " + rounded_text(check.lever.quantities[info.quantity]) + unit_text(info.unit))
                   << worst_text(design, check, info.quantity) << '\n';
      }
    }

    std::vector<ColumnInfo> design_columns(const DesignSettings &design)
    {
      std::vector<ColumnInfo> columns;
      for (const auto &parameter : design.free_parameters)
        columns.push_back({ to_identifier(parameter.name), parameter.unit, parameter.name });
      for (const auto &info : design_quantities())
        columns.push_back({ to_identifier(info.name), info.unit, info.definition });
      columns.push_back({ "largest_violation", "1", "of the demands, over their targets; <= 0: all met" });
      return columns;
    }

    /// Returns the values of the columns for a lever.
    std::vector<double> design_row(const Proposal &lever)
    {
      auto values = lever.parameters;
      for (const auto &info : design_quantities())
        values.push_back(lever.quantities[info.quantity]);
      double largest = -std::numeric_limits<double>::infinity();
      for (const double violation : lever.violations)
        largest = std::fmax(largest, violation); // passes over NaN
      values.push_back(lever.violations.empty() ? 0. : largest);
      return values;
    }

    /// Says which demands the lever misses at another speed.
    std::string other_missed_text(const DesignSettings &design, const DesignSpeed &speed)
    {
      const auto text = [&](const MissedDemand &missed)
      {
        const auto &demand = design.demanded[missed.demand];
        return '\'' + demand.text + "' (" + four_digits(missed.value) + term_unit(design, demand.term) + ')';
      };
      return speed.broken_rule.empty() ? boost::algorithm::join(mapped(speed.missed, text), ", ")
                                       : "the rule that " + speed.broken_rule;
    }

    /// Returns whether it misses them by more than levers on a bound of their demands do at any other speed.
    bool misses_much(const DesignSpeed &speed)
    {
      constexpr double much = 0.05;
      return !speed.broken_rule.empty() || std::any_of(speed.missed.begin(), speed.missed.end(),
                                                       [](const MissedDemand &missed) { return missed.violation > much; });
    }

    std::string other_speed_text(const DesignSpeed &speed)
    {
      return std::isnan(speed.amplitude) ? "a tenth" : "the table's own over its base";
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
        entries.push_back({ to_identifier(parameter.name), lever.parameters[i], parameter.unit, parameter.name });
      }
      for (const auto &info : design_quantities())
        if (const double value = best_known({ info.quantity, 0 }, lever, findings); !std::isnan(value))
          entries.push_back({ to_identifier(info.name), value, info.unit, info.definition });
      if (const auto &speed = findings.speed)
        append<Entry>(entries, { { "speed", speed->speed },
                                 { "mu", speed->mu },
                                 { "other_speed", speed->other },
                                 { "other_speed_is", other_speed_text(*speed) },
                                 { "other_mu", speed->other_mu },
                                 { "other_missed", other_missed_text(design, *speed) } });
      append<Entry>(entries, { { "meets_demands", findings.unmet.empty() ? 1. : 0. },
                               { "distance", findings.found->distance },
                               { "evaluations", static_cast<double>(findings.evaluations) },
                               { "cpu_time_search", findings.search_seconds },
                               { "front_points", static_cast<double>(findings.front.size()) },
                               { "judgements", static_cast<double>(findings.checks.size()) } });
      return entries;
    }

    /// Returns the groups /free, a row for each free parameter, /demands, and /judgements, a row for each lever proposed to a
    /// check model.
    std::vector<Group> design_groups(const DesignSettings &design, const DesignFindings &findings)
    {
      const auto &free          = design.free_parameters;
      std::vector<Group> groups = {
        { "free",
          { make_dataset(free, { "from", "", "smallest value admitted, in the parameter's unit" },
                         [](const FreeParameter &parameter) { return parameter.from; }),
            make_dataset(free, { "to", "", "largest value admitted" },
                         [](const FreeParameter &parameter) { return parameter.to; }) },
          { make_texts(free, "parameter", "that was free", [](const FreeParameter &parameter) { return parameter.name; }) } }
      };
      if (findings.found && !design.demanded.empty())
        groups.push_back(demand_group(design, findings));
      if (!findings.checks.empty())
        groups.push_back(check_group(design, findings.checks));
      return groups;
    }

    /// Says why no lever within the bounds meets all demands: which ones stop it, and the nearest lever.
    std::string unmet_text(const DesignSettings &design, const DesignFindings &findings)
    {
      std::string text = "No lever within the bounds meets all demands";
      if (!findings.checks.empty())
        text += " when the closed form is corrected by what the judge " + enumerator_name(findings.checks.back().check_model) +
                " found";
      text += ". ";
      if (findings.stopping.empty() && !(findings.found->lever.rule.violation < 0.))
        text += "Every lever breaks the rule that " + findings.found->lever.rule.text + ". ";
      else if (findings.stopping.empty() && findings.tried_without_each)
        text += "No single one stops it: two or more exclude others. ";
      for (const auto &[index, attainable, lever] : findings.stopping)
      {
        const auto &demand = design.demanded[index];
        text += "Without '" + demand.text + "' the others can be met; with them it comes to " + rounded_text(attainable) +
                term_unit(design, demand.term) + " at the nearest (" + lever_text(design, lever) + "). ";
      }
      text += "The lever that misses all by the least, " + formatted("%.3g", 100. * findings.found->distance) + " %, has " +
              lever_text(design, findings.found->lever);
      for (const auto i : missed_demands(design, findings.found->lever))
        text += "; '" + design.demanded[i].text + "' becomes " + rounded_text(findings.found->lever.worst[i]) +
                term_unit(design, design.demanded[i].term);
      return text;
    }

    /// Says by how much the lever that is kept misses the demands according to a check model, and why there is no further one.
    std::string missed_text(const DesignSettings &design, const ModelCheck &kept, const ModelCheck &last)
    {
      const std::string by = "by the judge " + enumerator_name(last.check_model);
      std::string text     = "No lever proposed meets all demands " + by;
      if (!last.failure.empty())
        text = "The lever proposed cannot be followed " + by + ": " + last.failure;
      if (!kept.failure.empty())
        return text;
      text += (last.failure.empty() ? "; that" : ". That") + std::string(" of round ") + std::to_string(kept.round) +
              " misses them by the least, " + formatted("%.3g", 100. * kept.violation(design.demanded)) + " %:";
      for (const auto &demand : design.demanded)
        if (demand.term.quantity != DesignQuantity::parameter)
          if (const double value = kept.worst(demand); demand_violation(demand, value) > 0.)
            text += " '" + demand.text + "' becomes " + rounded_text(value) + term_unit(design, demand.term) + ';';
      text.pop_back();
      return text + ". More Design/Rounds may help";
    }

    void print_design(std::ostream &stream, const DesignSettings &design, const DesignFindings &findings)
    {
      if (!findings.found)
        return;
      print_checks(stream, design, findings.checks);
      const auto &lever = findings.found->lever;
      stream << (findings.unmet.empty() ? "\nThe lever found" : "\nThe nearest lever") << ", " << findings.evaluations
             << " levers of the closed form, " << formatted("%.3g", findings.search_seconds) << " CPU s:\n";
      for (std::size_t i = 0; i < lever.parameters.size(); ++i)
        stream << "  " << padded(design.free_parameters[i].name, -34) << rounded_text(lever.parameters[i])
               << unit_text(design.free_parameters[i].unit) << '\n';
      for (const auto &aim : design.aims)
        stream << "  " << padded(aim.text, -34) << rounded_text(best_known(aim.term, lever, findings))
               << term_unit(design, aim.term) << '\n';
      const auto worst = worst_known(design, findings);
      for (std::size_t i = 0; i < worst.size(); ++i)
      {
        const auto &demand = design.demanded[i];
        stream << "  " << padded(demand.text, -34) << rounded_text(best_known(demand.term, lever, findings))
               << term_unit(design, demand.term) << (design.toleranced.empty() ? "" : ", at worst " + rounded_text(worst[i]))
               << (std::isnan(worst[i]) || demand_violation(demand, worst[i]) <= 1e-9 ? "" : "  MISSED") << '\n';
      }
      if (!findings.front.empty())
        stream << "  front of both aims: " << findings.front.size() << " levers\n";
    }

    constexpr double correction_margin = 1e-3; ///< covers corrections of first order and the ripple of a mesh

    /// Proposes levers by the closed form and checks them by the check models.
    struct DesignRun
    {
      const Scene &scene;
      DesignFindings &findings;
      const DesignSettings &design = scene.design;
      DesignProblem problem        = DesignProblem(scene);
      DesignChecks checks          = DesignChecks(scene);
      DesignQuantities overshoot   = {}; ///< in time, of the last lever that was followed; NaN: none

      void carry_out()
      {
        search([&] { findings.found = best_lever(problem); });
        require_lever();
        if (design.aims.size() > 1)
          search([&] { findings.front = pareto_front(problem); });
        for (const auto check_model : design.check_models)
          check_rounds(check_model);
      }

      template <class Search>
      void search(const Search &find)
      {
        const double begin = PhaseTimer::cpu_seconds();
        find();
        findings.search_seconds += PhaseTimer::cpu_seconds() - begin;
        findings.evaluations = problem.evaluations();
        end_if_interrupted();
      }

      void require_lever()
      {
        if (findings.found->meets_all)
          return;
        findings.tried_without_each = !problem.expensive_model;
        if (findings.tried_without_each)
          search([&] { findings.stopping = stopping_demands(problem); });
        findings.unmet = unmet_text(design, findings);
        throw AnalysisError(findings.unmet);
      }

      bool is_timed(const CheckModel check_model) const
      {
        return design.checks_in_time && check_model != CheckModel::table && check_model == design.check_models.back();
      }

      void check_rounds(const CheckModel check_model)
      {
        for (unsigned int round = 1;; ++round)
        {
          auto check  = checks.check(check_model, findings.found->lever, is_timed(check_model));
          check.round = round;
          findings.checks.push_back(check);
          end_if_interrupted();
          if (check.passes(design.demanded))
            return;
          const bool is_last = round == design.rounds;
          if (is_last || (!check.failure.empty() && !misses_growth(check)))
          {
            const auto &kept = nearest_check(findings.checks, design.demanded);
            findings.unmet   = missed_text(design, kept, check);
            if (kept.failure.empty())
              findings.found = { kept.lever, false, kept.violation(design.demanded) };
            throw AnalysisError(findings.unmet);
          }
          learn(check);
          search([&] { findings.found = problem.expensive_model ? best_stable_lever() : best_lever(problem); });
          require_lever();
        }
      }

      /// A lever less stable than demanded, or jamming; where the demand is kept or there is none a search cannot help.
      bool misses_growth(const ModelCheck &check) const
      {
        return std::any_of(design.demanded.begin(), design.demanded.end(),
                           [&](const Demand &demand) {
                             return demand.term.quantity == DesignQuantity::growth_rate &&
                                    demand_violation(demand, check.worst(demand)) > 0.;
                           });
      }

      /// Corrects the closed form from now on to the results of a check model.
      void learn(const ModelCheck &check)
      {
        problem.margin = correction_margin;
        for (std::size_t corner = 0; corner <= check.at_corners.size(); ++corner)
        {
          const auto ideal = problem.ideal_quantities(problem.scene_at_corner(check.lever.parameters, corner));
          for (const auto &[quantity, name, unit, definition] : design_quantities())
          {
            const double found = corner == 0 ? in_time(quantity, check) : check.at_corners[corner - 1][quantity];
            if (!std::isnan(ideal[quantity]) && !std::isnan(found))
              problem.correct(quantity, ideal[quantity], found, corner);
          }
        }
        if (misses_growth(check) || problem.expensive_model)
          learn_growth(check);
      }

      /// The check model's value, scaled by the overshoot in time known from other levers if this one was not followed in time.
      double in_time(const DesignQuantity quantity, const ModelCheck &check)
      {
        if (check.in_time)
          overshoot[quantity] = check.overshoot[quantity];
        const bool is_known = !check.in_time && !std::isnan(overshoot[quantity]);
        return check.found[quantity] * (is_known ? overshoot[quantity] : 1.);
      }

      /// Computes the growth rate of every lever by a beam, as the closed form has none, corrected to a more expensive check
      /// model.
      void learn_growth(const ModelCheck &check)
      {
        if (check.check_model != CheckModel::beam)
        {
          const double beam_rate = checks.beam_growth(problem.scene_at(check.lever.parameters));
          if (std::isfinite(beam_rate) && std::isfinite(check.found[DesignQuantity::growth_rate]))
            for (std::size_t corner = 0; corner <= check.at_corners.size(); ++corner)
              problem.correct(DesignQuantity::growth_rate, beam_rate, check.found[DesignQuantity::growth_rate], corner);
        }
        problem.expensive_model = [this](const Scene &lever, DesignQuantities &quantities)
        { quantities[DesignQuantity::growth_rate] = checks.beam_growth(lever); };
      }

      /// Returns the best lever of the closed form if it is stable. Otherwise searches with the growth rates of a beam, first
      /// near the last lever that has one.
      Found best_stable_lever()
      {
        std::optional<Proposal> near;
        if (!std::isnan(findings.found->lever.quantities[DesignQuantity::growth_rate]))
          near = findings.found->lever;
        DesignProblem::ExpensiveModel expensive_model;
        std::swap(expensive_model, problem.expensive_model);
        auto found = best_lever(problem);
        std::swap(expensive_model, problem.expensive_model);
        if (!found.meets_all)
          return found;
        found.lever          = problem.at(problem.search_point(found.lever.parameters));
        const bool is_stable = std::all_of(found.lever.violations.begin(), found.lever.violations.end(),
                                           [](const double violation) { return violation <= 0.; });
        return is_stable ? found : best_lever(problem, near);
      }
    };

    /// Adds the warnings of the last check model's scene, one if the table checked another lever before it, and those of the
    /// machine's own motion.
    void add_warnings(const DesignSettings &design, const DesignFindings &findings, Warnings &warnings)
    {
      if (const auto &speed = findings.speed; speed && findings.unmet.empty() && misses_much(*speed))
        warnings.push_back(make_warning("mu_of_one_speed", { four_digits(speed->mu), four_digits(speed->speed),
                                                             four_digits(speed->other), other_speed_text(*speed),
                                                             four_digits(speed->other_mu), other_missed_text(design, *speed) }));
      if (const auto &speed = findings.speed; speed && speed->amplitude > speed->stroke)
        warnings.push_back(make_warning("table_beyond_stroke", { mm(speed->amplitude), mm(speed->stroke) }));
      if (findings.checks.empty())
        return;
      const auto *const checked = last_check(findings.checks, findings.found->lever);
      const auto &last          = checked != nullptr ? *checked : findings.checks.back();
      append(warnings, last.warnings);
      const auto by_table = [](const ModelCheck &check) { return check.check_model == CheckModel::table; };
      const auto judged   = std::find_if(findings.checks.rbegin(), findings.checks.rend(), by_table);
      if (judged != findings.checks.rend() && judged->lever.parameters != last.lever.parameters)
        warnings.push_back(
            make_warning("judged_another_lever", { lever_text(design, judged->lever), enumerator_name(last.check_model) }));
    }

    /// Names the command that gives the values printed of a lever: by the closed form and by the last model that checked it.
    std::string command_text(const std::vector<ModelCheck> &checks, const Proposal &lever, const std::string &name)
    {
      std::string text          = "# By the closed form: sprag " + name + ".prm";
      const auto *const checked = last_check(checks, lever);
      if (checked == nullptr)
        return text;
      text += "; by the judge " + enumerator_name(checked->check_model) + " with";
      for (const auto &change : checked->changes)
        text += " --set '" + change + '\'';
      return text;
    }

    void write_scene(const Scene &scene, const RunOptions &options, const DesignFindings &findings, const Proposal &lever,
                     const std::string &name)
    {
      auto changes = design_overrides(scene, lever);
      changes.insert(changes.end(), { "Analysis/Type=quasi-static", "Analysis/Model=closed form" });
      std::ofstream file(options.folder + '/' + name + ".prm");
      file << command_text(findings.checks, lever, name) << '\n' << specified_parameters_text(variant(scene, changes));
      if (!file)
        throw AnalysisError("cannot write " + name + ".prm");
    }

    /// The lever found, or the nearest, and those of the front, ready to run.
    void write_scenes(const Scene &scene, const RunOptions &options, const DesignFindings &findings)
    {
      if (findings.found && findings.found->lever.rule.violation < 0.)
        write_scene(scene, options, findings, findings.found->lever, findings.unmet.empty() ? "design-best" : "design-nearest");
      for (std::size_t i = 0; i < findings.front.size(); ++i)
        write_scene(scene, options, findings, findings.front[i], "design-front-" + std::to_string(i + 1));
    }
  } // namespace

  void run_design(const Scene &input, const RunOptions &options, Warnings &warnings)
  {
    const Scene scene  = at_table_speed(input);
    const auto &design = scene.design;
    ResultWriter writer(scene, options, design_columns(design));
    remove_files(options.folder, [](const std::string &name) // of an earlier run
                 { return boost::starts_with(name, "design-") && boost::ends_with(name, ".prm"); });
    DesignFindings findings;
    finish_in_any_case(
        [&] {
          DesignRun{ scene, findings }.carry_out();
        },
        [&](const std::string &status)
        {
          if (findings.found)
          {
            const auto &lever = findings.found->lever;
            writer.append(design_row(lever));
            if (lever.rule.violation < 0.)
              findings.speed = design_speed(variant(scene, design_overrides(scene, lever)), worst_known(design, findings));
          }
          for (const auto &lever : findings.front)
            writer.append(design_row(lever));
          write_scenes(scene, options, findings);
          if (!options.quiet)
            print_design(std::cout, design, findings);
          add_warnings(design, findings, warnings);
          writer.finish(status, { design_summary(design, findings), {}, design_groups(design, findings) }, warnings);
        });
  }
} // namespace sprag
