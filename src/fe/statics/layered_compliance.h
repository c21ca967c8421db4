// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/statics/solid_body.h"
#include "model/interface/interface_forces.h"

#include <deal.II/lac/full_matrix.h>

#include <map>
#include <memory>

namespace sprag
{
  /// Compliance G between the displacements of the friction face's nodes, three a node, the body held at its hub [mm/N].
  ///
  /// It is that of the body's near-surface layer on a rigid bond, which is known exactly and dies away within some depths, and
  /// the answer of what is behind the bond to the forces that the near-surface layer hands on. They are smooth there: the answer
  /// is found for loads on the bond, hats of some spacing in all three directions (attachment modes; Galerkin, so that the part
  /// left out is never negative), and is symmetric, Z Z^T. Without a near-surface layer the near part is the whole body's and
  /// exact.
  ///
  /// The near part is found in columns of nodes with the same xi, once for those whose surroundings in the near-surface layer are
  /// alike.
  class LayeredCompliance
  {
  public:
    /// `begin` ... `end`: part of the face where forces act, along xi [mm]. `spacing_over_depth`: of the loads on the bond along
    /// xi, over the depth of the near-surface layer, > 0; the smaller, the less is left out. The body must outlive this.
    LayeredCompliance(const SolidBody &body, double begin, double end, double spacing_over_depth = 1.);

    /// Returns the dofs of the columns of nodes that hold some, increasing. Dofs are numbers among the face's displacements,
    /// sorted by the columns, see surface_dofs().
    DofSelection whole_blocks(const DofSelection &surface_dofs) const;

    /// Returns the compliance between some dofs, which make up whole columns.
    std::shared_ptr<const dealii::FullMatrix<double>> among(const DofSelection &whole_blocks);

    /// Returns the displacements of some dofs by forces on others, those of the near-surface layer left out where they are
    /// further away than it reaches [mm].
    dealii::Vector<double> displacements(const DofSelection &surface_dofs, const DofLoads &forces);

    unsigned int basis_size() const
    {
      return static_cast<unsigned int>(basis.n());
    }

  private:
    /// Nodes of the face with the same xi.
    struct Block
    {
      double xi;
      unsigned int begin;       ///< its first dof
      unsigned int end;         ///< beyond the last
      unsigned int like;        ///< one in the middle of those with the same surroundings
      unsigned int n_alike = 1; ///< blocks that answer like it, itself among them
    };

    /// Displacements near a block by unit forces on it: a matrix for each block from `first` on, a column a force.
    struct NearColumns
    {
      int first; ///< over the number of the block itself
      std::vector<dealii::FullMatrix<double>> block_matrices;
    };

    void find_blocks(double surroundings);
    void find_basis(double begin, double end, double spacing);
    bool is_like(unsigned int row_block, unsigned int column_block) const;
    unsigned int stand_in(unsigned int row_block, unsigned int column_block) const;
    const std::vector<double> &near_row(unsigned int surface_dof);
    double near_displacement(unsigned int surface_dof, const DofLoads &forces);
    const dealii::FullMatrix<double> *near_block(unsigned int row_block, unsigned int column_block);
    dealii::FullMatrix<double> block(unsigned int row_block, unsigned int column_block);
    const NearColumns &near_columns(unsigned int block_index);
    NearColumns find_near_columns(unsigned int block_index) const;
    unsigned int containing_block(unsigned int surface_dof) const;
    std::vector<unsigned int> block_numbers(const DofSelection &whole_blocks) const;

    const SolidBody &body;
    const std::vector<unsigned int> dofs; ///< of the body
    std::vector<Block> blocks;
    std::map<unsigned int, NearColumns> known; ///< by the block
    std::map<unsigned int, std::vector<double>> known_rows;
    dealii::FullMatrix<double> basis; ///< Z, a row a dof

    // The last matrix, most of which the next one contains too, and the one before, whose memory the next one takes.
    DofSelection last_dofs;
    std::shared_ptr<dealii::FullMatrix<double>> last_matrix, spare_matrix;
  };
} // namespace sprag
