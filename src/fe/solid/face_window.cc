// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/face_window.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    bool reaches_into(const FaceEdge<3> &edge, const double begin, const double end)
    {
      const auto is_before = [](const auto &a, const auto &b) { return a.position[0] < b.position[0]; };
      const auto ends      = std::minmax_element(edge.nodes.begin(), edge.nodes.end(), is_before);
      return ends.second->position[0] > begin && ends.first->position[0] < end;
    }
  } // namespace

  FaceWindow window_of(const FrictionFace<3> &face, const double begin, const double end)
  {
    std::vector<std::size_t> chosen;
    auto first = static_cast<unsigned int>(face.nodes.size()), last = 0u;
    for (std::size_t i = 0; i < face.edges.size(); ++i)
      if (reaches_into(face.edges[i], begin, end))
      {
        chosen.push_back(i);
        for (const auto &node : face.edges[i].nodes)
          if (node.index != FaceEdge<3>::held)
          {
            first = std::min(first, node.index);
            last  = std::max(last, node.index + 1);
          }
      }
    if (first >= last)
      throw AnalysisError("the friction face ends before the contact at xi = " + mm(0.5 * (begin + end)));

    FaceWindow result{ {}, first };
    auto &part         = result.face;
    part.young_modulus = face.young_modulus;
    part.depth         = face.depth;
    part.nodes.assign(face.nodes.begin() + first, face.nodes.begin() + last);
    for (const std::size_t i : chosen)
    {
      const auto &patch = face.patches[i];
      const auto from   = static_cast<unsigned int>(part.points.size());
      for (unsigned int q = patch.begin; q < patch.end; ++q)
      {
        auto &point = part.points.emplace_back(face.points[q]);
        for (auto &node : point.nodes)
          node.first -= first;
      }
      part.patches.push_back({ from, static_cast<unsigned int>(part.points.size()), patch.length });
      auto &edge = part.edges.emplace_back(face.edges[i]);
      for (auto &node : edge.nodes)
        if (node.index != FaceEdge<3>::held)
          node.index -= first;
    }
    return result;
  }
} // namespace sprag
