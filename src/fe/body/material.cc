// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/material.h"

#include "base/errors.h"

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace sprag
{
  using dealii::Tensor;

  namespace
  {
    template <int dim>
    Tensor<2, dim> deformation_gradient(const Tensor<2, dim> &displacement_gradient)
    {
      return Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) + displacement_gradient;
    }

    /// From the displacement gradient, so that nothing is lost to the unit matrix where strains are small.
    template <int dim>
    Tensor<2, dim> green_lagrange(const Tensor<2, dim> &displacement_gradient)
    {
      return 0.5 * (displacement_gradient + transpose(displacement_gradient) +
                    transpose(displacement_gradient) * displacement_gradient);
    }

    /// Adds `derivative`(i, a, k, b) to each entry dP_ia/dF_kb of a tangent.
    template <int dim, class Derivative>
    void add_tangent(const Derivative &derivative, Stress<dim> &stress)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int b = 0; b < dim; ++b)
              stress.tangent[i * dim + a][k * dim + b] += derivative(i, a, k, b);
    }

    template <int dim>
    Stress<dim> linear_elastic(const Lame &constants, const Tensor<2, dim> &displacement_gradient)
    {
      const auto [lambda, mu] = constants;
      Stress<dim> stress;
      stress.piola = mu * (displacement_gradient + transpose(displacement_gradient));
      for (unsigned int i = 0; i < dim; ++i)
        stress.piola[i][i] += lambda * trace(displacement_gradient);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
        {
          stress.tangent[i * dim + i][j * dim + j] += lambda;
          stress.tangent[i * dim + j][i * dim + j] += mu;
          stress.tangent[i * dim + j][j * dim + i] += mu;
        }
      return stress;
    }

    template <int dim>
    Stress<dim> neo_hookean(const Lame &constants, const Tensor<2, dim> &displacement_gradient)
    {
      const double lambda = constants.lambda, mu = constants.mu;
      const auto log_J      = dilatation<dim>(MaterialModel::neo_hookean, displacement_gradient);
      const auto &inverse_t = log_J.derivative;
      const double pressure = lambda * log_J.value;

      Stress<dim> stress;
      stress.piola          = mu * (deformation_gradient(displacement_gradient) - inverse_t) + pressure * inverse_t;
      const auto derivative = [&](const auto i, const auto a, const auto k, const auto b)
      {
        return (i == k && a == b ? mu : 0.) + lambda * inverse_t[i][a] * inverse_t[k][b] +
               (mu - pressure) * inverse_t[i][b] * inverse_t[k][a];
      };
      add_tangent(derivative, stress);
      return stress;
    }

    template <int dim>
    double neo_hookean_energy(const Lame &constants, const Tensor<2, dim> &displacement_gradient)
    {
      const auto F       = deformation_gradient(displacement_gradient);
      const double log_J = std::log(determinant(F));
      return 0.5 * constants.mu * (F.norm_square() - dim) - constants.mu * log_J + 0.5 * constants.lambda * log_J * log_J;
    }

    template <int dim>
    Stress<dim> st_venant_kirchhoff(const Lame &constants, const Tensor<2, dim> &displacement_gradient)
    {
      const double lambda = constants.lambda, mu = constants.mu;
      const Tensor<2, dim> unit = dealii::unit_symmetric_tensor<dim>();
      const auto strain         = green_lagrange(displacement_gradient);
      const auto F              = deformation_gradient(displacement_gradient);
      const Tensor<2, dim> S    = lambda * trace(strain) * unit + 2. * mu * strain;
      const Tensor<2, dim> b    = F * transpose(F);

      Stress<dim> stress;
      stress.piola          = F * S;
      const auto derivative = [&](const auto i, const auto a, const auto k, const auto c)
      { return (i == k ? S[a][c] : 0.) + lambda * F[i][a] * F[k][c] + mu * ((a == c ? b[i][k] : 0.) + F[i][c] * F[k][a]); };
      add_tangent(derivative, stress);
      return stress;
    }

    template <int dim>
    double st_venant_kirchhoff_energy(const Lame &constants, const Tensor<2, dim> &displacement_gradient)
    {
      const auto strain = green_lagrange(displacement_gradient);
      return 0.5 * constants.lambda * trace(strain) * trace(strain) + constants.mu * strain.norm_square();
    }
  } // namespace

  Lame plane_constants(const ElasticConstants &constants, const PlaneState plane)
  {
    const auto [E, nu]  = constants;
    const double mu     = E / (2. * (1. + nu));
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
    return { plane == PlaneState::strain ? lambda : 2. * lambda * mu / (lambda + 2. * mu), mu };
  }

  template <int dim>
  Stress<dim> compute_stress(const MaterialModel model, const Lame &constants, const Tensor<2, dim> &displacement_gradient)
  {
    if (model == MaterialModel::linear)
      return linear_elastic<dim>(constants, displacement_gradient);
    if (model == MaterialModel::neo_hookean)
      return neo_hookean<dim>(constants, displacement_gradient);
    return st_venant_kirchhoff<dim>(constants, displacement_gradient);
  }

  template <int dim>
  double energy_density(const MaterialModel model, const Lame &constants, const Tensor<2, dim> &displacement_gradient)
  {
    if (model == MaterialModel::linear)
      return 0.5 * scalar_product(linear_elastic<dim>(constants, displacement_gradient).piola, displacement_gradient);
    if (model == MaterialModel::neo_hookean)
      return neo_hookean_energy<dim>(constants, displacement_gradient);
    return st_venant_kirchhoff_energy<dim>(constants, displacement_gradient);
  }

  template <int dim>
  Dilatation<dim> dilatation(const MaterialModel model, const Tensor<2, dim> &displacement_gradient)
  {
    Assert(model != MaterialModel::st_venant_kirchhoff, dealii::ExcNotImplemented());
    if (model == MaterialModel::linear)
      return { trace(displacement_gradient), dealii::unit_symmetric_tensor<dim>() };
    const auto F   = deformation_gradient(displacement_gradient);
    const double J = determinant(F);
    if (!(J > 0.))
      throw AnalysisError("an element turned inside out");
    return { std::log(J), transpose(invert(F)) };
  }

  /// d2 theta / dF_iJ dF_kL = -F^-T_iL F^-T_kJ where theta is ln J.
  template <int dim>
  Stress<dim> stress_at_pressure(const MaterialModel model, const double mu, const Tensor<2, dim> &displacement_gradient,
                                 const double pressure)
  {
    const auto slope = dilatation<dim>(model, displacement_gradient).derivative;
    auto stress      = compute_stress<dim>(model, { 0., mu }, displacement_gradient);
    stress.piola += pressure * slope;
    if (model == MaterialModel::linear)
      return stress;
    add_tangent([&](const auto i, const auto a, const auto k, const auto b) { return -pressure * slope[i][b] * slope[k][a]; },
                stress);
    return stress;
  }

  template Stress<2> compute_stress(MaterialModel, const Lame &, const Tensor<2, 2> &);
  template double energy_density(MaterialModel, const Lame &, const Tensor<2, 2> &);
  template Dilatation<2> dilatation(MaterialModel, const Tensor<2, 2> &);
  template Stress<2> stress_at_pressure(MaterialModel, double, const Tensor<2, 2> &, double);
  template Stress<3> compute_stress(MaterialModel, const Lame &, const Tensor<2, 3> &);
  template double energy_density(MaterialModel, const Lame &, const Tensor<2, 3> &);
  template Dilatation<3> dilatation(MaterialModel, const Tensor<2, 3> &);
  template Stress<3> stress_at_pressure(MaterialModel, double, const Tensor<2, 3> &, double);
} // namespace sprag
