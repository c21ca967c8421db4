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

  /// Returns the stress sigma = lambda tr(eps) I + 2 mu eps with eps the symmetric part of the displacement gradient.
  template <int dim>
  Stress<dim> linear_elastic(const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Returns the stress of the compressible neo-Hookean solid, W = mu/2 (tr F^T F - dim) - mu ln J + lambda/2 (ln J)^2; in two
  /// dimensions plane strain:
  ///   P = mu (F - F^-T) + lambda ln J F^-T
  /// Throws AnalysisError where J <= 0, so that the step is cut back.
  template <int dim>
  Stress<dim> neo_hookean(const Lame &constants, const dealii::Tensor<2, dim> &deformation_gradient);

  /// Returns W of neo_hookean() [mJ/mm^3].
  template <int dim>
  double neo_hookean_energy(const Lame &constants, const dealii::Tensor<2, dim> &deformation_gradient);

  /// Returns the stress of the St. Venant-Kirchhoff solid, for large rotations and small strains: S = lambda tr(E) I + 2 mu E, P
  /// = F S with the Green-Lagrange strain E = (F^T F - I)/2; in plane strain, or in plane stress (S_33 = 0, the width taken as it
  /// was), as the constants are.
  template <int dim>
  Stress<dim> st_venant_kirchhoff(const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Returns W = lambda/2 tr(E)^2 + mu E : E of st_venant_kirchhoff() [mJ/mm^3].
  template <int dim>
  double st_venant_kirchhoff_energy(const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

  /// Returns the stress of one of these materials.
  template <int dim>
  Stress<dim> compute_stress(MaterialModel model, const Lame &constants, const dealii::Tensor<2, dim> &displacement_gradient);

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
