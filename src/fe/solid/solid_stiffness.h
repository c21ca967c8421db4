#pragma once

#include "fe/body/body_properties.h"
#include "fe/solid/shared_factors.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace sprag
{
  /// Material and shape of a cell up to a shift, in steps of a nanometre: cells that are alike share stiffness and mass.
  std::vector<long> likeness(const dealii::DoFHandler<3>::active_cell_iterator &cell);

  /// What a linear stiffness is made of.
  struct StiffnessSource
  {
    const dealii::Mapping<3> &mapping;
    const dealii::DoFHandler<3> &dof_handler;
    const dealii::AffineConstraints<double> &constraints;
    const BodyProperties &properties;
  };

  struct SolidStiffness
  {
    SymmetricEntries whole; ///< unit entries for held degrees of freedom
    SymmetricEntries part;  ///< likewise
  };

  /// Returns this rank's entries of the stiffness of a body without load, and of the part of it between those degrees of freedom
  /// that `number_in_part` numbers from 0, -1 elsewhere; without numbers there is no part. To be called by all ranks.
  SolidStiffness assemble_stiffness(const StiffnessSource &source, const std::vector<int> &number_in_part);
} // namespace sprag
