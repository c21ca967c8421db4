// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "model/port_forces.h"

#include <map>
#include <utility>

namespace sprag
{
  /// Compliance between the displacements of a face's nodes, the body held at its hub [mm/N]. A contact meets few of them at a
  /// time: the compliance is found in tiles, where it is asked for, as entries of the inverse of the stiffness, and kept.
  class SurfaceCompliance
  {
  public:
    /// `stiffness`: factors of the body's symmetric stiffness, which must outlive this. `dofs`: degrees of freedom of the body,
    /// by the port's place on the face.
    SurfaceCompliance(const Mumps &stiffness, std::vector<unsigned int> dofs);

    /// The tiles that hold the given ports of the face, as increasing ports.
    PortSelection whole_tiles(const PortSelection &ports) const;

    /// The compliance between some ports, which make up whole tiles.
    dealii::FullMatrix<double> among(const PortSelection &whole_tiles);

    /// Visits which tiles are known. Those found together are found together again: the solver's round-off depends on that.
    void visit_history(Archive &archive);

  private:
    using Tile = std::pair<unsigned int, unsigned int>; ///< of rows and columns, first >= second

    unsigned int n_ports_of(unsigned int tile) const;
    PortSelection ports_of(unsigned int tile) const;
    double &entry(unsigned int row, unsigned int column);
    void find(const std::vector<Tile> &wanted);

    const Mumps &factors;
    const std::vector<unsigned int> dof_of_port;
    std::map<unsigned int, unsigned int> port_of_dof;
    std::map<Tile, dealii::FullMatrix<double>> tiles;
    std::vector<std::vector<Tile>> searches; ///< the tiles found together
  };
} // namespace sprag
