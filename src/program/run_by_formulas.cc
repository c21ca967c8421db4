// SPDX-License-Identifier: GPL-3.0-only
#include "program/run_by_formulas.h"
#include "base/errors.h"
#include "program/output_folder.h"
#include "report/warnings.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <iostream>
#include <set>

namespace sprag
{
  namespace
  {
    using FindMargin = std::function<JammingMargin(const Device &)>;

    /// Tells the margin of the lever of a pair that is closer to jamming.
    std::string least_margin(const Device &device, const FindMargin &margin)
    {
      if (count_levers(device) == 1)
        return jamming_text(margin(device));
      const auto lever_margin = [&](const unsigned int lever)
      {
        Device alone = lever_device(device, lever);
        alone.pair   = {};
        return margin(alone);
      };
      const auto first  = lever_margin(0);
      const auto second = lever_margin(1);
      return first.margin() <= second.margin() ? jamming_text(first) : jamming_text(second) + ", all of the second lever";
    }

    /// Before every run in which friction moves a lever along the drive, once nothing is left for which it could be refused.
    void announce_margin(const Scene &scene, const RunOptions &options, const FindMargin &margin)
    {
      static const std::set<AnalysisType> with_margin = { AnalysisType::quasi_static, AnalysisType::transient,
                                                          AnalysisType::stability, AnalysisType::sprag_slip };
      if (options.quiet || with_margin.count(scene.analysis.type) == 0)
        return;
      require_writable(options.folder);
      if (options.is_first)
        std::cout << least_margin(scene, margin) << '\n' << std::flush;
    }

    /// Warnings and, in the last line, their number.
    void print_end(const std::string &end, const Warnings &warnings, const RunOptions &options)
    {
      if (!options.quiet && options.is_first)
        std::cout << to_text(warnings) << end << count_text(warnings) << std::endl;
    }
  } // namespace

  void check_warnings(const Scene &scene, const Warnings &warnings)
  {
    if (scene.analysis.warnings == WarningTreatment::error && !warnings.empty())
      throw AnalysisError("Analysis/Warnings = error: " + count_text(warnings) + ". The first says: " + warnings.front().found +
                          ' ' + warnings.front().remedy);
  }

  void run_from_margin_to_warnings(const Scene &scene, const RunOptions &options, const FindMargin &margin, const Run &analysis)
  {
    announce_margin(scene, options, margin);
    Warnings warnings = scene_warnings(scene);
    try
    {
      analysis(scene, options, warnings);
    }
    catch (const AnalysisError &)
    {
      print_end("failed, ", warnings, options);
      throw;
    }
    print_end("completed, ", warnings, options);
    check_warnings(scene, warnings);
  }

  void run_by_formulas(const Scene &scene, const RunOptions &options)
  {
    run_from_margin_to_warnings(scene, options, rigid_jamming_margin, run_formulas);
  }
} // namespace sprag
