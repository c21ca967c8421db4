// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/growth.h"

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

    constexpr double alike = 1e-6; ///< relative difference of displacements, as those of both sides in a mode that twists

    void multiply(ComplexVector &vector, const Complex factor)
    {
      if (vector[0].size() == 0) // face forces of a reduced lever
        return;
      const auto real = vector[0];
      vector[0] *= factor.real();
      vector[0].add(-factor.imag(), vector[1]);
      vector[1] *= factor.real();
      vector[1].add(factor.imag(), real);
    }

    /// To modal mass 1 and a rotation, or the largest displacement if there is none, the first of those alike, that is real and
    /// positive.
    void normalise(const double mass, const unsigned int rotation, StructureMode &mode, ComplexVector &displacements)
    {
      unsigned int reference = rotation;
      const auto size        = [&](const unsigned int dof) { return std::hypot(displacements[0][dof], displacements[1][dof]); };
      unsigned int largest   = 0;
      for (unsigned int dof = 0; dof < displacements[0].size(); ++dof)
        if (size(dof) > (1. + alike) * size(largest))
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
} // namespace sprag
