// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/linearisation.h"

#include "base/ranges.h"
#include "model/interface/interface_forces.h"

#include <algorithm>

namespace sprag
{
  using dealii::FullMatrix;
  using dealii::Vector;
  using Complex = std::complex<double>;

  namespace
  {
    FullMatrix<double> sum(const FullMatrix<double> &a, const FullMatrix<double> &b)
    {
      FullMatrix<double> result = a;
      if (!result.empty()) // of a lever out of contact
        result.add(1., b);
      return result;
    }

    void subtract_product(const dealii::Vector<double> &column, const dealii::Vector<double> &row, FullMatrix<double> &matrix)
    {
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (unsigned int j = 0; j < matrix.n(); ++j)
          matrix(i, j) -= column[i] * row[j];
    }

    Complex product(const dealii::Vector<double> &row, const ComplexAmplitudes &z)
    {
      Complex result;
      for (unsigned int i = 0; i < row.size(); ++i)
        result += row[i] * z[i];
      return result;
    }

    void add_product(const Complex factor, const FullMatrix<double> &matrix, const ComplexAmplitudes &z, ComplexAmplitudes &sum)
    {
      for (unsigned int i = 0; i < matrix.m(); ++i)
      {
        Complex row_product;
        for (unsigned int j = 0; j < matrix.n(); ++j)
          row_product += matrix(i, j) * z[j];
        sum[i] += factor * row_product;
      }
    }

    /// Entries at places among `size`.
    dealii::Vector<double> spread(const dealii::Vector<double> &row, const std::vector<unsigned int> &places,
                                  const unsigned int size)
    {
      dealii::Vector<double> result(size);
      for (unsigned int i = 0; i < places.size(); ++i)
        result[places[i]] = row[i];
      return result;
    }
  } // namespace

  LinearisedForces::LinearisedForces(std::vector<unsigned int> on_dofs)
      : dofs(std::move(on_dofs))
  {
    const auto n = static_cast<unsigned int>(dofs.size());
    for (const auto matrix : force_matrices)
      (this->*matrix).reinit(n, n);
  }

  void LinearisedForces::add(const LinearisedForces &other)
  {
    const auto places = find_indices(other.dofs, dofs);
    for (const auto matrix : force_matrices)
      for (unsigned int i = 0; i < places.size(); ++i)
        (this->*matrix).add(places[i], places.size(), places.data(), &(other.*matrix)(i, 0));
    const auto n = static_cast<unsigned int>(dofs.size());
    for (const auto &delay : other.delays)
      delays.push_back({ delay.time, spread(delay.force, places, n), spread(delay.stiffness_row, places, n),
                         spread(delay.rate_row, places, n) });
  }

  FullMatrix<double> LinearisedForces::stiffness() const
  {
    return sum(pressure, friction);
  }

  FullMatrix<double> LinearisedForces::damping() const
  {
    return sum(pressure_rate, friction_rate);
  }

  FullMatrix<double> LinearisedForces::immediate_stiffness() const
  {
    auto result = stiffness();
    for (const auto &delay : delays)
      subtract_product(delay.force, delay.stiffness_row, result);
    return result;
  }

  FullMatrix<double> LinearisedForces::immediate_damping() const
  {
    auto result = damping();
    for (const auto &delay : delays)
      subtract_product(delay.force, delay.rate_row, result);
    return result;
  }

  ComplexAmplitudes LinearisedForces::forces(const Complex lambda, const ComplexAmplitudes &z) const
  {
    auto [result, by_velocity] = by_delays(lambda, z);
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] += by_velocity[i];
    for (const auto *const matrix : { &pressure, &friction })
      add_product(1., *matrix, z, result);
    for (const auto *const matrix : { &pressure_rate, &friction_rate })
      add_product(lambda, *matrix, z, result);
    add_product(-lambda * lambda, inertia, z, result);
    return result;
  }

  LinearisedForces::DelayedForces LinearisedForces::by_delays(const Complex lambda, const ComplexAmplitudes &z) const
  {
    DelayedForces result{ ComplexAmplitudes(z.size()), ComplexAmplitudes(z.size()) };
    for (const auto &delay : delays)
    {
      const Complex change       = -lambda * delay.time / (1. + lambda * delay.time);
      const Complex displacement = change * product(delay.stiffness_row, z);
      const Complex velocity     = change * lambda * product(delay.rate_row, z);
      for (unsigned int i = 0; i < z.size(); ++i)
      {
        result.by_displacement[i] += delay.force[i] * displacement;
        result.by_velocity[i] += delay.force[i] * velocity;
      }
    }
    return result;
  }

  LinearisedForces LinearisedForces::with_joined_delays(const double highest_rate) const
  {
    constexpr double negligible = 1e-3;
    double longest              = 0.;
    for (const auto &delay : delays)
      longest = std::max(longest, delay.time);
    const auto is_apart = [&](const FrictionDelay &delay)
    { return !(delay.time > 0.) || delay.time * (longest - delay.time) * highest_rate * highest_rate > negligible; };
    if (delays.size() <= dofs.size() || std::any_of(delays.begin(), delays.end(), is_apart))
      return *this;

    auto result      = *this;
    const auto n     = static_cast<unsigned int>(dofs.size());
    const auto empty = FrictionDelay{ longest, Vector<double>(n), Vector<double>(n), Vector<double>(n) };
    result.delays.assign(n, empty);
    for (unsigned int dof = 0; dof < n; ++dof)
      result.delays[dof].force[dof] = 1.;
    for (const auto &delay : delays)
      for (unsigned int dof = 0; dof < n; ++dof)
        if (const double share = delay.time / longest * delay.force[dof]; share != 0.)
        {
          result.delays[dof].stiffness_row.add(share, delay.stiffness_row);
          result.delays[dof].rate_row.add(share, delay.rate_row);
        }
    const auto is_idle = [](const FrictionDelay &joined)
    { return joined.stiffness_row.all_zero() && joined.rate_row.all_zero(); };
    result.delays.erase(std::remove_if(result.delays.begin(), result.delays.end(), is_idle), result.delays.end());
    return result;
  }
} // namespace sprag
