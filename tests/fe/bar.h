// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <vector>

namespace sprag
{
  // A bar in lever axes: from a hub without width at xi = 0, its lower side the friction face.

  struct Bar
  {
    double length  = 20.;
    double offset  = 3.; ///< pivot to friction face
    double layer   = 0.5;
    double depth   = 2.; ///< without layer
    unsigned int n = 8;  ///< elements along it
    unsigned int m = 2;  ///< elements across the depth
    double width   = 4.;
  };

  inline void make_bar(const Bar &bar, dealii::Triangulation<2> &triangulation)
  {
    std::vector<std::vector<double>> sizes(2);
    sizes[0].assign(bar.n, bar.length / bar.n);
    sizes[1].assign(bar.m, bar.depth / bar.m);
    if (bar.layer > 0.)
      sizes[1].insert(sizes[1].begin(), bar.layer);
    const dealii::Point<2> begin(0., bar.offset);
    const dealii::Point<2> end(bar.length, bar.offset + bar.layer + bar.depth);
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, sizes, begin, end);
    const double small = 1e-9 * bar.length;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      cell->set_material_id(cell->center()[1] < bar.offset + bar.layer ? material_id::layer : material_id::lever);
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->center()[1] < bar.offset + small ? boundary_id::friction_face
                                : face->center()[0] < small            ? boundary_id::hub
                                                                       : 0);
    }
  }

  inline BodyProperties bar_properties(const Bar &bar, const double poisson_ratio)
  {
    BodyProperties properties;
    properties.width         = bar.width;
    properties.point_spacing = 0.05;
    properties.constants     = { { material_id::lever, { 70000., poisson_ratio } }, { material_id::layer, { 20., 0. } } };
    return properties;
  }

  /// A bar with its mesh and degrees of freedom.
  class MeshedBar
  {
  public:
    explicit MeshedBar(const Bar &bar, const double poisson_ratio = 0.3)
        : triangulation(std::make_unique<dealii::Triangulation<2>>())
    {
      make_bar(bar, *triangulation);
      body = std::make_unique<ElasticBody<2>>(*triangulation, bar_properties(bar, poisson_ratio));
    }

    const ElasticBody<2> &operator*() const
    {
      return *body;
    }

  private:
    std::unique_ptr<dealii::Triangulation<2>> triangulation;
    std::unique_ptr<ElasticBody<2>> body;
  };

  inline LeverInertia bar_inertia(const double moment_of_inertia, const double tip_mass)
  {
    return { { { material_id::lever, 2.7e-9 }, { material_id::layer, 2e-10 } },
             tip_mass,
             moment_of_inertia,
             InertiaSource::scaled,
             0.,
             {} };
  }
} // namespace sprag
