// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/body/friction_face.h"
#include "model/contact/circle.h"

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

  /// The elements of a friction face, to be searched in every iteration of every step. An element holds the points of the face of
  /// one cell. Elements are found by their boxes, and from one to those beside it.
  template <int dim>
  class FaceElements
  {
  public:
    static constexpr unsigned int max_nodes = most_face_nodes<dim>;
    using Element                           = FaceElement<dim>;
    using Point                             = FacePoint<dim>;

    /// Indices of elements, increasing.
    using Indices = std::vector<unsigned int>;

    explicit FaceElements(const FrictionFace<dim> &face);
    ~FaceElements();

    const std::vector<Element> elements;
    const std::vector<Point> points;
    std::vector<Indices> lines;            ///< points that have the same zeta, by increasing xi; in a plane all of them
    std::vector<unsigned int> point_lines; ///< index in `lines`
    Indices point_elements;                ///< index in `elements`

    /// The element's part of the displacements of the face, dim entries a node.
    using Nodal = std::array<double, dim * max_nodes>;
    static Nodal nodal(const Element &element, const dealii::Vector<double> &displacement);
    static dealii::Point<dim> position(const Point &point, const Nodal &displacement);

    /// Returns the elements of the undeformed face that reach into a box, at least the one closest to its centre.
    Indices elements_in(const dealii::BoundingBox<dim> &box) const;

    /// Returns the elements whose distance from a convex body is negative, at least the closest one. On each part of the face
    /// they are sought downhill, first from below the body's `centre`, then to all sides, as beyond the first element out of
    /// reach the distance only grows.
    template <class Distance>
    Indices find_near(const dealii::Point<dim> &centre, const Distance &distance) const;

    /// Returns the indices of the displacements of the nodes of some elements, increasing.
    std::vector<unsigned int> element_displacements(const Indices &some) const;

  private:
    struct Tree;
    void find_neighbours();
    void find_lines();

    std::unique_ptr<const Tree> tree;
    std::vector<Indices> neighbours; ///< of the elements: those that touch them
    Indices other_starts;            ///< of a face of several parts that do not touch: an element of each
  };

  /// Elements and dofs of a face that a contact may touch.
  template <int dim>
  struct FaceCandidates
  {
    using Indices = typename FaceElements<dim>::Indices;

    double factor = 1.;             ///< of the distances that are looked at
    Indices elements;               ///< elements that the contact may touch
    Indices near;                   ///< elements of the dofs
    std::vector<unsigned int> dofs; ///< increasing; none before the first set()

    /// Sets elements and dofs: those of the elements looked at, and those that follow the face's, from `surface` to `size`.
    void set(const FaceElements<dim> &face, Indices may_touch, Indices near_elements, unsigned int surface, unsigned int size);

    /// Removes elements that are no candidates and sets whether there were none. Before the first set() all are candidates.
    Indices clip(Indices near, bool &within_candidates) const;
  };

  template <int dim>
  template <class Distance>
  std::vector<unsigned int> FaceElements<dim>::find_near(const dealii::Point<dim> &centre, const Distance &distance) const
  {
    Indices found;
    std::vector<bool> seen(elements.size());
    unsigned int closest = 0;
    double least         = std::numeric_limits<double>::infinity();
    const auto search    = [&](unsigned int element)
    {
      double smallest = distance(element);
      for (bool falls = true; falls;)
      {
        falls = false;
        for (const unsigned int next : neighbours[element])
          if (const double there = distance(next); there < smallest)
          {
            element  = next;
            smallest = there;
            falls    = true;
            break;
          }
      }
      if (smallest < least)
        closest = element;
      least = std::min(smallest, least);
      if (smallest >= 0. || seen[element])
        return;
      seen[element] = true;
      found.push_back(element);
      for (std::size_t i = found.size() - 1; i < found.size(); ++i)
        for (const unsigned int next : neighbours[found[i]])
          if (!seen[next])
          {
            seen[next] = true;
            if (distance(next) < 0.)
              found.push_back(next);
          }
    };
    search(elements_in({ { centre, centre } }).front());
    for (const unsigned int element : other_starts)
      search(element);
    if (found.empty())
      found.push_back(closest);
    std::sort(found.begin(), found.end());
    return found;
  }
} // namespace sprag
