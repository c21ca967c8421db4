// SPDX-License-Identifier: GPL-3.0-only
#include "base/least_squares.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  Line fitted_line(const std::vector<double> &x, const std::vector<double> &y, const std::vector<double> &weights)
  {
    const auto weight = [&](const std::size_t i) { return weights.empty() ? 1. : weights[i]; };
    double sum        = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += weight(i);
    double mean_x = 0., mean_y = 0., xx = 0., xy = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      mean_x += weight(i) * x[i] / sum;
      mean_y += weight(i) * y[i] / sum;
    }
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      xx += weight(i) * (x[i] - mean_x) * (x[i] - mean_x);
      xy += weight(i) * (x[i] - mean_x) * (y[i] - mean_y);
    }
    return { mean_x, mean_y, xy / xx };
  }

  double slope_at_origin(const std::vector<double> &x, const std::vector<double> &y)
  {
    double x2 = 0., x3 = 0., x4 = 0., xy = 0., x2y = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x2 += x[i] * x[i];
      x3 += x[i] * x[i] * x[i];
      x4 += x[i] * x[i] * x[i] * x[i];
      xy += x[i] * y[i];
      x2y += x[i] * x[i] * y[i];
    }
    return (xy * x4 - x2y * x3) / (x2 * x4 - x3 * x3);
  }

  ScaledShape fitted_factor(const std::vector<double> &shape, const std::vector<double> &values)
  {
    double shape_value = 0., shape_shape = 0., value_value = 0., largest = 0.;
    for (std::size_t i = 0; i < shape.size(); ++i)
    {
      shape_value += shape[i] * values[i];
      shape_shape += shape[i] * shape[i];
      value_value += values[i] * values[i];
      largest = std::max(largest, std::abs(values[i]));
    }
    const double factor = shape_value / shape_shape;
    const double square = std::max(0., value_value - shape_value * factor) / static_cast<double>(shape.size());
    return { factor, std::sqrt(square) / largest };
  }
} // namespace sprag
