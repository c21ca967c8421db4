// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/mode_symmetry.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    using Complex = std::complex<double>;

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

    void add(const Complex factor, const ComplexVector &vector, ComplexVector &sum)
    {
      sum[0].add(factor.real(), vector[0], -factor.imag(), vector[1]);
      sum[1].add(factor.real(), vector[1], factor.imag(), vector[0]);
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
