// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "base/interrupt.h"
#include "program/result_writer.h"
#include "run/analyses.h"
#include "run/design_report.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace sprag
{
  namespace
  {
    constexpr double room_of_corrections = 1e-3; ///< as they are known to first order, and of a mesh with its ripple

    /// Proposes by the closed form and asks the judges.
    class DesignRun
    {
    public:
      DesignRun(const Scene &of_design, DesignFindings &found)
          : scene(of_design)
          , design(scene.design)
          , findings(found)
          , problem(scene)
          , judges(scene)
      {
      }

      void carry_out()
      {
        search([&] { findings.found = best_lever(problem); });
        require_lever();
        if (design.aims.size() > 1)
          search([&] { findings.front = front_of_aims(problem); });
        for (const auto judge : design.judged_by)
          ask(judge);
      }

    private:
      const Scene &scene;
      const DesignSettings &design;
      DesignFindings &findings;
      DesignProblem problem;
      DesignJudges judges;
      DesignQuantities overshoot; ///< in time, of the last lever that was followed; NaN: none

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
        findings.each_left_out = !problem.dear;
        if (findings.each_left_out)
          search([&] { findings.stopping = stopping_demands(problem); });
        findings.unmet = unmet_text(design, findings);
        throw AnalysisError(findings.unmet);
      }

      bool is_timed(const DesignJudge judge) const
      {
        return design.judges_in_time && judge != DesignJudge::table && judge == design.judged_by.back();
      }

      void ask(const DesignJudge judge)
      {
        for (unsigned int round = 1;; ++round)
        {
          auto judgement  = judges.judge(judge, findings.found->lever, is_timed(judge));
          judgement.round = round;
          findings.judgements.push_back(judgement);
          end_if_interrupted();
          if (judgement.passes(design.demanded))
            return;
          const bool is_last = round == design.rounds;
          if (is_last || (!judgement.failure.empty() && !misses_growth(judgement)))
          {
            findings.unmet = missed_text(design, judgement);
            throw AnalysisError(findings.unmet);
          }
          learn(judgement);
          propose_again();
        }
      }

      /// A lever less stable than demanded, or jamming; where the demand is kept or there is none a search cannot help.
      bool misses_growth(const Judgement &judgement) const
      {
        const double growth = judgement.found[DesignQuantity::growth_rate];
        return std::any_of(design.demanded.begin(), design.demanded.end(),
                           [&](const Demand &demand)
                           { return demand.term.quantity == DesignQuantity::growth_rate && violation_of(demand, growth) > 0.; });
      }

      /// From now on the closed form is corrected by what the judge found above it.
      void learn(const Judgement &judgement)
      {
        problem.room = room_of_corrections;
        for (const auto &[quantity, name, unit, definition] : design_quantities())
          if (quantity != DesignQuantity::growth_rate && !std::isnan(judgement.found[quantity]))
            problem.correct(quantity, problem.uncorrected(quantity, judgement.lever.quantities[quantity]),
                            in_time(quantity, judgement));
        if (misses_growth(judgement) || problem.dear)
          learn_growth(judgement);
      }

      /// What the judge found, or of a lever that was not followed in time what it is expected to become there.
      double in_time(const DesignQuantity quantity, const Judgement &judgement)
      {
        if (judgement.in_time)
          overshoot[quantity] = judgement.overshoot[quantity];
        const bool is_known = !judgement.in_time && !std::isnan(overshoot[quantity]);
        return judgement.found[quantity] * (is_known ? overshoot[quantity] : 1.);
      }

      /// The closed form knows no growth: the beam is asked about every lever, corrected by what a dearer judge found above it.
      void learn_growth(const Judgement &judgement)
      {
        if (judgement.judge != DesignJudge::beam)
        {
          const double of_beam = judges.growth_of_beam(problem.scene_at(judgement.lever.parameters));
          if (std::isfinite(of_beam) && std::isfinite(judgement.found[DesignQuantity::growth_rate]))
            problem.correct(DesignQuantity::growth_rate, of_beam, judgement.found[DesignQuantity::growth_rate]);
        }
        problem.dear = [this](const Scene &lever, DesignQuantities &quantities)
        { quantities[DesignQuantity::growth_rate] = judges.growth_of_beam(lever); };
      }

      void propose_again()
      {
        search([&] { findings.found = problem.dear ? best_stable_lever() : best_lever(problem); });
        require_lever();
      }

      /// The best lever of the closed form may be stable as it is. Otherwise the beam is asked about every one, first near the
      /// last that it was asked about.
      Found best_stable_lever()
      {
        std::optional<Proposal> near;
        if (!std::isnan(findings.found->lever.quantities[DesignQuantity::growth_rate]))
          near = findings.found->lever;
        DesignProblem::Dear dear;
        std::swap(dear, problem.dear);
        auto found = best_lever(problem);
        std::swap(dear, problem.dear);
        if (!found.meets_all)
          return found;
        found.lever          = problem.at(problem.place_of(found.lever.parameters));
        const bool is_stable = std::all_of(found.lever.violations.begin(), found.lever.violations.end(),
                                           [](const double violation) { return violation <= 0.; });
        return is_stable ? found : best_dear_lever(problem, near);
      }
    };

    void write_scene(const Scene &scene, const RunOptions &options, const Proposal &lever, const std::string &name)
    {
      auto changes = overrides_of(scene, lever);
      changes.insert(changes.end(), { "Analysis/Type=quasi-static", "Analysis/Model=closed form" });
      std::ofstream file(options.folder + '/' + name + ".prm");
      file << parameters_text(variant(scene, changes));
      if (!file)
        throw AnalysisError("cannot write " + name + ".prm");
    }

    /// Those of an earlier run in the same folder.
    void remove_scenes(const RunOptions &options)
    {
      const auto is_ours = [](const std::filesystem::path &path)
      { return path.extension() == ".prm" && path.filename().string().rfind("design-", 0) == 0; };
      std::vector<std::filesystem::path> ours;
      for (const auto &entry : std::filesystem::directory_iterator(options.folder))
        if (is_ours(entry.path()))
          ours.push_back(entry.path());
      for (const auto &path : ours)
        std::filesystem::remove(path);
    }

    /// The lever found, or the nearest, and those of the front, ready to run.
    void write_scenes(const Scene &scene, const RunOptions &options, const DesignFindings &findings)
    {
      if (findings.found && findings.found->lever.rule.violation < 0.)
        write_scene(scene, options, findings.found->lever, findings.unmet.empty() ? "design-best" : "design-nearest");
      for (std::size_t i = 0; i < findings.front.size(); ++i)
        write_scene(scene, options, findings.front[i], "design-front-" + std::to_string(i + 1));
    }
  } // namespace

  void run_design(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    const auto &design = scene.design;
    ResultWriter writer(scene, options, timer, design_columns(design));
    remove_scenes(options);
    DesignFindings findings;
    finish_in_any_case(
        [&] { DesignRun(scene, findings).carry_out(); },
        [&](const std::string &status)
        {
          if (findings.found)
            writer.append(design_row(design, findings.found->lever));
          for (const auto &lever : findings.front)
            writer.append(design_row(design, lever));
          write_scenes(scene, options, findings);
          writer.finish(status, { design_summary(design, findings), {}, design_groups(design, findings) }, warnings);
          if (!options.quiet)
            print_design(std::cout, design, findings);
        });
  }
} // namespace sprag
