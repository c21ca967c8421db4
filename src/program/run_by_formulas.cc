// SPDX-License-Identifier: GPL-3.0-only
#include "program/run_by_formulas.h"

#include "analytic/closed_form.h"
#include "analytic/jamming.h"
#include "base/errors.h"
#include "base/system/interrupt.h"
#include "laws/friction_law.h"
#include "program/isolation_report.h"
#include "program/output_folder.h"
#include "program/recorder.h"
#include "program/result_writer.h"
#include "report/report.h"
#include "report/warnings.h"
#include "scene/closed_form.h"
#include "scene/lever_inertia.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <cmath>
#include <iostream>
#include <set>

namespace sprag
{
  namespace
  {
    /// Returns the margin, as text, of the lever of a pair that is closer to jamming.
    std::string least_margin(const Device &device)
    {
      if (count_levers(device) == 1)
        return jamming_text(jamming_margin(device));
      const auto lever_margin = [&](const unsigned int lever)
      {
        Device alone = lever_device(device, lever);
        alone.pair   = {};
        return jamming_margin(alone);
      };
      const auto first  = lever_margin(0);
      const auto second = lever_margin(1);
      return first.margin() <= second.margin() ? jamming_text(first) : jamming_text(second) + ", all of the second lever";
    }

    /// Before every run in which friction moves a lever along the drive, once nothing is left for which it could be refused.
    void announce_margin(const Scene &scene, const RunOptions &options)
    {
      static const std::set<AnalysisType> with_margin = { AnalysisType::quasi_static, AnalysisType::transient,
                                                          AnalysisType::stability, AnalysisType::sprag_slip };
      if (options.quiet || with_margin.count(scene.analysis.type) == 0)
        return;
      require_writable(options.folder);
      std::cout << least_margin(scene) << '\n' << std::flush;
    }

    /// Warnings and, in the last line, their number.
    void print_end(const std::string &end, const Warnings &warnings, const RunOptions &options)
    {
      if (!options.quiet)
        std::cout << to_text(warnings) << end << count_text(warnings) << std::endl;
    }

    auto record_until_interrupted(Recorder &recorder)
    {
      return [&recorder](const Row &row)
      {
        recorder.record(row);
        end_if_interrupted();
      };
    }

    void run_slope(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      const auto sweep = slope_sweep(scene);
      ResultWriter writer(scene, options, sweep.columns);
      for (const auto &row : sweep.rows)
        writer.append(row);
      const double mu = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
      writer.finish("completed", { { { "critical_inclination", std::atan(mu) } } }, warnings);
    }

    /// Throws AnalysisError too where the damper of the table ends or locks and where the energy ledger leaves more open than
    /// Analysis/Maximum energy residual.
    void run_isolation_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      ResultWriter writer(scene, options, isolation_columns());
      RecordTable record;
      if (options.in_memory == nullptr)
        record = [&](const IsolatedTable &table, const bool is_before)
        { writer.append(isolation_row(scene.isolation, table, is_before)); };
      IsolationFindings found;
      finish_in_any_case([&] { run_isolation(scene, found, record); },
                         [&](const std::string &status) { finish_isolation(scene, found, {}, status, writer, warnings); });
    }

    void run_without_inertia(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      Recorder recorder(scene, options);
      std::vector<Entry> summary;
      finish_in_any_case([&] { run_closed_form(scene, record_until_interrupted(recorder)); },
                         [&](const std::string &status) { summary = recorder.finish(status, {}, warnings); });
      check_deviation(scene, summary);
    }

    void run_in_time(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      PhaseTimer timer;
      const double inertia = scene.analysis.model == ModelType::rigid ? moment_of_inertia(scene) : 0.;
      Recorder recorder(scene, options, &timer);
      announce_model(scene, options);
      record_steps(scene, recorder, timer, warnings, {},
                   [&] { return run_ideal_contact(scene, inertia, record_until_interrupted(recorder)); });
    }
  } // namespace

  void run_from_margin_to_warnings(const Scene &scene, const RunOptions &options, const Run &analysis)
  {
    announce_margin(scene, options);
    Warnings warnings = scene_warnings(scene);
    try
    {
      analysis(scene, options, warnings);
    }
    catch (const AnalysisError &)
    {
      print_end(interrupted() ? "interrupted, " : "failed, ", warnings, options);
      throw;
    }
    print_end("completed, ", warnings, options);
    check_warnings(scene, warnings);
  }

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
