// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "scene/scene.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <memory>

namespace sprag
{
  // A bar on a hub without width at xi = 0, and in front of it a friction plate with its layer on force sensors and a guide. The
  // cells of the two do not match, nor do the pads end where cells do.

  struct PlateOnBar
  {
    double length    = 40.; ///< of the bar
    double depth     = 3.;
    double offset    = 3.; ///< pivot to friction face
    double layer     = 0.5;
    double thickness = 1.;
    double spacer    = 1.5;
    double begin     = 10.; ///< of the plate
    double end       = 36.;
    double width     = 4.;
    double stiffer   = 1.; ///< factor of Young's moduli of the metal
    std::vector<double> sensors{ 14.3, 31.7 };
    double sensor_length    = 2.9;
    double sensor_stiffness = 2e4;
    double guide            = 22.1;
    double guide_stiffness  = 5e4;

    double back() const ///< of the plate
    {
      return offset + layer + thickness;
    }
    double front() const ///< of the bar
    {
      return back() + spacer;
    }
  };

  inline void make_plate_on_bar(const PlateOnBar &scene, dealii::Triangulation<2> &triangulation)
  {
    using Sizes               = std::vector<std::vector<double>>;
    const auto parts          = [](const unsigned int n, const double length) { return std::vector<double>(n, length / n); };
    const double plate_length = scene.end - scene.begin;
    dealii::Triangulation<2> bar, plate;
    dealii::GridGenerator::subdivided_hyper_rectangle(bar, Sizes{ parts(13, scene.length), parts(2, scene.depth) },
                                                      dealii::Point<2>(0., scene.front()),
                                                      dealii::Point<2>(scene.length, scene.front() + scene.depth));
    dealii::GridGenerator::subdivided_hyper_rectangle(
        plate, Sizes{ parts(11, plate_length), { scene.layer, 0.5 * scene.thickness, 0.5 * scene.thickness } },
        dealii::Point<2>(scene.begin, scene.offset), dealii::Point<2>(scene.end, scene.back()));
    dealii::GridGenerator::merge_triangulations(bar, plate, triangulation);
    const double small = 1e-9 * scene.length;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      const double eta = cell->center()[1];
      cell->set_material_id(eta > scene.front()                ? material_id::lever
                            : eta > scene.offset + scene.layer ? material_id::plate
                                                               : material_id::layer);
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
        {
          const auto at = [&](const double height) { return std::abs(face->center()[1] - height) < small; };
          face->set_boundary_id(at(scene.offset)            ? boundary_id::friction_face
                                : at(scene.back())          ? boundary_id::sensor_plate
                                : at(scene.front())         ? boundary_id::sensor_lever
                                : face->center()[0] < small ? boundary_id::hub
                                                            : 0);
        }
    }
  }

  inline BodyProperties plate_properties(const PlateOnBar &scene)
  {
    const double metal = scene.stiffer * 70000.;
    BodyProperties properties;
    properties.width         = scene.width;
    properties.point_spacing = 0.05;
    properties.constants     = { { material_id::lever, { metal, 0.3 } },
                                 { material_id::plate, { metal, 0.3 } },
                                 { material_id::layer, { scene.stiffer * 20., 0. } } };
    for (const double middle : scene.sensors)
      properties.connectors.push_back({ ConnectorType::sensor, middle, scene.sensor_length, scene.sensor_stiffness });
    properties.connectors.push_back({ ConnectorType::guide, scene.guide, scene.sensor_length, scene.guide_stiffness });
    return properties;
  }

  /// With its mesh and degrees of freedom.
  class MeshedPlate
  {
  public:
    explicit MeshedPlate(const PlateOnBar &scene)
        : triangulation(std::make_unique<dealii::Triangulation<2>>())
    {
      make_plate_on_bar(scene, *triangulation);
      body = std::make_unique<ElasticBody<2>>(*triangulation, plate_properties(scene));
    }

    const ElasticBody<2> &operator*() const
    {
      return *body;
    }
    const ElasticBody<2> *operator->() const
    {
      return body.get();
    }

  private:
    std::unique_ptr<dealii::Triangulation<2>> triangulation;
    std::unique_ptr<ElasticBody<2>> body;
  };
} // namespace sprag
