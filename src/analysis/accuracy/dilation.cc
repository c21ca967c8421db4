#include "analysis/accuracy/dilation.h"

#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    double ringing(const Row &row)
    {
      const double result = row[Column::P] - row[Column::P_quasi_static];
      return std::isfinite(result) ? result : 0.;
    }
  } // namespace

  double change_by_frequency(const std::vector<Row> &rows, const Drive &drive)
  {
    const auto &reversals = drive.reversals();
    double result         = 0.;
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const double time = rows[i][Column::time];
      const double dt   = time - rows[i - 1][Column::time];
      const auto next   = std::lower_bound(reversals.begin(), reversals.end(), time);
      const double from = next == reversals.begin() ? 0. : *(next - 1);
      if (dt > 0. && rows[i - 1][Column::time] >= from)
        result = std::max(result, std::abs(ringing(rows[i]) - ringing(rows[i - 1])) / dt * (time - from));
    }
    const double peak = largest(rows, Column::P);
    return peak > 0. ? result / peak : 0.;
  }
} // namespace sprag
