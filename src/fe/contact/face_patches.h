// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/body/friction_face.h"
#include "model/circle.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace sprag
{
  /// The places of the lever and the cylinder: displacements of the face nodes (two entries a node, others may follow), rotation
  /// of the hub and position of the cylinder from the pivot frame's origin.
  struct FaceConfiguration
  {
    const dealii::Vector<double> *displacement;
    double theta;
    double x;
    LeverPoint centre; ///< of the cylinder
  };

  /// A friction face laid out for the search and summation of every iteration of every step: patch by patch, without
  /// indirection within a patch. Patches are found by their boxes, and from one patch to those beside it.
  template <int dim>
  class FacePatches
  {
  public:
    static constexpr unsigned int max_nodes = dim == 2 ? 3 : 9;

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
      dealii::Point<dim> position; ///< undeformed
      double weight;
      std::array<double, max_nodes> shapes; ///< of the patch's nodes
    };

    /// Indices of patches, increasing.
    using Indices = std::vector<unsigned int>;

    explicit FacePatches(const FrictionFace<dim> &face);
    ~FacePatches();

    const std::vector<Patch> patches;
    const std::vector<Point> points;
    std::vector<Indices> lines;            ///< points that have the same zeta, by increasing xi; in a plane all of them
    std::vector<unsigned int> point_lines; ///< index in `lines`

    /// The patch's part of the displacements of the face, dim entries a node.
    using Nodal = std::array<double, dim * max_nodes>;
    static Nodal nodal(const Patch &patch, const dealii::Vector<double> &displacement);
    static dealii::Point<dim> position(const Point &point, const Nodal &displacement);

    /// Returns the patches of the undeformed face that reach into a box, at least the one closest to its centre.
    Indices patches_in(const dealii::BoundingBox<dim> &box) const;

    /// Returns the patches whose distance from a convex body is negative, at least the closest one. On each part of the face they
    /// are sought downhill, first from below the body's `centre`, then to all sides, as beyond the first patch out of reach the
    /// distance only grows.
    template <class Distance>
    Indices find_near(const dealii::Point<dim> &centre, const Distance &distance) const;

    /// Returns the indices of the displacements of the nodes of some patches, increasing.
    std::vector<unsigned int> patch_displacements(const Indices &some) const;

    /// Returns the index of the patch that holds a point, by its index.
    unsigned int point_patch(unsigned int point) const;

    /// Visits where the next search begins.
    void visit_history(Archive &archive)
    {
      archive(known_centre, known_patch);
    }

  private:
    struct Tree;
    unsigned int patch_below(const dealii::Point<dim> &centre) const;
    void find_neighbours();
    void find_lines();

    std::unique_ptr<const Tree> tree;
    std::vector<Indices> neighbours; ///< of the patches: those that touch them
    Indices other_starts;            ///< of a face of several parts that do not touch: a patch of each
    mutable dealii::Point<dim> known_centre;
    mutable unsigned int known_patch = dealii::numbers::invalid_unsigned_int; ///< below it
  };

  inline std::vector<unsigned int> united(const std::vector<unsigned int> &a, const std::vector<unsigned int> &b)
  {
    std::vector<unsigned int> result;
    result.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
  }

  /// The part of a face where a contact may be.
  template <int dim>
  struct FaceReach
  {
    using Indices = typename FacePatches<dim>::Indices;

    double factor = 1.;              ///< of the distances that are looked at
    Indices reached;                 ///< patches that the contact may touch
    Indices looked_at;               ///< patches of the ports
    std::vector<unsigned int> ports; ///< increasing; none before the first set()

    /// Sets patches and ports: the displacements of those looked at, and what follows the displacements of the face, from
    /// `surface` to `size`.
    void set(const FacePatches<dim> &face, Indices may_touch, Indices shown, unsigned int surface, unsigned int size);

    /// Leaves out the patches beyond reach and tells whether there are none. Before the first set() all can be reached.
    Indices clip(Indices near, bool &within_reach) const;
  };

  template <int dim>
  template <class Distance>
  std::vector<unsigned int> FacePatches<dim>::find_near(const dealii::Point<dim> &centre, const Distance &distance) const
  {
    Indices found;
    std::vector<bool> seen(patches.size());
    unsigned int closest = 0;
    double least         = std::numeric_limits<double>::infinity();
    const auto search    = [&](unsigned int patch)
    {
      double smallest = distance(patch);
      for (bool falls = true; falls;)
      {
        falls = false;
        for (const unsigned int next : neighbours[patch])
          if (const double there = distance(next); there < smallest)
          {
            patch    = next;
            smallest = there;
            falls    = true;
            break;
          }
      }
      if (smallest < least)
        closest = patch;
      least = std::min(smallest, least);
      if (smallest >= 0. || seen[patch])
        return;
      seen[patch] = true;
      found.push_back(patch);
      for (std::size_t i = found.size() - 1; i < found.size(); ++i)
        for (const unsigned int next : neighbours[found[i]])
          if (!seen[next])
          {
            seen[next] = true;
            if (distance(next) < 0.)
              found.push_back(next);
          }
    };
    search(patch_below(centre));
    for (const unsigned int patch : other_starts)
      search(patch);
    if (found.empty())
      found.push_back(closest);
    std::sort(found.begin(), found.end());
    return found;
  }
} // namespace sprag
