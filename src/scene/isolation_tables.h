#pragma once

#include "scene/isolation.h"

#include <functional>
#include <string>

namespace sprag
{
  /// Takes the full name of a parameter and the rule that it breaks.
  using ReportMistake = std::function<void(const std::string &parameter, const std::string &rule)>;

  /// Reads the files that the settings use, whose paths are absolute or empty, and reports what is wrong with them.
  void read_isolation_tables(IsolationSettings &settings, const ReportMistake &report);
} // namespace sprag
