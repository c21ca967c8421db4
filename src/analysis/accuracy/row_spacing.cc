// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/row_spacing.h"

#include "analysis/accuracy/sample_changes.h"
#include "analytic/closed_form.h"
#include "results/row_statistics.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    std::vector<Row> closed_form_rows(Scene scene, const double step)
    {
      scene.analysis.step = step;
      std::vector<Row> rows;
      run_closed_form(scene, [&](const Row &row) { rows.push_back(row); });
      return rows;
    }

    bool is_one_stroke(const Row &a, const Row &b)
    {
      return a[Column::v] * b[Column::v] > 0.;
    }

    /// Distance of every row from the straight line between its neighbours, over the column's peak.
    double distance_from_lines(const std::vector<Row> &rows, const Column column)
    {
      double result = 0.;
      for (std::size_t i = 1; i + 1 < rows.size(); ++i)
        if (is_one_stroke(rows[i - 1], rows[i + 1]))
          result = std::max(result, std::abs(distance_from_line(rows[i - 1], rows[i], rows[i + 1], column)));
      return result / largest(rows, column);
    }

    /// Error of forces and, if asked for, of the loop area, relative, where rows are `step` apart [mm].
    double estimate_error(const Scene &scene, const double step, const bool wants_loop)
    {
      const auto halves  = closed_form_rows(scene, 0.5 * step);
      const double lines = std::max(distance_from_lines(halves, Column::P), distance_from_lines(halves, Column::Q));
      if (!wants_loop)
        return lines;
      const double loop = relative_change("loop_area", halves, closed_form_rows(scene, step));
      return std::max(lines, 4. / 3. * loop);
    }
  } // namespace

  double largest_row_spacing(const Scene &scene, const double error, const bool wants_loop)
  {
    const double longest = 0.25 * (scene.drive.maximum() - scene.drive.minimum());
    double step          = longest;
    // The error goes with the square of the step, but for what is coarse.
    for (unsigned int i = 0; i < 8; ++i)
    {
      const double found = estimate_error(scene, step, wants_loop);
      if (found <= error)
        return step;
      step *= std::max(0.25, 0.95 * std::sqrt(error / found));
    }
    return step;
  }
} // namespace sprag
