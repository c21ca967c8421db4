// SPDX-License-Identifier: GPL-3.0-only
#include "base/nonlinear_least_squares.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <memory>

namespace sprag
{
  namespace
  {
    constexpr double difference       = 1e-5; ///< of an unknown: central differences are then good to 1e-10
    constexpr std::size_t most_rounds = 200;

    std::vector<double> to_vector(const gsl_vector *const vector)
    {
      std::vector<double> result(vector->size);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = gsl_vector_get(vector, i);
      return result;
    }

    int evaluate(const gsl_vector *const at, void *const residuals, gsl_vector *const result)
    {
      const auto found = (*static_cast<const Residuals *>(residuals))(to_vector(at));
      for (std::size_t i = 0; i < found.size(); ++i)
        gsl_vector_set(result, i, found[i]);
      return GSL_SUCCESS;
    }

    int differentiate(const gsl_vector *const at, void *const residuals, gsl_matrix *const result)
    {
      const auto found = jacobian(*static_cast<const Residuals *>(residuals), to_vector(at));
      std::copy(found.begin(), found.end(), result->data);
      return GSL_SUCCESS;
    }

    using Matrix    = std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)>;
    using Vector    = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;
    using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>;
  } // namespace

  std::vector<double> jacobian(const Residuals &residuals, const std::vector<double> &unknowns)
  {
    std::vector<double> result;
    for (std::size_t j = 0; j < unknowns.size(); ++j)
    {
      auto above = unknowns, below = unknowns;
      above[j] += difference;
      below[j] -= difference;
      const auto more = residuals(above), less = residuals(below);
      result.resize(more.size() * unknowns.size());
      for (std::size_t i = 0; i < more.size(); ++i)
        result[i * unknowns.size() + j] = (more[i] - less[i]) / (above[j] - below[j]);
    }
    return result;
  }

  std::vector<double> least_squares(const Residuals &residuals, const std::vector<double> &start)
  {
    gsl_set_error_handler_off();
    auto parameters      = gsl_multifit_nlinear_default_parameters();
    const auto rows      = residuals(start).size();
    const auto workspace = Workspace(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, rows, start.size()),
                                     gsl_multifit_nlinear_free);
    gsl_multifit_nlinear_fdf problem{};
    problem.f      = evaluate;
    problem.df     = differentiate;
    problem.n      = rows;
    problem.p      = start.size();
    problem.params = const_cast<Residuals *>(&residuals); // which evaluate() and differentiate() read only

    const auto begin = gsl_vector_const_view_array(start.data(), start.size());
    gsl_multifit_nlinear_init(&begin.vector, &problem, workspace.get());
    int reason = 0;
    gsl_multifit_nlinear_driver(most_rounds, 1e-10, 1e-14, 0., nullptr, nullptr, &reason, workspace.get());
    return to_vector(gsl_multifit_nlinear_position(workspace.get()));
  }

  SingularValues singular_values(const std::vector<double> &matrix, const std::size_t columns)
  {
    const auto rows       = matrix.size() / columns;
    const auto left       = Matrix(gsl_matrix_alloc(rows, columns), gsl_matrix_free);
    const auto directions = Matrix(gsl_matrix_alloc(columns, columns), gsl_matrix_free);
    const auto values     = Vector(gsl_vector_alloc(columns), gsl_vector_free);
    std::copy(matrix.begin(), matrix.end(), left->data);
    gsl_linalg_SV_decomp_jacobi(left.get(), directions.get(), values.get());
    return { to_vector(values.get()),
             { left->data, left->data + rows * columns },
             { directions->data, directions->data + columns * columns } };
  }
} // namespace sprag
