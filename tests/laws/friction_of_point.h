// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/point_law.h"

#include <deal.II/base/tensor.h>

/// Friction of a contact point in numbers, with the derivatives that its dual numbers bring.
namespace sprag::test
{
  /// Sets variables of dual numbers from number `first` on.
  template <class N, int slips>
  Several<N, slips> variables(const dealii::Tensor<1, slips> &at, const int first)
  {
    Several<N, slips> result;
    for (int i = 0; i < slips; ++i)
      result[i] = variable<N>(at[i], first + i);
    return result;
  }

  template <class N, int slips>
  dealii::Tensor<1, slips> values(const Several<N, slips> &numbers)
  {
    dealii::Tensor<1, slips> result;
    for (int i = 0; i < slips; ++i)
      result[i] = value(numbers[i]);
    return result;
  }

  /// Derivatives by variables from number `first` on.
  template <class N, int slips>
  dealii::Tensor<2, slips> derivatives(const Several<N, slips> &numbers, const int first)
  {
    dealii::Tensor<2, slips> result;
    for (int i = 0; i < slips; ++i)
      for (int j = 0; j < slips; ++j)
        result[i][j] = numbers[i].d[first + j];
    return result;
  }

  template <class N, int slips>
  dealii::Tensor<1, slips> derivative(const Several<N, slips> &numbers, const int by)
  {
    dealii::Tensor<1, slips> result;
    for (int i = 0; i < slips; ++i)
      result[i] = numbers[i].d[by];
    return result;
  }

  template <int slips>
  struct FrictionTraction
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<2, slips> d_trial;
    dealii::Tensor<1, slips> d_pressure;
    double mu;
    bool slipping;
    dealii::Tensor<2, slips> d_shift;
  };

  template <int slips>
  FrictionTraction<slips> friction_traction(const dealii::Tensor<1, slips> &trial, const double pressure, const FrictionLaw &law,
                                            const double penalty, const double dt, const dealii::Tensor<1, slips> &shift = {})
  {
    using N           = Dual<double, 2 * slips + 1>;
    const auto trials = variables<N>(trial, 0);
    const auto found =
        return_to_cone(slip_law(law, penalty), trials, variable<N>(pressure, 2 * slips), dt, variables<N>(shift, slips), trials);
    return { values(found.traction), derivatives(found.traction, 0),    derivative(found.traction, 2 * slips), found.mu,
             found.slipping,         derivatives(found.traction, slips) };
  }

  template <int slips>
  struct FrictionHistory
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<1, slips> slip_speed;
    double step = 0.;
    double mu   = 0.;
  };

  template <int slips>
  struct EndFriction
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<2, slips> d_slip;
    dealii::Tensor<1, slips> d_pressure;
    double mu;
    bool slipping;
    dealii::Tensor<1, slips> slip_speed;
    double energy, dissipated, creep;
  };

  template <int slips>
  EndFriction<slips> end_friction(const FrictionHistory<slips> &history, const double stiffness,
                                  const dealii::Tensor<1, slips> &slip, const double pressure, const FrictionLaw &law,
                                  const double dt, const bool is_layer = false)
  {
    using N = Dual<double, slips + 1>;
    SlipHistory<double, slips> slip_history;
    slip_history.step = history.step;
    slip_history.mu   = history.mu;
    for (int i = 0; i < slips; ++i)
    {
      slip_history.traction[i]   = history.traction[i];
      slip_history.slip_speed[i] = history.slip_speed[i];
    }
    const auto found = sprag::end_friction(slip_law(law, stiffness, is_layer), slip_history, variables<N>(slip, 0),
                                           variable<N>(pressure, slips), dt);
    return { values(found.traction),
             derivatives(found.traction, 0),
             derivative(found.traction, slips),
             found.mu,
             found.slipping,
             values(found.slip_speed),
             found.energy,
             found.dissipated,
             found.creep };
  }
} // namespace sprag::test
