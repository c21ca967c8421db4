// SPDX-License-Identifier: GPL-3.0-only
#include "program/steps_in_time.h"

#include "base/append.h"
#include "report/transient_report.h"

#include <algorithm>
#include <iostream>

namespace sprag
{
  void record_steps(const Scene &scene, Recorder &recorder, PhaseTimer &timer, Warnings &warnings,
                    const std::vector<Entry> &facts, const std::function<TransientReport()> &steps,
                    const std::function<void()> &complete)
  {
    TransientReport report;
    double seconds = 0.;
    finish_in_any_case(
        [&]
        {
          const PhaseTimer::Scope scope(timer, "steps_and_output");
          const double begin = PhaseTimer::cpu_seconds();
          report             = steps();
          seconds            = PhaseTimer::cpu_seconds() - begin;
          check_ledger(scene, report.ledger);
        },
        [&](const std::string &status)
        {
          complete();
          const double taken = static_cast<double>(report.steps) - static_cast<double>(recorder.steps_taken_over());
          const double rate  = seconds > 0. ? std::max(0., taken) / seconds : 0.;
          const auto ending  = status_at_end(status);
          recorder.finish(ending, joined(facts, { { "steps_per_cpu_second", rate } }), warnings);
          if (ending != status)
            throw AnalysisError(ending);
        });
  }

  void announce_model(const Scene &scene, const RunOptions &options)
  {
    if (options.quiet)
      return;
    for (const auto &line : modelled(scene))
      std::cout << line << '\n';
    std::cout << std::flush;
  }
} // namespace sprag
