// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/dilatation_space.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> centre_of(const FEValues<dim> &values)
    {
      Point<dim> sum;
      double volume = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
      {
        sum += values.JxW(q) * values.quadrature_point(q);
        volume += values.JxW(q);
      }
      return sum / volume;
    }

    double product(const std::vector<double> &a, const std::vector<double> &b, const std::vector<double> &weights)
    {
      double sum = 0.;
      for (std::size_t q = 0; q < weights.size(); ++q)
        sum += weights[q] * a[q] * b[q];
      return sum;
    }
  } // namespace

  /// By Gram and Schmidt: the first coordinates have no part in the constant, as they are counted from the centre.
  template <int dim>
  void DilatationSpace<dim>::reinit(const FEValues<dim> &values, const unsigned int degree)
  {
    const auto &weights = values.get_JxW_values();
    functions.assign(degree == 0 ? 1 : dim + 1, { centre_of(values), 0., {} });
    at_points.assign(functions.size(), std::vector<double>(weights.size()));
    for (unsigned int a = 0; a < functions.size(); ++a)
    {
      auto &function = functions[a];
      auto &at_point = at_points[a];
      if (a == 0)
        function.constant = 1.;
      else
        function.slope[a - 1] = 1.;
      const auto evaluate = [&]
      {
        for (const unsigned int q : values.quadrature_point_indices())
          at_point[q] = function(values.quadrature_point(q));
      };
      evaluate();
      for (unsigned int b = 0; b < a; ++b)
      {
        const double share = product(at_point, at_points[b], weights);
        function.constant -= share * functions[b].constant;
        function.slope -= share * functions[b].slope;
      }
      evaluate();
      const double size = std::sqrt(product(at_point, at_point, weights));
      function.constant /= size;
      function.slope /= size;
      for (double &value : at_point)
        value /= size;
    }
  }

  template <int dim>
  LinearPolynomial<dim> DilatationSpace<dim>::combined(const std::vector<double> &factors) const
  {
    LinearPolynomial<dim> sum{ functions.front().centre, 0., {} };
    for (std::size_t a = 0; a < functions.size(); ++a)
    {
      sum.constant += factors[a] * functions[a].constant;
      sum.slope += factors[a] * functions[a].slope;
    }
    return sum;
  }

  template class DilatationSpace<2>;
  template class DilatationSpace<3>;
} // namespace sprag
