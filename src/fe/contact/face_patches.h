#pragma once

#include "fe/body/friction_face.h"
#include "model/circle.h"

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace sprag
{
  /// Where the lever and the cylinder are: displacements of the face nodes (two entries a node, others may follow), rotation of
  /// the hub and position of the cylinder from the pivot frame's origin.
  struct FaceConfiguration
  {
    const dealii::Vector<double> *displacement;
    double theta;
    double x;
    LeverPoint centre; ///< of the cylinder
  };

  /// A friction face laid out for the search and summation of every iteration of every step: patch by patch, without
  /// indirection within a patch.
  class FacePatches
  {
  public:
    static constexpr unsigned int max_nodes = 3;

    struct Patch
    {
      unsigned int begin; ///< points, as in FrictionFace
      unsigned int end;
      double length;
      unsigned int n_nodes;
      std::array<unsigned int, max_nodes> nodes;
    };

    struct Point
    {
      LeverPoint position; ///< undeformed
      double weight;
      std::array<double, max_nodes> shapes; ///< of the patch's nodes
      std::array<double, max_nodes> slopes; ///< their derivatives along the face [1/mm]
    };

    explicit FacePatches(const FrictionFace<2> &face);

    const std::vector<Patch> &patches() const;
    const std::vector<Point> &points() const;

    /// The patch's part of the displacements.
    using Nodal = std::array<double, 2 * max_nodes>;
    static Nodal nodal(const Patch &patch, const dealii::Vector<double> &displacement);
    static LeverPoint position(const Point &point, const Nodal &displacement);

    struct Range
    {
      unsigned int begin;
      unsigned int end; ///< beyond the last
    };

    static Range united(const Range &a, const Range &b)
    {
      return { std::min(a.begin, b.begin), std::max(a.end, b.end) };
    }

    /// Of n patches those whose distance is below a margin, at least the closest one. From `start` downhill, then to both sides:
    /// beyond the first patch that is out of reach the distance from a convex body only grows.
    template <class Distance, class Margin>
    static Range find_near(unsigned int start, unsigned int n, const Distance &distance, const Margin &margin);

    /// Patches of the undeformed face between two lever coordinates, at least one.
    Range patches_between(double from, double to) const;

    /// Indices of the displacements of the nodes of some patches, increasing.
    std::vector<unsigned int> displacements_of(const Range &range) const;

    Range patches_of_points(unsigned int first, unsigned int last) const;

    unsigned int patch_of_point(unsigned int point) const;

    /// The patch of the undeformed face at a lever coordinate, or the closest one.
    unsigned int patch_at(double xi) const;

  private:
    std::vector<Patch> all_patches;
    std::vector<Point> all_points;
  };

  template <class Distance, class Margin>
  FacePatches::Range FacePatches::find_near(const unsigned int start, const unsigned int n, const Distance &distance,
                                            const Margin &margin)
  {
    unsigned int closest  = start;
    double smallest       = distance(start);
    const auto try_better = [&](const unsigned int patch)
    {
      const double there = distance(patch);
      if (there >= smallest)
        return false;
      closest  = patch;
      smallest = there;
      return true;
    };
    while (closest + 1 < n && try_better(closest + 1))
      continue;
    while (closest > 0 && try_better(closest - 1))
      continue;

    const auto is_near = [&](const unsigned int patch) { return distance(patch) < margin(patch); };
    Range range{ closest, closest + 1 };
    while (range.begin > 0 && is_near(range.begin - 1))
      --range.begin;
    while (range.end < n && is_near(range.end))
      ++range.end;
    return range;
  }
} // namespace sprag
