// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_compliance.h"
#include "model/interface/interface_layout.h"
#include "model/step/dynamic_model.h"
#include "model/step/linearisation.h"

#include <cmath>
#include <utility>

namespace sprag
{
  /// Transforms between the interface z1, z2 of a mirrored pair and those of two structures of one lever each, the symmetric
  /// motion zs (0) and the antisymmetric za (1):
  ///   z1 = (zs + za)/sqrt(2),  z2 = (zs - za)/sqrt(2).
  /// A sprung support moves with the symmetric motion alone, by z/sqrt(2). With T the matrix of this transformation, forces f of
  /// the pair act on the structures as T^T f, and matrices A as T^T A T.
  class MirroredInterface
  {
  public:
    /// `lever_layout`: layout of either structure.
    explicit MirroredInterface(const InterfaceLayout &lever_layout);

    /// The layout of the pair.
    const InterfaceLayout &layout() const
    {
      return pair;
    }

    /// Returns 1/sqrt(2), the magnitude of the entries of T.
    static double share()
    {
      return std::sqrt(0.5);
    }

    /// Returns the dofs of a structure on which dofs of the pair depend, increasing.
    DofSelection structure_dofs(const DofSelection &paired) const;

    /// Returns the displacements of the pair from those of both structures.
    dealii::Vector<double> displacements(const dealii::Vector<double> &symmetric,
                                         const dealii::Vector<double> &antisymmetric) const;

    /// Returns the state of a dof of the pair from those of both structures at its structure_dof().
    DofState state(unsigned int pair_dof, const DofState &symmetric, const DofState &antisymmetric) const;

    /// Returns the number of a pair's dof in either structure.
    unsigned int structure_dof(const unsigned int pair_dof) const
    {
      return is_support(pair_dof) ? pair.dofs_per_lever() : pair_dof % pair.dofs_per_lever();
    }

    /// Returns the forces on a structure, motion 0 or 1, by forces on the pair; without tangent.
    InterfaceForces forces(const InterfaceForces &paired, unsigned int motion) const;

    /// Returns the compliance of the pair, with blocks (Gs + Ga)/2 for each lever and (Gs - Ga)/2 between them. `identical`: Gs =
    /// Ga, so that the levers are uncoupled.
    InterfaceCompliance compliance(const InterfaceCompliance &symmetric, const InterfaceCompliance &antisymmetric,
                                   bool identical) const;

    /// Returns linear forces on both structures; dofs of the antisymmetric motion are numbered after those of the symmetric.
    LinearisedForces on_both(const LinearisedForces &paired) const;

    /// Returns true if forces of on_both() couple the motions by more than round-off: the levers' forces are not symmetric.
    bool couples(const LinearisedForces &on_both) const;

    /// Returns linear forces on one structure for symmetric forces. `both`: on_both() of them.
    LinearisedForces on_structure(const LinearisedForces &paired, const LinearisedForces &both, unsigned int motion) const;

  private:
    InterfaceLayout pair;

    unsigned int structure_size() const
    {
      return pair.dofs_per_lever() + (pair.sprung ? 1 : 0);
    }

    bool is_support(const unsigned int pair_dof) const
    {
      return pair.sprung && pair_dof == pair.support();
    }

    std::pair<unsigned int, unsigned int> range(const LinearisedForces &both, unsigned int motion) const;
    bool acts_on_first_lever(const DofSelection &dofs, const FrictionDelay &delay) const;
  };
} // namespace sprag
