#include "base/append.h"
#include "run/analyses.h"
#include "run/briefs.h"
#include "run/isolation_report.h"
#include "run/report.h"

#include <iostream>

namespace sprag
{
  void record_isolation(const Scene &scene, const RunOptions &options, PhaseTimer &timer, Warnings &warnings,
                        const IsolationRun &follow)
  {
    ResultWriter writer(scene, options, timer, isolation_columns());
    RecordTable record;
    if (options.in_memory == nullptr)
      record = [&](const IsolatedTable &table, const bool is_before)
      { writer.append(isolation_row(scene.isolation, table, is_before)); };
    IsolationFindings found;
    std::vector<Entry> facts;
    finish_in_any_case([&] { facts = follow(found, record); },
                       [&](const std::string &status)
                       {
                         append(warnings, isolation_warnings(scene, found));
                         const auto end = writer.finish(status, { isolation_summary(scene, found), facts }, warnings);
                         if (options.verbose)
                           print_summary(std::cout, end.summary);
                         else if (!options.quiet)
                           print_brief_of_isolation(std::cout, end.summary);
                       });
  }

  void run_isolation_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    record_isolation(scene, options, timer, warnings,
                     [&](IsolationFindings &found, const RecordTable &record)
                     {
                       run_isolation(scene, found, record);
                       return std::vector<Entry>();
                     });
  }
} // namespace sprag
