// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"
#include "analytic/ideal_contact.h"
#include "base/system/interrupt.h"
#include "program/recorder.h"
#include "program/run_by_formulas.h"
#include "report/report.h"
#include "scene/contact_reference.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    auto record_until_interrupted(Recorder &recorder)
    {
      return [&recorder](const Row &row)
      {
        recorder.record(row);
        end_if_interrupted();
      };
    }

    void run_without_inertia(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      PhaseTimer timer;
      Recorder recorder(scene, options, timer, {});
      std::vector<Entry> summary;
      finish_in_any_case([&] { run_closed_form(scene, record_until_interrupted(recorder)); },
                         [&](const std::string &status) { summary = recorder.finish(status, {}, warnings); });
      check_deviation(scene, summary);
    }

    void run_in_time(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      PhaseTimer timer;
      const double inertia = scene.analysis.model == ModelType::rigid ? moment_of_inertia(scene) : 0.;
      Recorder recorder(scene, options, timer, {});
      announce_model(scene, options);
      record_steps(scene, recorder, timer, warnings, {},
                   [&] { return run_ideal_contact(scene, inertia, record_until_interrupted(recorder)); });
    }
  } // namespace

  void run_formulas(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    if (scene.analysis.type == AnalysisType::slope)
      run_slope(scene, options, warnings);
    else if (scene.analysis.type == AnalysisType::isolation)
      run_isolation_scene(scene, options, warnings);
    else if (scene.analysis.type == AnalysisType::transient)
      run_in_time(scene, options, warnings);
    else
      run_without_inertia(scene, options, warnings);
  }
} // namespace sprag
