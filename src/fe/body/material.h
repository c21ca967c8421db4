// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/analysis_settings.h"
#include "scene/lever.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Elastic constants [MPa]. E > 0, -1 < nu < 0.5.
  struct ElasticConstants
  {
    double young_modulus;
    double poisson_ratio;
  };

  /// Lame's constants of a plane problem: sigma = lambda tr(eps) I + 2 mu eps with the in-plane strain alone.
  /// Plane stress replaces lambda by 2 lambda mu / (lambda + 2 mu).
  struct Lame
  {
    double lambda;
    double mu;
  };

  Lame plane_constants(const ElasticConstants &constants, PlaneState plane);

  /// First Piola-Kirchhoff stress P [MPa] and tangent dP_iJ/dF_kL in row i * dim + J and column k * dim + L.
  template <int dim>
  struct Stress
  {
    dealii::Tensor<2, dim> piola;
    dealii::Tensor<2, dim * dim> tangent;
  };

  /// Returns the stress of a material:
  ///   linear              P = sigma = lambda tr(eps) I + 2 mu eps, eps the symmetric part of the displacement gradient
  ///   neo-Hookean         P = mu (F - F^-T) + lambda ln J F^-T
  ///   St.Venant-Kirchhoff P = F S, S = lambda tr(E) I + 2 mu E, with the Green-Lagrange strain E = (F^T F - I)/2
  /// The neo-Hookean solid is compressible and in two dimensions in plane strain; it throws AnalysisError where J <= 0, so that
  /// the step is cut back. The last is for large rotations and small strains, in plane strain, or in plane stress (S_33 = 0, the
  /// width taken as it was), as the constants are.
  template <int dim>
  Stress<dim> compute_stress(MaterialModel model, const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Returns the energy W of a material [mJ/mm^3]: sigma : eps / 2, mu/2 (tr F^T F - dim) - mu ln J + lambda/2 (ln J)^2, or
  /// lambda/2 tr(E)^2 + mu E : E.
  template <int dim>
  double energy_density(MaterialModel model, const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

  /// The dilatation theta with which the volumetric part of a material's energy is lambda/2 theta^2, and its derivative by F.
  template <int dim>
  struct Dilatation
  {
    double value;
    dealii::Tensor<2, dim> derivative;
  };

  /// Returns theta = tr eps of the linear, ln J of the neo-Hookean material; the St. Venant-Kirchhoff material has none
  /// (assertion). Throws AnalysisError where J <= 0.
  template <int dim>
  Dilatation<dim> dilatation(MaterialModel model, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Returns the stress of these materials with `pressure` [MPa], positive in tension, in the place of lambda theta, and the
  /// tangent at constant pressure. Throws as dilatation().
  template <int dim>
  Stress<dim> stress_at_pressure(MaterialModel model, double mu, const dealii::Tensor<2, dim> &displacement_gradient,
                                 double pressure);
} // namespace sprag
