// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact.h"
#include "fe/statics/solid_body.h"
#include "fe/statics/static_interface.h"
#include "model/interface/newton.h"
#include "verification/block.h"

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

namespace sprag
{
  /// A block of bricks in three dimensions, its face eta = 0 the friction face, its opposite side held. Where xi or zeta begin
  /// at 0 the block is one half of one that is the same on both sides of that plane, which does not move across it; stiffness and
  /// areas stand for the whole.
  class SolidBlock
  {
  public:
    /// Boundaries of the cells along xi, eta and zeta, increasing.
    struct Planes
    {
      std::vector<double> xi, eta, zeta;
    };

    SolidBlock(const Planes &planes, const ElasticConstants &constants, const unsigned int degree = 2)
        : factors(MatrixKind::solid_stiffness)
    {
      make_cells(planes);
      BodyProperties properties;
      properties.plane         = PlaneState::strain;
      properties.degree        = degree;
      properties.constants     = { { material_id::lever, constants } };
      properties.point_spacing = 1e-6; // as dense as can be
      properties.width         = (planes.xi.front() == 0. ? 2. : 1.) * (planes.zeta.front() == 0. ? 2. : 1.);
      body.emplace(triangulation, properties,
                   [&](const dealii::DoFHandler<3> &dofs, dealii::AffineConstraints<double> &constraints)
                   {
                     for (const unsigned int direction : { 0u, 2u })
                       if ((direction == 0 ? planes.xi : planes.zeta).front() == 0.)
                         dealii::VectorTools::interpolate_boundary_values(
                             dofs, symmetry_id(direction), dealii::Functions::ZeroFunction<3>(3), constraints,
                             dofs.get_fe().component_mask(dealii::FEValuesExtractors::Scalar(direction)));
                   });
      face = find_friction_face(body->cell_mapping(), body->dofs(), dealii::AffineConstraints<double>(), body->body_properties(),
                                boundary_id::friction_face);
      factors.factorise(assemble_stiffness(*body, {}));
    }

    const FrictionFace<3> &friction_face() const
    {
      return face;
    }

    unsigned int n_dofs() const
    {
      return body->n_dofs();
    }

    unsigned int body_dof(const unsigned int interface_dof) const
    {
      return face.nodes[interface_dof / 3].dofs[interface_dof % 3];
    }

    /// Turns forces on the degrees of freedom [N] into displacements [mm].
    void respond(std::vector<double> &loads) const
    {
      factors.solve(loads);
    }

    /// Columns of the compliance: displacements of all degrees of freedom, one column after another, by unit forces on some of
    /// them [mm/N].
    std::vector<double> columns(const std::vector<unsigned int> &column_dofs) const
    {
      SparseColumns unit;
      for (const unsigned int dof : column_dofs)
      {
        if (!is_held(dof))
          unit.add(dof, 1.);
        unit.end_column();
      }
      return factors.solve(std::move(unit));
    }

    bool is_held(const unsigned int dof) const
    {
      return body->is_held(dof);
    }

  private:
    static constexpr dealii::types::boundary_id symmetry_id(const unsigned int direction)
    {
      return 100 + direction;
    }

    void make_cells(const Planes &planes)
    {
      std::vector<std::vector<double>> sizes;
      for (const auto &coordinates : { planes.xi, planes.eta, planes.zeta })
      {
        sizes.emplace_back();
        for (std::size_t i = 1; i < coordinates.size(); ++i)
          sizes.back().push_back(coordinates[i] - coordinates[i - 1]);
      }
      const dealii::Point<3> begin(planes.xi.front(), planes.eta.front(), planes.zeta.front());
      const dealii::Point<3> end(planes.xi.back(), planes.eta.back(), planes.zeta.back());
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, sizes, begin, end);
      const double small = 1e-9 * end[1];
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->set_material_id(material_id::lever);
        for (const auto &side : cell->face_iterators())
          if (side->at_boundary())
          {
            const auto centre = side->center();
            side->set_boundary_id(centre[1] < begin[1] + small   ? boundary_id::friction_face
                                  : centre[1] > end[1] - small   ? boundary_id::hub
                                  : centre[0] < begin[0] + small ? symmetry_id(0)
                                  : centre[2] < begin[2] + small ? symmetry_id(2)
                                                                 : 0);
          }
      }
    }

    dealii::Triangulation<3> triangulation;
    std::optional<ElasticBody<3>> body;
    FrictionFace<3> face;
    Mumps factors;
  };

  /// The part of a block's face where it can be touched: its dofs, three a node, and the compliance between them.
  struct NearFace
  {
    DofSelection dofs;
    dealii::FullMatrix<double> compliance; ///< [mm/N]
  };

  /// Up to some distance from the origin along both axes [mm].
  inline NearFace near_face(const SolidBlock &block, const double reach)
  {
    constexpr std::size_t together = 64;
    NearFace result;
    const auto &nodes = block.friction_face().nodes;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (std::abs(nodes[i].position[0]) <= reach && std::abs(nodes[i].position[2]) <= reach)
        result.dofs.insert(result.dofs.end(), { 3 * i, 3 * i + 1, 3 * i + 2 });
    std::vector<unsigned int> dofs;
    for (const unsigned int interface_dof : result.dofs)
      dofs.push_back(block.body_dof(interface_dof));
    result.compliance.reinit(dofs.size(), dofs.size());
    for (std::size_t first = 0; first < dofs.size(); first += together)
    {
      const std::size_t last = std::min(first + together, dofs.size());
      const auto columns     = block.columns({ dofs.begin() + first, dofs.begin() + last });
      for (std::size_t j = first; j < last; ++j)
        for (std::size_t i = 0; i < dofs.size(); ++i)
          if (!block.is_held(dofs[i]))
            result.compliance(i, j) = columns[(j - first) * block.n_dofs() + dofs[i]];
    }
    return result;
  }

  /// The sum of the compliances of two blocks, each the other's mirror image: that by which normal forces move points along the
  /// face is 0, what else there is counts twice.
  inline NearFace with_mirror_image(NearFace face)
  {
    for (unsigned int i = 0; i < face.dofs.size(); ++i)
      for (unsigned int j = 0; j < face.dofs.size(); ++j)
        face.compliance(i, j) *= (face.dofs[i] % 3 == 1) == (face.dofs[j] % 3 == 1) ? 2. : 0.;
    return face;
  }

  /// A block that is moved against a rigid barrel (a ball where both radii are the same) which touches it at the origin.
  class RubbedBlock
  {
  public:
    using Vector = dealii::Tensor<1, 3>;

    struct Counterface
    {
      double radius;       ///< across the axis, which lies along zeta [mm]
      double crown_radius; ///< along it [mm]
      double penalty;      ///< normal and tangential [N/mm^3]
      double length = 0.;  ///< 0: beyond the block [mm]
    };

    /// `near` must hold all that the counterface can touch of the undeformed face, and outlive this.
    RubbedBlock(const SolidBlock &block_, const NearFace &near_, const Counterface &counterface)
        : block(block_)
        , near(near_)
        , layout(make_layout(block))
        , window(layout, { 1e12, 0., 1. }, { std::make_shared<NearCompliance>(near, layout.surface) })
        , contact(block.friction_face(), make_properties(counterface, layout))
        , elastic(layout.size())
        , placed(layout.size())
    {
      looked_at.push_back(layout.rotation());
    }

    /// Moves the block's held side to a place from where the block touches without force [mm].
    void move(const Vector &place, const double friction)
    {
      const Kinematic begin{ placed, {}, {} };
      const DrivePoint drive{};
      const StaticTerms terms{ { CoulombFriction{ friction } }, 1. };
      const auto history  = found.history();
      const auto evaluate = [&](const dealii::Vector<double> &at)
      {
        placed = at;
        for (unsigned int interface_dof = 0; interface_dof < layout.surface; ++interface_dof)
          placed[interface_dof] += place[interface_dof % 3];
        contact.evaluate({ drive, history, drive, begin, placed, {}, {} }, found, terms);
        auto residual = window.residual(at, found.forces, looked_at);
        return Pressed{ residual.norm, found.sums.penetration, std::move(residual) };
      };
      const auto result = solve_by_newton(
          elastic, 1e-14, evaluate,
          [&](const Pressed &pressed) { return window.correction(pressed.interface_residual, found.forces, looked_at); },
          [&](const dealii::Vector<double> &change) { return change.linfty_norm(); });
      EXPECT_TRUE(result.converged) << place;
      contact.add_points(found);
      for (const unsigned int interface_dof : found.forces.dofs)
        EXPECT_TRUE(!layout.is_surface(interface_dof) || std::binary_search(near.dofs.begin(), near.dofs.end(), interface_dof))
            << interface_dof;
    }

    /// A point in contact: place on the undeformed face, area and what acts on the block there.
    struct Point
    {
      double xi, zeta, area, pressure;
      Vector force;                  ///< on the block per area [MPa]
      dealii::Tensor<1, 2> friction; ///< its part along the ball: along xi, along zeta
      bool slipping;

      double radius() const
      {
        return std::hypot(xi, zeta);
      }
    };

    std::vector<Point> points() const
    {
      std::vector<Point> result;
      for (const auto &point : found.points)
        if (point.pressure > 0.)
        {
          const auto &face_point = block.friction_face().points[point.index];
          result.push_back({ face_point.position[0], face_point.position[2], face_point.weight, point.pressure,
                             Vector({ point.end_force[0], point.end_force[1], point.end_force[2] }), point.traction,
                             point.slipping });
        }
      return result;
    }

    /// On the block [N].
    Vector force() const
    {
      Vector result;
      for (const auto &point : points())
        result += point.area * point.force;
      return result;
    }

    /// Displacement of the nodes of the block's face by the forces on it alone: their places and how far each has moved [mm].
    std::vector<std::pair<dealii::Point<3>, Vector>> displacements() const
    {
      std::vector<double> moved(block.n_dofs(), 0.);
      for (unsigned int i = 0; i < found.forces.dofs.size(); ++i)
        if (const unsigned int interface_dof = found.forces.dofs[i];
            layout.is_surface(interface_dof) && !block.is_held(block.body_dof(interface_dof)))
          moved[block.body_dof(interface_dof)] = found.forces.values[i];
      block.respond(moved);
      std::vector<std::pair<dealii::Point<3>, Vector>> result;
      for (const auto &node : block.friction_face().nodes)
        result.push_back({ node.position, Vector({ moved[node.dofs[0]], moved[node.dofs[1]], moved[node.dofs[2]] }) });
      return result;
    }

  private:
    /// The compliance of the dofs that are near, one a block.
    class NearCompliance : public FaceCompliance
    {
    public:
      NearCompliance(const NearFace &near_, const unsigned int n_dofs)
          : near(near_)
      {
        for (unsigned int dof = 0; dof < n_dofs; ++dof)
          ranges.push_back({ dof, dof + 1 });
      }

    protected:
      dealii::FullMatrix<double> block(const BlockPair &pair) override
      {
        return dealii::FullMatrix<double>(
            1, 1, &near.compliance(find_index(pair.first, near.dofs), find_index(pair.second, near.dofs)));
      }

    private:
      const NearFace &near;
    };

    static InterfaceLayout make_layout(const SolidBlock &block)
    {
      InterfaceLayout result{ 3 * static_cast<unsigned int>(block.friction_face().nodes.size()), false };
      result.has_inertia = false;
      return result;
    }

    static FaceProperties make_properties(const Counterface &counterface, const InterfaceLayout &layout)
    {
      Geometry geometry;
      geometry.cylinder_radius = counterface.radius;
      geometry.pivot_distance  = 0.;
      geometry.pivot_height    = counterface.radius;
      Cylinder barrel;
      barrel.crown_radius = counterface.crown_radius;
      barrel.length       = counterface.length;
      return {
        cylinder_centre(geometry),      counterface.radius, layout, 0., { counterface.penalty, counterface.penalty }, {}, 0.,
        RigidCylinder(geometry, barrel)
      };
    }

    struct Pressed
    {
      double residual;
      double penetration;
      Residual interface_residual;
    };

    const SolidBlock &block;
    const NearFace &near;
    DofSelection looked_at = near.dofs;
    const InterfaceLayout layout;
    StaticInterface window;
    FaceContact<3> contact;
    dealii::Vector<double> elastic; ///< displacement of the face by the forces
    dealii::Vector<double> placed;  ///< and with the block's
    FaceEvaluation<3> found;
  };
} // namespace sprag
