// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/eigenmodes.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    using Complex = std::complex<double>;

    /// Products conj(z_a) (F z)_a of the dofs that forces act on.
    std::vector<Complex> powers(const dealii::FullMatrix<double> &matrix, const std::vector<Complex> &z)
    {
      std::vector<Complex> result(z.size());
      for (unsigned int a = 0; a < matrix.m(); ++a)
      {
        Complex force;
        for (unsigned int b = 0; b < matrix.n(); ++b)
          force += matrix(a, b) * z[b];
        result[a] = std::conj(z[a]) * force;
      }
      return result;
    }

    double form(const dealii::FullMatrix<double> &matrix, const std::vector<Complex> &z)
    {
      Complex sum;
      for (const auto &power : powers(matrix, z))
        sum += power;
      return sum.real();
    }

    constexpr double tie_tolerance = 1e-6; ///< relative difference of displacements, as those of both sides in a mode that twists

    void add(const Complex factor, const ComplexVector &vector, ComplexVector &sum)
    {
      sum[0].add(factor.real(), vector[0], -factor.imag(), vector[1]);
      sum[1].add(factor.real(), vector[1], factor.imag(), vector[0]);
    }

    void multiply(ComplexVector &vector, const Complex factor)
    {
      if (vector[0].size() == 0) // face forces of a reduced lever
        return;
      const dealii::Vector<double> zero(vector[0].size());
      ComplexVector product{ { zero, zero } };
      add(factor, vector, product);
      vector = std::move(product);
    }

    /// To modal mass 1 and a rotation, or the largest displacement if there is none, the first of those alike, that is real and
    /// positive.
    void normalise(const double mass, const unsigned int rotation, StructureMode &mode, ComplexVector &displacements)
    {
      unsigned int reference = rotation;
      const auto size        = [&](const unsigned int dof) { return std::hypot(displacements[0][dof], displacements[1][dof]); };
      unsigned int largest   = 0;
      for (unsigned int dof = 0; dof < displacements[0].size(); ++dof)
        if (size(dof) > (1. + tie_tolerance) * size(largest))
          largest = dof;
      if (size(rotation) < 1e-9 * size(largest))
        reference = largest;
      const Complex value(displacements[0][reference], displacements[1][reference]);
      const Complex factor = std::conj(value) / std::abs(value) / std::sqrt(mass);
      for (auto *const vector : { &mode.coordinates, &mode.face_force, &displacements })
        multiply(*vector, factor);
    }
  } // namespace

  Eigenmode explained(StructureMode mode, ComplexVector displacements, const ModeForms &forms,
                      const LinearisedForces &perturbation, const InterfaceLayout &layout)
  {
    Eigenmode result;
    const Complex lambda = mode.eigenvalue;
    std::vector<Complex> z;
    for (const unsigned int dof : perturbation.dofs)
      z.emplace_back(displacements[0][dof], displacements[1][dof]);

    const double contact   = -form(perturbation.pressure, z);
    const double potential = forms.spring + forms.elastic + forms.support + contact;
    const double mass      = forms.mass + form(perturbation.inertia, z);
    const double rate      = std::norm(lambda);
    const double energy    = rate * mass + potential;

    auto &growth         = result.growth;
    const auto delayed   = perturbation.by_delays(lambda, z);
    auto friction        = powers(perturbation.friction, z);
    double velocity_part = rate * form(perturbation.friction_rate, z);
    for (unsigned int a = 0; a < z.size(); ++a)
    {
      friction[a] += std::conj(z[a]) * delayed.by_displacement[a];
      velocity_part += (std::conj(lambda * z[a]) * delayed.by_velocity[a]).real();
    }
    for (unsigned int a = 0; a < friction.size(); ++a)
    {
      const unsigned int dof = perturbation.dofs[a];
      const double share     = (std::conj(lambda) * friction[a]).real() / energy;
      if (layout.is_surface(dof) || layout.is_slope(dof))
        growth.friction_bending += share;
      else if (layout.is_rotation(dof))
        growth.friction_rotation += share;
      else
        growth.friction_support += share;
    }
    growth.friction_speed    = velocity_part / energy;
    growth.contact_damping   = rate * form(perturbation.pressure_rate, z) / energy;
    growth.structure_damping = -rate * forms.damping / energy;

    result.energy = { forms.spring / potential, forms.elastic / potential, forms.support / potential, contact / potential };
    normalise(mass, layout.rotation(), mode, displacements);
    if (layout.levers == 2)
      result.symmetry = symmetric_share(displacements, layout);
    result.mode          = std::move(mode);
    result.displacements = std::move(displacements);
    return result;
  }

  namespace
  {
    Complex at(const ComplexVector &vector, const unsigned int i)
    {
      return { vector[0][i], vector[1][i] };
    }

    /// Products a^H b over both levers, and with the levers of b exchanged.
    struct Products
    {
      Complex own;
      Complex crossed;
    };

    Products products(const ComplexVector &a, const ComplexVector &b, const InterfaceLayout &layout)
    {
      Products result;
      for (unsigned int i = layout.first(0); i <= layout.rotation(0); ++i)
      {
        const unsigned int j = layout.first(1) + i;
        result.own += std::conj(at(a, i)) * at(b, i) + std::conj(at(a, j)) * at(b, j);
        result.crossed += std::conj(at(a, i)) * at(b, j) + std::conj(at(a, j)) * at(b, i);
      }
      return result;
    }

    /// Factors of two vectors, a column a combination.
    using Factors = std::array<std::array<Complex, 2>, 2>;

    void combine(const Factors &factors, ComplexVector &a, ComplexVector &b)
    {
      if (a[0].size() == 0)
        return;
      std::array<ComplexVector, 2> sums;
      for (unsigned int k = 0; k < 2; ++k)
      {
        sums[k][0].reinit(a[0].size());
        sums[k][1].reinit(a[0].size());
        add(factors[0][k], a, sums[k]);
        add(factors[1][k], b, sums[k]);
      }
      a = std::move(sums[0]);
      b = std::move(sums[1]);
    }

    /// Finds the factors that separate a tied pair of modes with these displacements; returns false where they are one mode
    /// twice.
    bool separating(const ComplexVector &a, const ComplexVector &b, const InterfaceLayout &layout, Factors &factors)
    {
      const auto aa = products(a, a, layout), ab = products(a, b, layout), bb = products(b, b, layout);
      // Orthonormal: a / size, (b - share a) / rest.
      const double size   = std::sqrt(aa.own.real());
      const Complex share = ab.own / aa.own.real();
      const double rest   = std::sqrt(std::max(0., bb.own.real() - std::norm(ab.own) / aa.own.real()));
      if (!(size > 0.) || rest <= 1e-6 * std::sqrt(bb.own.real()))
        return false;
      const double first  = aa.crossed.real() / (size * size);
      const Complex mixed = (ab.crossed - share * aa.crossed) / (size * rest);
      const double second =
          (bb.crossed - 2. * std::real(std::conj(share) * ab.crossed) + std::norm(share) * aa.crossed).real() / (rest * rest);
      const double turn   = 0.5 * std::atan2(2. * std::abs(mixed), first - second);
      const Complex phase = std::abs(mixed) > 0. ? std::conj(mixed) / std::abs(mixed) : 1.;

      const std::array<std::array<Complex, 2>, 2> orthonormal = { { { { std::cos(turn), -std::sin(turn) } },
                                                                    { { std::sin(turn) * phase, std::cos(turn) * phase } } } };
      for (unsigned int k = 0; k < 2; ++k)
      {
        factors[0][k] = orthonormal[0][k] / size - share * orthonormal[1][k] / rest;
        factors[1][k] = orthonormal[1][k] / rest;
      }
      return true;
    }
  } // namespace

  bool are_tied(const StructureMode &a, const StructureMode &b)
  {
    return std::abs(a.eigenvalue - b.eigenvalue) <= tie * std::abs(a.eigenvalue);
  }

  double symmetric_share(const ComplexVector &displacements, const InterfaceLayout &layout)
  {
    const auto found = products(displacements, displacements, layout);
    return found.crossed.real() / found.own.real();
  }

  void separate_ties(std::vector<StructureMode> &modes, std::vector<ComplexVector> &displacements, const InterfaceLayout &layout)
  {
    for (std::size_t i = 0; i + 1 < modes.size(); ++i)
    {
      StructureMode &a = modes[i], &b = modes[i + 1];
      Factors factors;
      if (!are_tied(a, b) || !separating(displacements[i], displacements[i + 1], layout, factors))
        continue;
      combine(factors, displacements[i], displacements[i + 1]);
      combine(factors, a.coordinates, b.coordinates);
      combine(factors, a.face_force, b.face_force);
      a.residual = b.residual = std::max(a.residual, b.residual);
      ++i;
    }
  }
} // namespace sprag
