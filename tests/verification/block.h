// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <vector>

namespace sprag
{
  /// A block of rectangles, cell boundaries at `xi` and `eta` (increasing): of the lever's material, its lowest side the friction
  /// face, its highest one held, its others free.
  inline void make_block(const std::vector<double> &xi, const std::vector<double> &eta, dealii::Triangulation<2> &triangulation)
  {
    std::vector<std::vector<double>> sizes(2);
    for (std::size_t i = 1; i < xi.size(); ++i)
      sizes[0].push_back(xi[i] - xi[i - 1]);
    for (std::size_t i = 1; i < eta.size(); ++i)
      sizes[1].push_back(eta[i] - eta[i - 1]);
    const dealii::Point<2> begin(xi.front(), eta.front());
    const dealii::Point<2> end(xi.back(), eta.back());
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, sizes, begin, end);
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      cell->set_material_id(material_id::lever);
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
        {
          const double centre = face->center()[1];
          const double small  = 1e-9 * (eta.back() - eta.front());
          face->set_boundary_id(centre < eta.front() + small  ? boundary_id::friction_face
                                : centre > eta.back() - small ? boundary_id::hub
                                                              : 0);
        }
    }
  }

  /// n equal parts of [begin, end].
  inline std::vector<double> equal_parts(const double begin, const double end, const unsigned int n)
  {
    std::vector<double> result;
    for (unsigned int i = 0; i <= n; ++i)
      result.push_back(begin + (end - begin) * i / n);
    return result;
  }

  /// From 0 parts of `size` up to `fine`, growing beyond it by `growth` until `end` is reached, the last one the end.
  inline std::vector<double> graded_parts(const double size, const double fine, const double growth, const double end)
  {
    std::vector<double> result = equal_parts(0., fine, static_cast<unsigned int>(fine / size + 0.5));
    for (double part = growth * size; result.back() + 1.5 * part < end; part *= growth)
      result.push_back(result.back() + part);
    result.push_back(end);
    return result;
  }

  /// The parts and their mirror images.
  inline std::vector<double> mirrored(const std::vector<double> &parts)
  {
    std::vector<double> result;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
      result.push_back(-*part);
    result.insert(result.end(), parts.begin() + 1, parts.end());
    return result;
  }
} // namespace sprag
