// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/sample_changes.h"

#include "results/row_statistics.h"
#include "scene/drive.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  namespace
  {
    // A single place may lie well by chance.
    constexpr double near_peak = 0.5; ///< pressure of the samples that count, over the largest

    /// Over all samples, or those with at least a share of the largest value.
    double largest_change(const std::vector<Row> &samples, const std::vector<Row> &other, const Column column,
                          const double share = 0.)
    {
      const double peak = largest(samples, column);
      double result     = 0.;
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (std::abs(samples[i][column]) >= share * peak)
          result = std::max(result, std::abs(other[i][column] - samples[i][column]));
      return result / peak;
    }

    double change(const double value, const double other)
    {
      return std::abs((other - value) / value);
    }
  } // namespace

  double compute_drive_work(const std::vector<Row> &samples)
  {
    double result = 0.;
    for (std::size_t i = 1; i < samples.size(); ++i)
      result +=
          0.5 * (samples[i - 1].drive_force() + samples[i].drive_force()) * (samples[i][Column::x] - samples[i - 1][Column::x]);
    return result;
  }

  double peak_change(const std::string &quantity, const std::vector<Row> &passage, const std::vector<Row> &other)
  {
    if (passage.empty() || (quantity != "P" && quantity != "Q"))
      return 0.;
    const auto column     = quantity == "P" ? Column::P : Column::Q;
    const auto has_turned = friction_has_turned(passage);
    double peak = 0., other_peak = 0.;
    for (std::size_t i = 1; i < passage.size(); ++i) // the first is of the stroke before
      if (has_turned[i])
      {
        peak       = std::max(peak, std::abs(passage[i][column]));
        other_peak = std::max(other_peak, std::abs(other[i][column]));
      }
    return std::abs(other_peak - peak) / largest(passage, column);
  }

  double relative_change(const std::string &quantity, const std::vector<Row> &samples, const std::vector<Row> &other)
  {
    if (quantity == "loop_area")
      return change(compute_drive_work(samples), compute_drive_work(other));
    if (quantity == "largest_pressure" || quantity == "largest_stress")
      return largest_change(samples, other, Column::largest_pressure, near_peak);
    static const std::map<std::string, Column> columns = { { "P", Column::P },
                                                           { "Q", Column::Q },
                                                           { "contact_width", Column::contact_width } };
    return largest_change(samples, other, columns.at(quantity));
  }

  double distance_from_line(const Row &before, const Row &row, const Row &after, const Column column)
  {
    const double way = after[Column::x] - before[Column::x];
    if (way == 0.)
      return 0.;
    const double share = (row[Column::x] - before[Column::x]) / way;
    return row[column] - (1. - share) * before[column] - share * after[column];
  }
} // namespace sprag
