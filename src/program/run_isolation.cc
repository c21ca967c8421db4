// SPDX-License-Identifier: GPL-3.0-only
#include "base/append.h"
#include "program/isolation_report.h"
#include "program/run_by_formulas.h"
#include "scene/scene.h"

namespace sprag
{
  void finish_isolation(const Scene &scene, const IsolationFindings &found, const std::vector<Entry> &facts,
                        const std::string &status, ResultWriter &writer, Warnings &warnings)
  {
    append(warnings, isolation_warnings(scene, found));
    writer.finish(status, { isolation_summary(scene, found), facts }, warnings);
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
                       [&](const std::string &status) { finish_isolation(scene, found, {}, status, writer, warnings); });
  }
} // namespace sprag
