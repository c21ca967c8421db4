// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/field_face.h"

#include "fe/solid/face_parts.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  FieldFace::FieldFace(const FrictionFace<2> &face)
      : per_cell(2)
  {
    std::vector<unsigned int> itself(face.points.size());
    std::iota(itself.begin(), itself.end(), 0u);
    for (unsigned int q = 0; q < face.points.size(); ++q)
    {
      positions.emplace_back(face.points[q].position[0], face.points[q].position[1], 0.);
      if (q > 0)
        corners.insert(corners.end(), { q - 1, q });
    }
    read(face, itself, std::vector<double>(itself.size(), 1.));
  }

  FieldFace::FieldFace(const FrictionFace<3> &face)
      : per_cell(4)
  {
    const auto parts      = parts_of(face);
    const auto &of_points = parts.points;
    const double height   = face.points.empty() ? 0. : face.points.front().position[1];
    for (std::size_t i = 0; i < of_points.xi.size(); ++i)
      positions.emplace_back(of_points.xi[i], height, of_points.zeta[i]);
    std::vector<double> share;
    for (std::size_t q = 0; q < face.points.size(); ++q)
      share.push_back(face.points[q].weight / of_points.weight[parts.part_of_point[q]]);
    read(face, parts.part_of_point, share);
    join_lines();
  }

  template <int dim>
  void FieldFace::read(const FrictionFace<dim> &face, const std::vector<unsigned int> &point_of, const std::vector<double> &share)
  {
    for (const auto &node : face.nodes)
    {
      dofs.push_back({ { node.dofs[0], node.dofs[1], numbers::invalid_unsigned_int } });
      if constexpr (dim == 3)
        dofs.back()[2] = node.dofs[2];
    }
    std::vector<std::map<unsigned int, double>> sums(positions.size());
    for (std::size_t q = 0; q < face.points.size(); ++q)
      for (const auto &[node, shape] : face.points[q].nodes)
        sums[point_of[q]][node] += share[q] * shape;
    for (const auto &of_point : sums)
      movers.emplace_back(of_point.begin(), of_point.end());
  }

  /// Between lines of points with the same zeta, which all have the same xi.
  void FieldFace::join_lines()
  {
    std::map<long, std::vector<unsigned int>> by_zeta;
    for (unsigned int i = 0; i < positions.size(); ++i)
      by_zeta[std::lround(1e6 * positions[i][2])].push_back(i);
    const std::vector<unsigned int> *before = nullptr;
    for (auto &[zeta, line] : by_zeta)
    {
      std::sort(line.begin(), line.end(), [&](const auto a, const auto b) { return positions[a][0] < positions[b][0]; });
      for (std::size_t i = 1; before != nullptr && i < std::min(line.size(), before->size()); ++i)
        corners.insert(corners.end(), { (*before)[i - 1], (*before)[i], line[i], line[i - 1] });
      if (before == nullptr)
        lowest = line;
      before = &line;
    }
  }

  Tensor<1, 3> FieldFace::moved(const unsigned int point, const Vector<double> &displacement) const
  {
    Tensor<1, 3> result;
    for (const auto &[node, shape] : movers[point])
      for (unsigned int d = 0; d < (per_cell == 4 ? 3u : 2u); ++d)
        result[d] += shape * displacement[dofs[node][d]];
    return result;
  }
} // namespace sprag
