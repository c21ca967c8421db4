// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/parameters.h"
#include "scene/identification.h"
#include "scene/isolation.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Takes the full name of a parameter and the rule that it breaks.
  using ReportMistake = std::function<void(const std::string &parameter, const std::string &rule)>;

  /// Reads a file by `read`; reports against the parameter that names it what is wrong with it, or that there is none.
  void read_file(const std::string &parameter, const std::string &file, const ReportMistake &report,
                 const std::function<void()> &read);

  /// Unused columns of tables, by the parameter that names the table.
  using UnusedColumns = std::map<std::string, std::vector<std::string>>;

  /// The words for unknowns and forces in scenes and reports.
  const Choices<Unknown> &unknown_words();
  const Choices<MeasuredForce> &force_words();

  /// Reads the texts of the settings and the table, whose path is absolute or empty, and reports what is wrong with them.
  void read_identification(IdentificationSettings &settings, UnusedColumns &unused, const ReportMistake &report);

  /// Reads what texts and tables say that one analysis alone has, and reports what is wrong with them.
  void read_analysis_texts(Scene &scene, const std::vector<Parameter> &declared, const ReportMistake &report);
} // namespace sprag
