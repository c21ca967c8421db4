#include "base/append.h"
#include "run/analyses.h"
#include "run/isolation_report.h"
#include "run/report.h"
#include "run/result_writer.h"

#include <iostream>

namespace sprag
{
  void run_isolation_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    ResultWriter writer(scene, options, timer, isolation_columns());
    RecordTable record;
    if (options.in_memory == nullptr)
      record = [&](const TableMotion &motion, const bool is_before)
      { writer.append(isolation_row(scene.isolation, motion, is_before)); };
    IsolationFindings found;
    finish_in_any_case([&] { run_isolation(scene, found, record); },
                       [&](const std::string &status)
                       {
                         append(warnings, isolation_warnings(scene, found));
                         const auto end = writer.finish(status, { isolation_summary(scene, found) }, warnings);
                         if (!options.quiet)
                           print_summary(std::cout, end.summary);
                       });
  }
} // namespace sprag
