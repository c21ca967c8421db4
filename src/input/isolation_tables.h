// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/isolation.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sprag
{
  /// Takes the full name of a parameter and the rule that it breaks.
  using ReportMistake = std::function<void(const std::string &parameter, const std::string &rule)>;

  /// Reads a file by `read`; reports against the parameter that names it what is wrong with it, or that there is none.
  void read_file(const std::string &parameter, const std::string &file, const ReportMistake &report,
                 const std::function<void()> &read);

  /// Unused columns of tables, by the parameter that names the table.
  using UnusedColumns = std::map<std::string, std::vector<std::string>>;

  /// Reads the files that the settings use, whose paths are absolute or empty, and reports what is wrong with them.
  void read_isolation_tables(IsolationSettings &settings, UnusedColumns &unused, const ReportMistake &report);
} // namespace sprag
