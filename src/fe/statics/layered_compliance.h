// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/statics/solid_body.h"
#include "fe/statics/static_interface.h"
#include "model/interface/interface_forces.h"

#include <deal.II/lac/full_matrix.h>

#include <limits>
#include <map>
#include <memory>

namespace sprag
{
  /// Compliance G between the displacements of the friction face's nodes, three a node, the body held at its hub [mm/N].
  ///
  /// G = G_near + Z Z^T. G_near is that of the near-surface layer fixed at its interface to the body behind; it is exact and
  /// decays along the face within some depths of the layer. Z Z^T is the Galerkin approximation of the rest by attachment modes:
  /// responses to smooth loads (products of hat functions) on that interface. The part left out is positive semidefinite.
  /// Without a near-surface layer G = G_near of the whole body, without error.
  ///
  /// G_near is computed in blocks of nodes with the same xi, once for all blocks with equal surroundings in the layer.
  class LayeredCompliance : public FaceCompliance
  {
  public:
    /// Forces act on the face between `begin` and `end` along xi [mm]. `spacing_over_depth` > 0 is the spacing of the attachment
    /// loads along xi over the layer's depth; smaller ones leave out less. The body must outlive this object.
    LayeredCompliance(const SolidBody &body, double begin, double end, double spacing_over_depth = 1.);

    /// Returns the displacements of some dofs by forces on others [mm]; negligible entries of G_near are left out.
    dealii::Vector<double> displacements(const DofSelection &surface_dofs, const DofLoads &forces);

    /// Returns the number of attachment modes, columns of Z.
    unsigned int basis_size() const
    {
      return static_cast<unsigned int>(basis.n());
    }

  private:
    /// Nodes of the face with the same xi.
    struct Block
    {
      double xi;                      ///< [mm]
      unsigned int representative;    ///< block with equal surroundings whose columns serve for this one
      unsigned int n_represented = 1; ///< blocks with equal surroundings, this one included
    };

    /// Columns of G_near for unit forces on a block: one matrix for each block of rows, from `first` on.
    struct NearColumns
    {
      int first; ///< number of the first block of rows less that of the loaded block
      std::vector<dealii::FullMatrix<double>> block_matrices;
    };

    void divide(double surroundings);
    void find_reach();
    void find_basis(double begin, double end, double spacing);
    bool is_represented(unsigned int row_block, unsigned int column_block) const;
    const NearColumns &near_columns(unsigned int block_index);
    const dealii::FullMatrix<double> *near_block(unsigned int row_block, unsigned int column_block);
    dealii::FullMatrix<double> block(const BlockPair &rows_and_columns) override;
    NearColumns find_near_columns(unsigned int block_index) const;

    const SolidBody &body;
    const std::vector<unsigned int> dofs; ///< of the body, by number on the face
    std::vector<Block> blocks;
    std::map<unsigned int, NearColumns> known; ///< by block
    dealii::FullMatrix<double> basis;          ///< Z, dofs x attachment modes

    /// Distance along xi beyond which G_near is negligible [mm].
    double reach = std::numeric_limits<double>::infinity();
  };
} // namespace sprag
