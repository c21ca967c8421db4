#include "analysis/run_transient.h"

#include "analysis/recorder.h"
#include "analysis/transient.h"
#include "base/errors.h"
#include "base/text.h"
#include "model/reduced_lever.h"
#include "scene/contact_reference.h"

#include <iostream>
#include <sstream>

namespace sprag
{
  namespace
  {
    using Timer = dealii::TimerOutput;

    TransientSettings settings_of(const Scene &scene)
    {
      const auto reference = contact_reference(scene);
      return { scene.time, reference.P, reference.stiffness };
    }

    void check_ledger(const Scene &scene, const LedgerReport &ledger)
    {
      const double limit = scene.analysis.maximum_residual;
      if (limit == 0. || ledger.share() <= limit)
        return;
      std::ostringstream message;
      message << "the energy ledger leaves open " << ledger.share() << " of the largest work, more than Analysis/Maximum energy "
              << "residual = " << limit << "; it opened most at t = " << ledger.time << " s, where " << ledger.term
              << " changed most. Try a shorter Time/Step or a smaller Time/Tolerance.";
      throw AnalysisError(message.str());
    }

    std::vector<Entry> report_entries(const TransientReport &report, const double seconds)
    {
      return { { "steps", static_cast<double>(report.steps), "1", "accepted steps" },
               { "rejected_steps", static_cast<double>(report.rejected), "1", "attempts discarded" },
               { "steps_per_cpu_second", seconds > 0. ? report.steps / seconds : 0., "1/s", "accepted steps, output included" },
               { "energy_residual_share", report.ledger.share(), "1", "largest energy residual over the largest work" } };
    }
  } // namespace

  void run_transient_scene(const Scene &scene, const RunOptions &options)
  {
    Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
    auto model = make_reduced_lever(scene);
    Recorder recorder(scene, options.folder, options.quiet, model->face_points());
    TransientReport report;
    double seconds  = 0.;
    const auto meta = [&]
    {
      auto entries       = report_entries(report, seconds);
      const auto process = process_entries(timer);
      entries.insert(entries.end(), process.begin(), process.end());
      return entries;
    };
    try
    {
      const Timer::Scope scope(timer, "steps_and_output");
      dealii::Timer clock;
      report =
          run_transient(*model, scene.drive, settings_of(scene), [&](const Motion &, const Row &row) { recorder.record(row); });
      seconds = clock.cpu_time();
      check_ledger(scene, report.ledger);
    }
    catch (const AnalysisError &error)
    {
      recorder.finish(error.what(), meta());
      throw;
    }
    recorder.finish("completed", meta());
  }
} // namespace sprag
