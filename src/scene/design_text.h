// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"
#include "scene/design.h"
#include "scene/isolation_tables.h"

#include <vector>

namespace sprag
{
  /// Reads the texts of the settings into free parameters, demands, aims and judges, and reports what is wrong with them. Free
  /// are numbers of the lever, its contact and the isolated table; the drive says what is asked of the lever and stays.
  void read_design(DesignSettings &settings, const std::vector<Parameter> &declared, const ReportMistake &report);
} // namespace sprag
