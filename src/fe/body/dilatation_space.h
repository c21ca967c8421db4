// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/fe/fe_values.h>

#include <vector>

namespace sprag
{
  /// The polynomial constant + slope . (x - centre).
  template <int dim>
  struct LinearPolynomial
  {
    dealii::Point<dim> centre;
    double constant = 0.;
    dealii::Tensor<1, dim> slope;

    double operator()(const dealii::Point<dim> &point) const
    {
      return constant + slope * (point - centre);
    }
  };

  /// Polynomials in the coordinates x of the cell as it lies (those of the reference cell lose an order where cells are
  /// distorted: Arnold, Boffi and Falk 2002), of degree 0 or 1, orthonormal in the integral over the cell.
  template <int dim>
  class DilatationSpace
  {
  public:
    /// Enters the cell of `values`, which has points and weights.
    void reinit(const dealii::FEValues<dim> &values, unsigned int degree);

    unsigned int size() const
    {
      return static_cast<unsigned int>(functions.size());
    }

    /// Returns the value of a function at a point of the FEValues.
    double value(const unsigned int function, const unsigned int point) const
    {
      return at_points[function][point];
    }

    /// Returns the sum of the functions by `factors`.
    LinearPolynomial<dim> combined(const std::vector<double> &factors) const;

  private:
    std::vector<LinearPolynomial<dim>> functions;
    std::vector<std::vector<double>> at_points;
  };
} // namespace sprag
