// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "input/isolation_tables.h"
#include "scene/identification.h"

namespace sprag
{
  /// The words for unknowns and forces in scenes and reports.
  const Choices<Unknown> &unknown_words();
  const Choices<MeasuredForce> &force_words();

  /// Reads the texts of the settings and the table, whose path is absolute or empty, and reports what is wrong with them.
  void read_identification(IdentificationSettings &settings, UnusedColumns &unused, const ReportMistake &report);
} // namespace sprag
