#include "analysis/run_transient.h"

#include "analysis/ideal_contact.h"
#include "analysis/recorder.h"
#include "analysis/transient.h"
#include "analysis/transient_report.h"
#include "base/errors.h"
#include "model/reduced_lever.h"
#include "scene/contact_reference.h"

#include <functional>
#include <iostream>

namespace sprag
{
  namespace
  {
    using Timer = dealii::TimerOutput;

    std::vector<Entry> cost_entries(const TransientReport &report, const double seconds)
    {
      return { { "steps_per_cpu_second", seconds > 0. ? report.steps / seconds : 0., "1/s", "accepted steps, output included" } };
    }

    /// Runs `steps`, which returns its report, and finishes the record whatever happens.
    void record_steps(const Scene &scene, Recorder &recorder, Timer &timer, const std::vector<Entry> &facts,
                      const std::function<TransientReport()> &steps)
    {
      TransientReport report;
      double seconds  = 0.;
      const auto meta = [&]
      {
        auto entries       = facts;
        const auto cost    = cost_entries(report, seconds);
        const auto process = process_entries(timer);
        entries.insert(entries.end(), cost.begin(), cost.end());
        entries.insert(entries.end(), process.begin(), process.end());
        return entries;
      };
      try
      {
        const Timer::Scope scope(timer, "steps_and_output");
        dealii::Timer clock;
        report  = steps();
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

    void announce(const Scene &scene, const RunOptions &options)
    {
      if (options.quiet)
        return;
      for (const auto &line : modelled(scene))
        std::cout << line << '\n';
      std::cout << std::flush;
    }

    TransientSettings settings_of(const Scene &scene)
    {
      const auto reference = contact_reference(scene);
      return { scene.time, reference.P, reference.stiffness };
    }

    void run_ideal(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      const double inertia = scene.analysis.model == ModelType::rigid ? scene.lever.moment_of_inertia : 0.;
      Recorder recorder(scene, options.folder, options.quiet, {});
      announce(scene, options);
      record_steps(scene, recorder, timer, {},
                   [&] { return run_ideal_contact(scene, inertia, [&](const Row &row) { recorder.record(row); }); });
    }

    void run_reduced(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      const auto model = make_reduced_lever(scene);
      Recorder recorder(scene, options.folder, options.quiet, model->face_points());
      announce(scene, options);
      record_steps(scene, recorder, timer, {},
                   [&]
                   {
                     return run_transient(*model, scene.drive, settings_of(scene),
                                          [&](const Motion &, const Row &row) { recorder.record(row); });
                   });
    }
  } // namespace

  void run_transient_scene(const Scene &scene, const RunOptions &options)
  {
    switch (scene.analysis.model)
    {
    case ModelType::closed_form:
      return run_ideal(scene, options);
    case ModelType::rigid:
      return scene.contact.type == ContactType::ideal ? run_ideal(scene, options) : run_reduced(scene, options);
    case ModelType::beam:
      return run_reduced(scene, options);
    case ModelType::condensed:
    case ModelType::finite_element:
      throw AnalysisError("not yet");
    }
  }
} // namespace sprag
