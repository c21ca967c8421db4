// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "model/step/dynamic_model.h"
#include "model/step/linearisation.h"
#include "model/step/vibration.h"

#include <cmath>
#include <vector>

namespace sprag
{
  /// Eigenvalues no farther apart than this share of |lambda| count as one.
  constexpr double tie = 1e-7;

  bool are_tied(const StructureMode &a, const StructureMode &b);

  /// Symmetry of a mode of a pair: 1 where the levers mirror each other, -1 where the second does the opposite.
  double symmetric_share(const ComplexVector &displacements, const InterfaceLayout &layout);

  /// Two modes of a pair with one eigenvalue, as levers have that feel nothing of each other, are known up to their combinations.
  /// Puts the combination that mirrors most in place of the first and the one orthogonal to it in place of the second: where the
  /// levers are alike, one mirrors and the other swings. `displacements` holds those of the whole interface in each mode.
  void separate_ties(std::vector<StructureMode> &modes, std::vector<ComplexVector> &displacements, const InterfaceLayout &layout);

  /// Quadratic forms of an eigenmode phi that follow from the structure's own energies.
  struct ModeForms
  {
    double mass    = 0.; ///< phi^H M phi
    double spring  = 0.; ///< phi^H K phi, by parts
    double elastic = 0.;
    double support = 0.;
    double damping = 0.; ///< phi^H C phi
  };

  /// One part of a mode as a motion whose velocities equal its positions.
  inline Motion as_motion(const StructureMode &mode, const unsigned int part)
  {
    Motion motion;
    motion.coordinates.position = motion.coordinates.velocity = mode.coordinates[part];
    motion.coordinates.acceleration.reinit(mode.coordinates[part].size());
    motion.face_force = mode.face_force[part];
    return motion;
  }

  /// Adds the real part of a complex vector times a factor.
  inline void add_real_part(const std::complex<double> factor, const ComplexVector &vector, dealii::Vector<double> &sum)
  {
    sum.add(factor.real(), vector[0], -factor.imag(), vector[1]);
  }

  /// Adds a mode of a complex size, vibrating with its eigenvalue, to the coordinates and forces of a motion.
  inline void add_mode(const std::complex<double> size, const StructureMode &mode, Motion &motion)
  {
    add_real_part(size, mode.coordinates, motion.coordinates.position);
    add_real_part(size * mode.eigenvalue, mode.coordinates, motion.coordinates.velocity);
    add_real_part(size * mode.eigenvalue * mode.eigenvalue, mode.coordinates, motion.coordinates.acceleration);
    if (motion.face_force.size() > 0)
      add_real_part(size, mode.face_force, motion.face_force);
  }

  /// Structure: see ModalStructure.
  template <class Structure>
  ModeForms mode_forms(const Structure &structure, const StructureMode &mode)
  {
    ModeForms forms;
    for (unsigned int part = 0; part < 2; ++part)
    {
      const Motion motion = as_motion(mode, part);
      const auto energy   = structure.stored_energy(motion);
      forms.mass += 2. * energy.kinetic;
      forms.spring += 2. * energy.spring;
      forms.elastic += 2. * energy.elastic;
      forms.support += 2. * energy.support;
      forms.damping += structure.damping_form(motion);
    }
    return forms;
  }

  /// Shares of growth and energy: the real part of conj(lambda) phi^H (lambda^2 M + lambda C + K) phi = 0, which says that the
  /// mode's energy grows by 2 Re lambda times the power of what is not conservative. `displacements`: those of the whole
  /// interface.
  Eigenmode explained(StructureMode mode, ComplexVector displacements, const ModeForms &forms,
                      const LinearisedForces &perturbation, const InterfaceLayout &layout);

  /// All modes of a structure, those of a pair that tie separated.
  template <class Structure>
  std::vector<Eigenmode> explained(const Structure &structure, std::vector<StructureMode> modes,
                                   const LinearisedForces &perturbation, const InterfaceLayout &layout)
  {
    std::vector<ComplexVector> displacements;
    for (const auto &mode : modes)
      displacements.push_back({ { structure.positions(as_motion(mode, 0)), structure.positions(as_motion(mode, 1)) } });
    if (layout.levers == 2)
      separate_ties(modes, displacements, layout);
    std::vector<Eigenmode> result;
    for (std::size_t i = 0; i < modes.size(); ++i)
    {
      const auto forms = mode_forms(structure, modes[i]);
      result.push_back(explained(std::move(modes[i]), std::move(displacements[i]), forms, perturbation, layout));
    }
    return result;
  }
} // namespace sprag
