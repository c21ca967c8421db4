// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/pressure_fit.h"

#include <deal.II/lac/exceptions.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>

namespace sprag
{
  namespace
  {
    /// Returns whether xi lies in the contact; if so, sets the functions that the coefficients belong to, there.
    bool set_shapes(const PressureFit &fit, const double xi, PressureFit::Coefficients &values)
    {
      const double s = (2. * xi - fit.a - fit.b) / (fit.b - fit.a);
      if (!(std::abs(s) < 1.))
        return false;
      values[0] = std::exp(fit.exponents.left * std::log(1. + s) + fit.exponents.right * std::log(1. - s));
      values[1] = s * values[0];
      for (unsigned int k = 2; k <= fit.degree; ++k)
        values[k] = 2. * s * values[k - 1] - values[k - 2];
      return true;
    }

    double dot(const PressureFit::Coefficients &x, const PressureFit::Coefficients &y, const unsigned int n)
    {
      double sum = 0.;
      for (unsigned int k = 0; k < n; ++k)
        sum += x[k] * y[k];
      return sum;
    }
  } // namespace

  double PressureFit::pressure(const double xi) const
  {
    Coefficients values;
    return set_shapes(*this, xi, values) ? dot(c, values, degree + 1) : 0.;
  }

  void set_coefficients(const PressureData &data, PressureFit &fit)
  {
    const unsigned int n = fit.degree + 1;
    const double middle  = 0.5 * (fit.a + fit.b);
    std::array<PressureFit::Coefficients, PressureFit::largest_degree + 1> squares{};
    PressureFit::Coefficients load{}, force{}, moment{}, shapes;
    double of_force = 0., of_moment = 0.;
    for (std::size_t i = 0; i < data.xi.size(); ++i)
    {
      const double area = data.weight[i], trust = data.trust[i], p = data.pressure[i], arm = data.xi[i] - middle;
      of_force += area * p;
      of_moment += area * p * arm;
      if (!set_shapes(fit, data.xi[i], shapes))
        continue;
      for (unsigned int j = 0; j < n; ++j)
      {
        load[j] += trust * p * shapes[j];
        force[j] += area * shapes[j];
        moment[j] += area * arm * shapes[j];
        for (unsigned int k = 0; k <= j; ++k)
          squares[j][k] += trust * shapes[j] * shapes[k];
      }
    }
    dealii::LAPACKFullMatrix<double> matrix(n + 2);
    dealii::Vector<double> solution(n + 2);
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int k = 0; k <= j; ++k)
        matrix(j, k) = matrix(k, j) = squares[j][k];
      matrix(j, n) = matrix(n, j) = force[j];
      matrix(j, n + 1) = matrix(n + 1, j) = moment[j];
      solution[j]                         = load[j];
    }
    solution[n]     = of_force;
    solution[n + 1] = of_moment;
    fit.misfit      = std::numeric_limits<double>::infinity();
    try
    {
      matrix.compute_lu_factorization();
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      return;
    }
    matrix.solve(solution);
    for (unsigned int k = 0; k < n; ++k)
      fit.c[k] = solution[k];
    fit.misfit = data.size;
    for (unsigned int j = 0; j < n; ++j)
      fit.misfit += fit.c[j] * (squares[j][j] * fit.c[j] + 2. * (dot(squares[j], fit.c, j) - load[j]));
  }
} // namespace sprag
