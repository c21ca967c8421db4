// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// Prints what a reader wants to know first of an isolation system, from the entries of its summary. Entries that are missing
  /// or unknown (NaN) leave no trace.
  void print_brief_of_isolation(std::ostream &stream, const std::vector<Entry> &summary);
} // namespace sprag
