// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"
#include "scene/vibration_settings.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  // What a reader wants to know first of an analysis that is no run along a drive, from the entries of its summary. Entries that
  // are missing or unknown (NaN) leave no trace. All else is in the file.

  void print_brief_of_sprag_slip(std::ostream &stream, const std::vector<Entry> &summary);
  void print_brief_of_calibration(std::ostream &stream, const std::vector<Entry> &summary);
  void print_brief_of_contact_law(std::ostream &stream, const std::vector<Entry> &summary);

  /// Prints how much of a map is unstable and between which values of its parameters the verdict changes. `boundary` holds the
  /// rows of the map's table, see boundary_columns() in run_map.cc.
  void print_brief_of_map(std::ostream &stream, const MapSettings &map, const std::vector<std::vector<double>> &boundary,
                          const std::vector<Entry> &summary);
} // namespace sprag
