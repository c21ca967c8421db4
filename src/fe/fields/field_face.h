// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/friction_face.h"

#include <vector>

namespace sprag
{
  /// The points of a friction face that /face and pictures show: in a plane its integration points, in a line, in space the means
  /// over parts of its cells (FaceParts), with quadrilaterals between them.
  class FieldFace
  {
  public:
    explicit FieldFace(const FrictionFace<2> &face);
    explicit FieldFace(const FrictionFace<3> &face);

    /// Undeformed [mm].
    const std::vector<dealii::Point<3>> &points() const
    {
      return positions;
    }

    /// Returns numbers of points: two for each line, four for each quadrilateral.
    const std::vector<unsigned int> &cells() const
    {
      return corners;
    }

    unsigned int points_per_cell() const
    {
      return per_cell;
    }

    /// Returns the points of the line with the lowest zeta, along xi; none in a plane.
    const std::vector<unsigned int> &first_line() const
    {
      return lowest;
    }

    /// Displacement of a point in the axes of the body, by those of its degrees of freedom [mm].
    dealii::Tensor<1, 3> moved(unsigned int point, const dealii::Vector<double> &displacement) const;

  private:
    template <int dim>
    void read(const FrictionFace<dim> &face, const std::vector<unsigned int> &point_of, const std::vector<double> &share);
    void join_lines();

    unsigned int per_cell;
    std::vector<dealii::Point<3>> positions;
    std::vector<unsigned int> corners;
    std::vector<unsigned int> lowest;
    std::vector<std::array<unsigned int, 3>> dofs;                    ///< of the nodes; in a plane the last has none
    std::vector<std::vector<std::pair<unsigned int, double>>> movers; ///< of a point: nodes, and how much they move it
  };
} // namespace sprag
