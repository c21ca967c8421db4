// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/cell_elasticity.h"
#include "fe/solid/shared_factors.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <map>

namespace sprag
{
  /// Material and shape of a cell up to a shift, in steps of a nanometre: cells that are alike share stiffness and mass.
  std::vector<long> likeness(const dealii::DoFHandler<3>::active_cell_iterator &cell);

  /// Stiffnesses of cells without load, found once for those that are alike.
  class CellStiffness
  {
  public:
    /// All must outlive this.
    CellStiffness(const dealii::Mapping<3> &mapping, const dealii::FiniteElement<3> &fe, const BodyProperties &properties);

    const dealii::FullMatrix<double> &operator()(const dealii::DoFHandler<3>::active_cell_iterator &cell);

  private:
    CellElasticity<3> elasticity;
    const dealii::Vector<double> at_rest;
    dealii::Vector<double> no_forces;
    std::map<std::vector<long>, dealii::FullMatrix<double>> known; ///< by likeness()
  };

  /// Data from which a linear stiffness is assembled.
  struct StiffnessSource
  {
    const dealii::Mapping<3> &mapping;
    const dealii::DoFHandler<3> &dof_handler;
    const dealii::AffineConstraints<double> &constraints;
    const BodyProperties &properties;
  };

  // Parts of a body are given by a number for each degree of freedom, from 0, -1 where it is not of the part; no numbers stand
  // for the whole body.

  /// Returns the number of displacements of a part.
  unsigned int size_of_part(const StiffnessSource &source, const std::vector<int> &number_in_part);

  /// Returns the numbers of a cell's displacements, -1 also where they are held.
  std::vector<int> numbers_of(const dealii::DoFHandler<3>::active_cell_iterator &cell, const StiffnessSource &source,
                              const std::vector<int> &number_in_part);

  /// Returns this rank's entries of the stiffness of a part of a body without load, with unit entries for held degrees of
  /// freedom. To be called by all ranks.
  SymmetricEntries assemble_stiffness(const StiffnessSource &source, const std::vector<int> &number_in_part);
} // namespace sprag
