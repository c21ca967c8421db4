// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/band_factors.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  unsigned int BandFactors::factorise()
  {
    unsigned int negative = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      double *const row        = &rows[position(i, i)];
      const unsigned int width = std::min(bandwidth, n - 1 - i);
      const double pivot       = row[0];
      if (!std::isfinite(pivot) || pivot == 0.)
        throw AnalysisError("a stiffness is singular");
      negative += pivot < 0. ? 1 : 0;
      for (unsigned int r = 1; r <= width; ++r)
      {
        const double factor = row[r] / pivot;
        double *const below = &rows[position(i + r, i + r)];
        if (factor != 0.)
          for (unsigned int c = r; c <= width; ++c)
            below[c - r] -= factor * row[c];
      }
      for (unsigned int r = 1; r <= width; ++r)
        row[r] /= pivot;
    }
    return negative;
  }

  void BandFactors::solve(dealii::Vector<double> &x) const
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      const double *const row = &rows[position(i, i)];
      for (unsigned int r = 1; r <= std::min(bandwidth, n - 1 - i); ++r)
        x[i + r] -= row[r] * x[i];
    }
    for (unsigned int i = n; i-- > 0;)
    {
      const double *const row = &rows[position(i, i)];
      double sum              = x[i] / row[0];
      for (unsigned int r = 1; r <= std::min(bandwidth, n - 1 - i); ++r)
        sum -= row[r] * x[i + r];
      x[i] = sum;
    }
  }
} // namespace sprag
