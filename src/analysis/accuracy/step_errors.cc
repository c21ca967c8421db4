// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/step_errors.h"

#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    constexpr double least_row_ringing = 0.1; ///< |P - P_quasi_static| of a ringing row, over its maximum

    double row_ringing(const Row &row)
    {
      return row[Column::P] - row[Column::P_quasi_static];
    }
    /// Returns the time of the last ringing row between two times.
    double ringing_end(const std::vector<Row> &rows, const double begin, const double end)
    {
      const auto size = [&](const Row &row)
      { return row[Column::time] > begin && row[Column::time] <= end ? std::abs(row_ringing(row)) : 0.; };
      const double least = least_row_ringing * largest(rows, size);
      double result      = begin;
      for (const Row &row : rows)
        if (size(row) > 0. && size(row) >= least)
          result = row[Column::time];
      return result;
    }
  } // namespace

  StepErrors estimate_step_errors(const std::vector<Row> &rows, const double begin, const double end,
                                  const std::function<double(double)> &frequency_error)
  {
    StepErrors result;
    double delay = 0., weights = 0., longest = 0., peak = -std::numeric_limits<double>::infinity();
    bool has_turned = false; // P rings once friction has changed its direction
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const double time = rows[i][Column::time], dt = time - rows[i - 1][Column::time];
      const double now = row_ringing(rows[i]), before = row_ringing(rows[i - 1]);
      if (!(time > begin) || time > end || !(dt > 0.) || !std::isfinite(now) || !std::isfinite(before))
        continue;
      const double error = frequency_error(rows[i][Column::time_step]);
      delay += error * dt;
      longest    = std::max(longest, rows[i][Column::time_step]);
      result.P   = std::max(result.P, std::abs(now - before) / dt * delay);
      has_turned = has_turned || now * before <= 0.;
      if (has_turned)
      {
        if (const double excess = std::copysign(1., rows[i][Column::P_quasi_static]) * now; excess > peak)
        {
          peak             = excess;
          result.peak_step = longest;
          result.P = delay = 0.; // P rings from its overshoot on
        }
        result.frequency += error * std::abs(now) * dt;
        weights += std::abs(now) * dt;
      }
    }
    if (weights > 0.)
      result.frequency /= weights;
    return result;
  }

  double change_by_frequency(const std::vector<Row> &rows, const double begin, const double end)
  {
    return estimate_step_errors(rows, begin, ringing_end(rows, begin, end), [](double) { return 1.; }).P;
  }
} // namespace sprag
