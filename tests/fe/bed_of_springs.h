// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact.h"
#include "fe/contact/face_contact_point.h"
#include "model/contact/circle.h"
#include "scenes.h"
#include <cmath>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

namespace sprag
{
  constexpr double width = 50.;

  /// A flat friction face of quadratic elements under model A's cylinder at x = 64, without a body: a bed of springs.
  class Bed
  {
  public:
    explicit Bed(const Cylinder &cylinder, const double stiffness, const unsigned int elements_across = 20,
                 const FrictionLaw &friction = {})
        : fe(dealii::FE_Q<3>(2), 3)
    {
      const double e = model_a().geometry.interface_offset;
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, { 20, 1, elements_across },
                                                        dealii::Point<3>(111., e, -0.5 * width),
                                                        dealii::Point<3>(131., e + 1., 0.5 * width));
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->set_material_id(material_id::lever);
        for (const auto &side : cell->face_iterators())
          if (side->at_boundary() && std::abs(side->center()[1] - e) < 1e-9)
            side->set_boundary_id(boundary_id::friction_face);
      }
      dofs.reinit(triangulation);
      dofs.distribute_dofs(fe);
      BodyProperties properties;
      properties.constants    = { { material_id::lever, { 1., 0. } } };
      face                    = find_friction_face(dealii::MappingQ1<3>(), dofs, dealii::AffineConstraints<double>(), properties,
                                                   boundary_id::friction_face);
      layout                  = { 3 * static_cast<unsigned int>(face.nodes.size()), false };
      layout.has_inertia      = false;
      layout.slopes           = cylinder.has_free_axis() ? 2 : 0;
      const Geometry geometry = model_a().geometry;
      contact                 = std::make_unique<FaceContact<3>>(face, FaceProperties{ cylinder_centre(geometry),
                                                                       geometry.cylinder_radius,
                                                                       layout,
                                                                       0.,
                                                                       { stiffness, stiffness },
                                                                       friction,
                                                                       0.,
                                                                       RigidCylinder(geometry, cylinder) });
    }

    /// Returns displacements at rest and an inclination at which the cylinder penetrates by so much in the middle [mm].
    dealii::Vector<double> pressed(const double penetration) const
    {
      const auto geometry = model_a().geometry;
      dealii::Vector<double> result(layout.size());
      result[layout.rotation()] =
          std::asin((geometry.cylinder_radius - penetration - geometry.interface_offset) / (geometry.pivot_distance - x));
      return result;
    }

    FaceEvaluation<3> evaluated(const dealii::Vector<double> &begin, const double from_x, const dealii::Vector<double> &end,
                                const double friction)
    {
      return evaluated(begin, from_x, end, x, {}, 0., { { CoulombFriction{ friction } }, 1. });
    }

    /// A step without inertia in which the cylinder's surface runs by a turn, with all points near the cylinder.
    FaceEvaluation<3> evaluated(const dealii::Vector<double> &begin, const double from_x, const dealii::Vector<double> &end,
                                const double to_x, const std::vector<ContactHistory> &history, const double run,
                                const StaticTerms &terms)
    {
      FaceEvaluation<3> found;
      contact->evaluate({ { 0., from_x }, history, { 0., to_x, 0., 0., run }, { begin, {}, {} }, end, {}, {} }, found, terms);
      contact->add_points(found);
      return found;
    }

    FaceContact<3> &surface()
    {
      return *contact;
    }

    const FrictionFace<3> &friction_face() const
    {
      return face;
    }

    const std::vector<FacePoint<3>> &points() const
    {
      return face.points;
    }

    /// The length that makes a movement of a unit of a dof, see StaticInterface [mm].
    double unit_length(const unsigned int dof) const
    {
      return layout.is_slope(dof) ? 0.5 * width : 1.;
    }

    /// Force and moment on the lever of an evaluation about the cylinder's middle, in the axes of the world.
    std::array<dealii::Tensor<1, 3>, 2> resultant(const FaceEvaluation<3> &found) const
    {
      const auto geometry = model_a().geometry;
      const double theta  = found.displacement[layout.rotation()];
      const double c = std::cos(theta), s = std::sin(theta);
      std::array<dealii::Tensor<1, 3>, 2> result;
      for (const auto &point : found.points)
      {
        const auto in_world = [&](const double xi, const double eta, const double zeta) {
          return dealii::Tensor<1, 3>({ -xi * c + eta * s, xi * s + eta * c, zeta });
        };
        const auto &at    = point.position;
        const auto arm    = in_world(at[0], at[1], at[2]) + dealii::Tensor<1, 3>({ geometry.pivot_distance - x, 0., 0. });
        const double area = face.points[point.index].weight;
        const auto force  = area * in_world(point.end_force[0], point.end_force[1], point.end_force[2]);
        result[0] += force;
        result[1] += cross_product_3d(arm, force);
      }
      return result;
    }

    /// Force along eta and its moment about the middle of the width.
    std::array<double, 2> pressed_by(const double penetration)
    {
      const auto at    = pressed(penetration);
      const auto found = evaluated(at, x, at, 0.);
      std::array<double, 2> result{};
      for (const auto &point : found.points)
      {
        const double force = face.points[point.index].weight * point.pressure;
        result[0] += force;
        result[1] += force * point.position[2];
      }
      return result;
    }

    static constexpr double x = 64.;
    InterfaceLayout layout;

  private:
    dealii::Triangulation<3> triangulation;
    const dealii::FESystem<3> fe;
    dealii::DoFHandler<3> dofs;
    FrictionFace<3> face;
    std::unique_ptr<FaceContact<3>> contact;
  };

  inline Cylinder tilted(const double tilt)
  {
    Cylinder result;
    result.tilt = tilt;
    return result;
  }

  /// Out of true both ways, or also free to yield.
  inline Cylinder skewed(const bool is_free)
  {
    Cylinder result = tilted(6e-4);
    result.skew     = 2e-3;
    if (is_free)
      result.tilt_stiffness = result.skew_stiffness = 1e6;
    return result;
  }

  /// Skewed, with all that a profile may have [mm].
  inline Cylinder barrel(const bool is_free, const double length, const double edge_radius, const double crown_radius)
  {
    Cylinder result     = skewed(is_free);
    result.length       = length;
    result.edge_radius  = edge_radius;
    result.crown_radius = crown_radius;
    return result;
  }
} // namespace sprag
