// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"
#include "input/isolation_tables.h"

namespace sprag
{
  struct Scene;

  /// Reads what texts and tables say that one analysis alone has, and reports what is wrong with them.
  void read_analysis_texts(Scene &scene, const std::vector<Parameter> &declared, const ReportMistake &report);
} // namespace sprag
