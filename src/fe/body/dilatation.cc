#include "fe/body/dilatation.h"

#include "base/errors.h"

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace sprag
{
  using dealii::Tensor;

  template <int dim>
  Dilatation<dim> dilatation(const MaterialModel model, const Tensor<2, dim> &displacement_gradient)
  {
    Assert(model != MaterialModel::st_venant_kirchhoff, dealii::ExcNotImplemented());
    const Tensor<2, dim> unit = dealii::unit_symmetric_tensor<dim>();
    if (model == MaterialModel::linear)
      return { trace(displacement_gradient), unit };
    const Tensor<2, dim> F = unit + displacement_gradient;
    const double J         = determinant(F);
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
    if (model == MaterialModel::linear)
    {
      auto stress = linear_elastic<dim>({ 0., mu }, displacement_gradient);
      stress.piola += pressure * slope;
      return stress;
    }
    const Tensor<2, dim> unit = dealii::unit_symmetric_tensor<dim>();
    auto stress               = neo_hookean<dim>({ 0., mu }, unit + displacement_gradient);
    stress.piola += pressure * slope;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int b = 0; b < dim; ++b)
            stress.tangent[i * dim + a][k * dim + b] -= pressure * slope[i][b] * slope[k][a];
    return stress;
  }

  template Dilatation<2> dilatation(MaterialModel, const Tensor<2, 2> &);
  template Stress<2> stress_at_pressure(MaterialModel, double, const Tensor<2, 2> &, double);
} // namespace sprag
