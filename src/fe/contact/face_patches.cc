#include "fe/contact/face_patches.h"

#include "base/errors.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    /// Derivative along the face of the polynomial that is 1 at one node of an edge and 0 at the others.
    double slope_of_shape(const FaceEdge<2> &edge, const std::size_t node, const double xi)
    {
      const auto at = [&](const std::size_t i) { return edge.nodes[i].position[0]; };
      double sum    = 0.;
      for (std::size_t left_out = 0; left_out < edge.nodes.size(); ++left_out)
      {
        if (left_out == node)
          continue;
        double product = 1. / (at(node) - at(left_out));
        for (std::size_t i = 0; i < edge.nodes.size(); ++i)
          if (i != node && i != left_out)
            product *= (xi - at(i)) / (at(node) - at(i));
        sum += product;
      }
      return sum;
    }

    std::array<double, FacePatches::max_nodes> slopes_of_shapes(const FaceEdge<2> &edge, const FacePatches::Patch &patch,
                                                                const double xi)
    {
      std::array<double, FacePatches::max_nodes> result{};
      for (unsigned int a = 0; a < patch.n_nodes; ++a)
        for (std::size_t node = 0; node < edge.nodes.size(); ++node)
          if (edge.nodes[node].index == patch.nodes[a])
            result[a] = slope_of_shape(edge, node, xi);
      return result;
    }
  } // namespace

  FacePatches::FacePatches(const FrictionFace<2> &face)
  {
    for (const auto &patch : face.patches)
    {
      const auto &nodes = face.points[patch.begin].nodes;
      Patch copy{ patch.begin, patch.end, patch.length, static_cast<unsigned int>(nodes.size()), {} };
      if (copy.n_nodes > max_nodes)
        throw AnalysisError("contact is limited to elements of degree 2");
      for (unsigned int a = 0; a < copy.n_nodes; ++a)
        copy.nodes[a] = nodes[a].first;
      all_patches.push_back(copy);
    }
    for (const auto &point : face.points)
    {
      Point copy{ { point.position[0], point.position[1] }, point.weight, {}, {} };
      for (unsigned int a = 0; a < point.nodes.size(); ++a)
        copy.shapes[a] = point.nodes[a].second;
      all_points.push_back(copy);
    }
    for (unsigned int patch = 0; patch < all_patches.size(); ++patch)
      for (unsigned int q = all_patches[patch].begin; q < all_patches[patch].end; ++q)
        all_points[q].slopes = slopes_of_shapes(face.edges[patch], all_patches[patch], all_points[q].position.xi);
  }

  const std::vector<FacePatches::Patch> &FacePatches::patches() const
  {
    return all_patches;
  }

  const std::vector<FacePatches::Point> &FacePatches::points() const
  {
    return all_points;
  }

  FacePatches::Nodal FacePatches::nodal(const Patch &patch, const dealii::Vector<double> &displacement)
  {
    Nodal result{};
    for (unsigned int a = 0; a < patch.n_nodes; ++a)
      for (unsigned int d = 0; d < 2; ++d)
        result[2 * a + d] = displacement[2 * patch.nodes[a] + d];
    return result;
  }

  LeverPoint FacePatches::position(const Point &point, const Nodal &displacement)
  {
    LeverPoint result = point.position;
    for (unsigned int a = 0; a < max_nodes; ++a)
    {
      result.xi += point.shapes[a] * displacement[2 * a];
      result.eta += point.shapes[a] * displacement[2 * a + 1];
    }
    return result;
  }

  unsigned int FacePatches::patch_of_point(const unsigned int point) const
  {
    const auto ends_before = [](const Patch &patch, const unsigned int q) { return patch.end <= q; };
    const auto found       = std::lower_bound(all_patches.begin(), all_patches.end(), point, ends_before);
    return static_cast<unsigned int>(found - all_patches.begin());
  }

  unsigned int FacePatches::patch_at(const double xi) const
  {
    const auto ends_before = [this](const Patch &patch, const double value)
    { return all_points[patch.end - 1].position.xi < value; };
    const auto found = std::lower_bound(all_patches.begin(), all_patches.end() - 1, xi, ends_before);
    return static_cast<unsigned int>(found - all_patches.begin());
  }

  FacePatches::Range FacePatches::patches_between(const double from, const double to) const
  {
    return { patch_at(from), patch_at(to) + 1 };
  }

  std::vector<unsigned int> FacePatches::displacements_of(const Range &range) const
  {
    std::vector<unsigned int> result;
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      for (unsigned int a = 0; a < all_patches[patch].n_nodes; ++a)
        for (unsigned int d = 0; d < 2; ++d)
          result.push_back(2 * all_patches[patch].nodes[a] + d);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  FacePatches::Range FacePatches::patches_of_points(const unsigned int first, const unsigned int last) const
  {
    return { patch_of_point(first), patch_of_point(last) + 1 };
  }
} // namespace sprag
