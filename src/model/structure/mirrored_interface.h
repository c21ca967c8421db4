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
  /// Interface of a mirrored pair as those of two structures of one lever each: of the symmetric motion (0), in which the levers
  /// mirror each other, and of the antisymmetric (1), in which the second does the opposite, each at 1/sqrt(2) of its size for
  /// both. A sprung support moves with the first alone.
  class MirroredInterface
  {
  public:
    /// `lever_compliance`: layout of either structure.
    explicit MirroredInterface(const InterfaceLayout &lever_layout);

    /// The layout of the pair.
    const InterfaceLayout &layout() const
    {
      return pair;
    }

    /// Share of a structure's motion in each lever's: 1/sqrt(2), apart from the sign of the second lever's.
    static double share()
    {
      return std::sqrt(0.5);
    }

    /// Returns the dofs of a structure that dofs of the pair depend on.
    DofSelection structure_dofs(const DofSelection &paired) const;

    /// Returns the displacements of the pair from those of both structures.
    dealii::Vector<double> displacements(const dealii::Vector<double> &symmetric,
                                         const dealii::Vector<double> &antisymmetric) const;

    /// Returns the state of a dof of the pair by that of the structures' dof, see structure_dof().
    DofState state(unsigned int pair_dof, const DofState &symmetric, const DofState &antisymmetric) const;

    unsigned int structure_dof(const unsigned int pair_dof) const
    {
      return is_support(pair_dof) ? pair.dofs_per_lever() : pair_dof % pair.dofs_per_lever();
    }

    /// Returns forces on the pair as those on a structure, without their tangent.
    InterfaceForces forces(const InterfaceForces &paired, unsigned int motion) const;

    /// Returns the compliance of the pair. `alike`: whether both structures answer alike, so that levers feel nothing of each
    /// other.
    InterfaceCompliance compliance(const InterfaceCompliance &symmetric, const InterfaceCompliance &antisymmetric,
                                   bool alike) const;

    /// Returns linear forces on both structures, those of the antisymmetric motion counted on from the number of the other's.
    LinearisedForces on_both(const LinearisedForces &paired) const;

    /// Returns true if forces of on_both() couple the structures by more than round-off, as the levers' forces do not mirror.
    bool couples(const LinearisedForces &on_both) const;

    /// Linear forces on one structure, where forces mirror as the levers do. `both`: on_both() of them.
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

    dealii::FullMatrix<double> displacements_by(const DofSelection &both_dofs, const DofSelection &paired) const;
    std::pair<unsigned int, unsigned int> range(const LinearisedForces &both, unsigned int motion) const;
    bool acts_on_first_lever(const DofSelection &dofs, const FrictionDelay &delay) const;
  };
} // namespace sprag
