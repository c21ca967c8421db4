// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// A body of one material with E = 20 MPa in plane strain, 3 mm wide.
  inline BodyProperties soft_solid(const unsigned int degree, const MaterialModel material, const double poisson_ratio)
  {
    BodyProperties properties;
    properties.degree    = degree;
    properties.plane     = PlaneState::strain;
    properties.material  = material;
    properties.width     = 3.;
    properties.constants = { { material_id::lever, { 20., poisson_ratio } } };
    return properties;
  }

  /// A tensor, row by row.
  inline dealii::Tensor<2, 2> gradient(const double a, const double b, const double c, const double d)
  {
    return dealii::Tensor<2, 2>({ { a, b }, { c, d } });
  }
} // namespace sprag
