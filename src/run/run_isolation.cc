#include "base/append.h"
#include "run/analyses.h"
#include "run/isolation_report.h"
#include "run/report.h"
#include "run/result_writer.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace sprag
{
  namespace
  {
    /// Without the numbers that this base or damper does not have.
    std::vector<Entry> known(std::vector<Entry> entries)
    {
      const auto is_unknown = [](const Entry &entry)
      {
        const double *const number = std::get_if<double>(&entry.value);
        return number != nullptr && std::isnan(*number);
      };
      entries.erase(std::remove_if(entries.begin(), entries.end(), is_unknown), entries.end());
      return entries;
    }
  } // namespace

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
                           print_summary(std::cout, options.verbose ? end.summary : known(end.summary));
                       });
  }
} // namespace sprag
