#pragma once

#include "fe/solid/solid_body.h"
#include "model/port_forces.h"

#include <deal.II/lac/full_matrix.h>

#include <map>

namespace sprag
{
  /// Compliance G between the displacements of the friction face's nodes, three a node, the body held at its hub [mm/N].
  ///
  /// With a layer it is that of the layer on a rigid bond, which is known exactly and dies away within some thicknesses, and the
  /// answer of what is behind the bond to the forces that the layer hands on. They are smooth and what is behind is stiff: the
  /// answer is found for loads on the bond, hats of some spacing in all three directions (attachment modes; Galerkin, so that
  /// the part left out is never negative), and is symmetric, Z Z^T. Without a layer the near part is the whole body's and exact.
  ///
  /// The near part is found in columns of nodes with the same xi, those whose surroundings in the layer are alike together.
  class LayeredCompliance
  {
  public:
    /// `begin` ... `end`: part of the face where forces act, along xi [mm]. The body must outlive this.
    LayeredCompliance(const SolidBody &body, double begin, double end, double thickness);

    /// The columns of nodes that hold the given ports, as increasing ports. A port is a number among the face's displacements,
    /// sorted by the columns: see dof_of_port().
    PortSelection whole_tiles(const PortSelection &ports) const;

    /// The compliance between some ports, which make up whole columns.
    dealii::FullMatrix<double> among(const PortSelection &whole_tiles);

    /// Displacements of some ports by forces on others, those of the layer itself left out where they are further away than it
    /// reaches [mm].
    double displacement(unsigned int port, const PortLoads &forces);

    unsigned int basis_size() const
    {
      return static_cast<unsigned int>(basis.n());
    }

  private:
    /// Nodes of the face with the same xi.
    struct Tile
    {
      double xi;
      unsigned int begin; ///< its first port
      unsigned int end;   ///< beyond the last
      unsigned int like;  ///< the first tile with the same surroundings
    };

    /// Displacements near a tile by unit forces on it: a matrix for each tile from `first` on, a column a force.
    struct NearColumns
    {
      int first; ///< over the number of the tile itself
      std::vector<dealii::FullMatrix<double>> of_tiles;
    };

    void find_tiles(double surroundings);
    void find_basis(double begin, double end, double spacing);
    const NearColumns &near_columns(unsigned int tile);
    NearColumns find_near_columns(unsigned int tile) const;
    unsigned int tile_of(unsigned int port) const;

    const SolidBody &body;
    std::vector<unsigned int> dofs; ///< of the ports
    std::vector<Tile> tiles;
    std::map<unsigned int, NearColumns> known; ///< by the tile that stands for those alike
    dealii::FullMatrix<double> basis;          ///< Z, a row a port
  };
} // namespace sprag
