#pragma once

#include "fe/body/material.h"

namespace sprag
{
  /// The dilatation theta with which the volumetric part of a material's energy is lambda/2 theta^2, and its derivative by F.
  template <int dim>
  struct Dilatation
  {
    double value;
    dealii::Tensor<2, dim> derivative;
  };

  /// theta = tr eps of the linear, ln J of the neo-Hookean material; the St. Venant-Kirchhoff material has none (assertion).
  /// Throws AnalysisError where J <= 0.
  template <int dim>
  Dilatation<dim> dilatation(MaterialModel model, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Stress of these materials with `pressure` [MPa], positive in tension, in the place of lambda theta, and the tangent at
  /// constant pressure. Throws as dilatation().
  template <int dim>
  Stress<dim> stress_at_pressure(MaterialModel model, double mu, const dealii::Tensor<2, dim> &displacement_gradient,
                                 double pressure);
} // namespace sprag
