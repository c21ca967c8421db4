// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/friction_face.h"
#include "model/contact/circle.h"

#include <cmath>
#include <functional>
#include <vector>

namespace sprag
{
  /// A face with nodes on a curve at increasing parameters, `degree` to an edge and an edge's midpoint at its mean parameter,
  /// with the integration points that find_friction_face() would give it.
  inline FrictionFace<2> face_along(const std::function<dealii::Point<2>(double)> &curve, const std::vector<double> &vertices,
                                    const unsigned int degree, const unsigned int parts, const double width)
  {
    FrictionFace<2> face;
    const auto add_node = [&](const double parameter)
    {
      const auto n = static_cast<unsigned int>(face.nodes.size());
      face.nodes.push_back({ curve(parameter), { { 2 * n, 2 * n + 1 } } });
      return n;
    };
    unsigned int last = add_node(vertices[0]);
    for (std::size_t i = 1; i < vertices.size(); ++i)
    {
      FaceEdge<2> edge;
      std::vector<unsigned int> nodes{ last };
      if (degree == 2)
        nodes.push_back(add_node(0.5 * (vertices[i - 1] + vertices[i])));
      nodes.push_back(last = add_node(vertices[i]));
      for (const unsigned int node : nodes)
        edge.nodes.push_back({ face.nodes[node].position, node });
      const double length = (edge.nodes.back().position - edge.nodes.front().position).norm();
      const auto begin    = static_cast<unsigned int>(face.points.size());
      for (unsigned int k = 0; k < 2 * parts; ++k)
      {
        const double at = (k / 2 + 0.5 + (k % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.)) / parts;
        face.points.push_back(
            { curve(vertices[i - 1] + at * (vertices[i] - vertices[i - 1])), width * length / (2. * parts), {}, {} });
      }
      face.elements.push_back({ begin, begin + 2 * parts, length });
      face.edges.push_back(edge);
    }
    return face;
  }

  inline std::vector<double> divide(const double from, const double to, const unsigned int number)
  {
    std::vector<double> result;
    for (unsigned int i = 0; i <= number; ++i)
      result.push_back(from + (to - from) * i / number);
    return result;
  }
} // namespace sprag
