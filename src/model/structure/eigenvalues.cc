// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/eigenvalues.h"

#include "base/errors.h"

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  std::vector<Eigenpair> eigenpairs(const FullMatrix<double> &matrix, const bool vectors)
  {
    const auto n    = static_cast<unsigned int>(matrix.m());
    const auto size = static_cast<types::blas_int>(n);
    std::vector<double> by_columns(static_cast<std::size_t>(n) * n), right(vectors ? by_columns.size() : 1), real(n),
        imaginary(n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        by_columns[static_cast<std::size_t>(j) * n + i] = matrix(i, j);
    if (!std::all_of(by_columns.begin(), by_columns.end(), [](const double entry) { return std::isfinite(entry); }))
      throw AnalysisError("a matrix whose eigenvalues are wanted has an entry that is no number");

    const char no                   = 'N';
    const char right_ones           = vectors ? 'V' : 'N';
    const types::blas_int one       = 1;
    const types::blas_int asks_size = -1;
    types::blas_int status          = 0;
    double best_size                = 0.;
    double unused                   = 0.;
    geev(&no, &right_ones, &size, by_columns.data(), &size, real.data(), imaginary.data(), &unused, &one, right.data(), &size,
         &best_size, &asks_size, &status);
    std::vector<double> work(static_cast<std::size_t>(best_size));
    const auto work_size = static_cast<types::blas_int>(work.size());
    geev(&no, &right_ones, &size, by_columns.data(), &size, real.data(), imaginary.data(), &unused, &one, right.data(), &size,
         work.data(), &work_size, &status);
    if (status != 0)
      throw AnalysisError("the eigenvalues of a matrix of " + std::to_string(n) + " rows were not found (LAPACK status " +
                          std::to_string(status) + ")");

    std::vector<Eigenpair> result;
    for (unsigned int j = 0; j < n; ++j)
    {
      result.push_back({ { real[j], imaginary[j] }, {} });
      const auto first      = right.begin() + static_cast<std::ptrdiff_t>(j) * n;
      const bool is_complex = imaginary[j] > 0.;
      if (vectors)
      {
        auto &[real_part, imaginary_part] = result.back().vector;
        real_part                         = Vector<double>(first, first + n);
        imaginary_part                    = is_complex ? Vector<double>(first + n, first + 2 * n) : Vector<double>(n);
      }
      j += is_complex ? 1 : 0;
    }
    return result;
  }
} // namespace sprag
