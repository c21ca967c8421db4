// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_elements.h"

#include "base/errors.h"
#include "base/ranges.h"

#include <deal.II/numerics/rtree.h>

namespace sprag
{
  /// The elements by the boxes around their nodes.
  template <int dim>
  struct FaceElements<dim>::Tree
  {
    using Box = dealii::BoundingBox<dim>;

    explicit Tree(const FrictionFace<dim> &face)
        : boxes(bounding_boxes(face))
        , tree(dealii::pack_rtree_of_indices(boxes))
    {
    }

    static std::vector<Box> bounding_boxes(const FrictionFace<dim> &face)
    {
      using Node = typename std::decay_t<decltype(face.edges.front().nodes)>::value_type;
      return mapped(face.edges, [](const auto &edge) { return Box(mapped(edge.nodes, &Node::position)); });
    }

    template <class Predicate>
    Indices found(const Predicate &predicate) const
    {
      Indices result;
      for (auto box = tree.qbegin(predicate); box != tree.qend(); ++box)
        result.push_back(static_cast<unsigned int>(*box));
      std::sort(result.begin(), result.end());
      return result;
    }

    const std::vector<Box> boxes;
    const decltype(dealii::pack_rtree_of_indices(std::vector<Box>())) tree;
  };

  template <int dim>
  FaceElements<dim>::FaceElements(const FrictionFace<dim> &face)
      : elements(face.elements)
      , points(face.points)
      , tree(std::make_unique<Tree>(face))
  {
    for (unsigned int element = 0; element < elements.size(); ++element)
      point_elements.resize(elements[element].end, element);
    find_neighbours();
    find_lines();
  }

  template <int dim>
  FaceElements<dim>::~FaceElements() = default;

  template <int dim>
  void FaceElements<dim>::find_neighbours()
  {
    constexpr double same = 1e-6; ///< place of two nodes, over the length of an element
    const auto &boxes     = tree->boxes;
    for (unsigned int element = 0; element < boxes.size(); ++element)
    {
      auto box = boxes[element];
      box.extend(same * elements[element].length);
      auto touching = tree->found(boost::geometry::index::intersects(box));
      touching.erase(std::find(touching.begin(), touching.end(), element));
      neighbours.push_back(std::move(touching));
    }

    std::vector<bool> reached(boxes.size());
    for (unsigned int first = 0; first < boxes.size(); ++first)
    {
      if (reached[first])
        continue;
      other_starts.push_back(first);
      reached[first] = true;
      Indices part{ first };
      for (std::size_t i = 0; i < part.size(); ++i)
        for (const unsigned int element : neighbours[part[i]])
          if (!reached[element])
          {
            reached[element] = true;
            part.push_back(element);
          }
    }
    if (other_starts.size() == 1)
      other_starts.clear();
  }

  template <int dim>
  void FaceElements<dim>::find_lines()
  {
    lines = lines_along(mapped(points, &Point::position));
    point_lines.resize(points.size());
    for (unsigned int line = 0; line < lines.size(); ++line)
      for (const unsigned int point : lines[line])
        point_lines[point] = line;
  }

  template <int dim>
  void FaceCandidates<dim>::set(const FaceElements<dim> &face, Indices may_touch, Indices near_elements,
                                const unsigned int surface, const unsigned int size)
  {
    elements = std::move(may_touch);
    if (!dofs.empty() && near_elements == near)
      return;
    near = std::move(near_elements);
    dofs = face.element_displacements(near);
    for (auto dof = surface; dof < size; ++dof)
      dofs.push_back(dof);
  }

  template <int dim>
  auto FaceCandidates<dim>::clip(Indices near, bool &within_candidates) const -> Indices
  {
    within_candidates = dofs.empty() || std::includes(elements.begin(), elements.end(), near.begin(), near.end());
    if (within_candidates)
      return near;
    Indices result;
    std::set_intersection(near.begin(), near.end(), elements.begin(), elements.end(), std::back_inserter(result));
    return result;
  }

  template <int dim>
  typename FaceElements<dim>::Nodal FaceElements<dim>::nodal(const Element &element, const dealii::Vector<double> &displacement)
  {
    Nodal result{};
    for (unsigned int a = 0; a < element.n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        result[dim * a + d] = displacement[dim * element.nodes[a] + d];
    return result;
  }

  template <int dim>
  dealii::Point<dim> FaceElements<dim>::position(const Point &point, const Nodal &displacement)
  {
    auto result = point.position;
    for (unsigned int a = 0; a < max_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += point.shapes[a] * displacement[dim * a + d];
    return result;
  }

  template <int dim>
  std::vector<unsigned int> FaceElements<dim>::elements_in(const dealii::BoundingBox<dim> &box) const
  {
    const auto found = tree->found(boost::geometry::index::intersects(box));
    return found.empty() ? tree->found(boost::geometry::index::nearest(box.center(), 1)) : found;
  }

  template <int dim>
  std::vector<unsigned int> FaceElements<dim>::element_displacements(const Indices &some) const
  {
    std::vector<unsigned int> result;
    for (const unsigned int element : some)
      for (unsigned int a = 0; a < elements[element].n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result.push_back(dim * elements[element].nodes[a] + d);
    sort_unique(result);
    return result;
  }

  template class FaceElements<2>;
  template class FaceElements<3>;
  template struct FaceCandidates<2>;
  template struct FaceCandidates<3>;
} // namespace sprag
