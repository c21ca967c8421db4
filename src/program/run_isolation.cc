// SPDX-License-Identifier: GPL-3.0-only
#include "base/append.h"
#include "program/isolation_report.h"
#include "program/run_by_formulas.h"
#include "report/isolation_brief.h"
#include "report/report.h"
#include "scene/scene.h"

#include <iostream>

namespace sprag
{
  void finish_isolation(const Scene &scene, const RunOptions &options, const IsolationFindings &found,
                        const std::vector<Entry> &facts, const std::string &status, ResultWriter &writer, Warnings &warnings)
  {
    append(warnings, isolation_warnings(scene, found));
    const auto end = writer.finish(status, { isolation_summary(scene, found), facts }, warnings);
    if (options.verbose)
      print_summary(std::cout, end.summary);
    else if (!options.quiet)
      print_brief_of_isolation(std::cout, end.summary);
  }

  void run_isolation_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    ResultWriter writer(scene, options, timer, isolation_columns());
    RecordTable record;
    if (options.in_memory == nullptr)
      record = [&](const IsolatedTable &table, const bool is_before)
      { writer.append(isolation_row(scene.isolation, table, is_before)); };
    IsolationFindings found;
    finish_in_any_case([&] { run_isolation(scene, found, record); },
                       [&](const std::string &status) { finish_isolation(scene, options, found, {}, status, writer, warnings); });
  }
} // namespace sprag
