// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/finite_statics.h"
#include "fe/leaf/leaf_body.h"
#include "mpi_environment.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

using namespace sprag;
using namespace dealii;

// A thin cantilever along -xi, loaded at its end by dead forces until the end has turned by a given angle.

namespace
{
  constexpr double pi = numbers::PI;

  /// Poisson's ratio 0: beam theory holds up to the clamp.
  LeafSpring thin_leaf()
  {
    LeafSpring leaf;
    leaf.thickness     = 1.;
    leaf.poisson_ratio = 0.;
    return leaf;
  }

  double bending_stiffness(const LeafSpring &leaf)
  {
    return leaf.young_modulus * leaf.width * std::pow(leaf.thickness, 3) / 12.;
  }

  class Cantilever
  {
  public:
    explicit Cantilever(const LeafSpring &leaf, const LeafElements &elements)
        : body(meshed(leaf, elements), make_properties(leaf))
        , statics(body, clamp())
        , displacement(body.n_dofs())
    {
    }

    /// Nodal forces of a traction [MPa] on the end face.
    template <typename Traction>
    Vector<double> end_loads(const Traction &traction) const
    {
      const auto &fe = body.dofs().get_fe();
      FEFaceValues<2> values(fe, QGauss<1>(3), update_values | update_quadrature_points | update_JxW_values);
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      Vector<double> result(body.n_dofs());
      for (const auto &cell : body.dofs().active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->boundary_id() == boundary_id::joint)
          {
            values.reinit(cell, f);
            cell->get_dof_indices(indices);
            for (const unsigned int q : values.quadrature_point_indices())
              for (unsigned int i = 0; i < indices.size(); ++i)
                result[indices[i]] += traction(values.quadrature_point(q))[fe.system_to_component_index(i).first] *
                                      values.shape_value(i, q) * values.JxW(q) * body.body_properties().width;
          }
      return result;
    }

    /// In steps of equal load, each from the last one's tangent.
    void load(const Vector<double> &loads, const unsigned int steps)
    {
      Vector<double> step = loads, applied(body.n_dofs());
      step /= steps;
      statics.balance(displacement, applied);
      for (unsigned int i = 0; i < steps; ++i)
      {
        applied += step;
        displacement += statics.response(Vector<double>(body.n_dofs()), step);
        statics.balance(displacement, applied);
      }
    }

    bool is_stable() const
    {
      return statics.is_stable();
    }

    /// Returns the deformed position of the middle of the end.
    Point<2> tip(const LeafSpring &leaf) const
    {
      const Point<2> at(-leaf.length, 0.);
      std::vector<Point<2>> positions(body.n_dofs());
      DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), positions);
      Point<2> result = at;
      for (unsigned int c = 0; c < 2; ++c)
      {
        ComponentMask mask(2, false);
        mask.set(c, true);
        for (const auto dof : DoFTools::extract_boundary_dofs(body.dofs(), mask, { boundary_id::joint }))
          if (positions[dof].distance(at) < 1e-9)
            result[c] += displacement[dof];
      }
      return result;
    }

  private:
    const Triangulation<2> &meshed(const LeafSpring &leaf, const LeafElements &elements)
    {
      make_leaf_mesh(leaf, elements, triangulation);
      return triangulation;
    }

    static BodyProperties make_properties(const LeafSpring &leaf)
    {
      BodyProperties properties;
      properties.material  = MaterialModel::st_venant_kirchhoff;
      properties.width     = leaf.width;
      properties.constants = { { material_id::leaf, { leaf.young_modulus, leaf.poisson_ratio } } };
      return properties;
    }

    AffineConstraints<double> clamp() const
    {
      AffineConstraints<double> result;
      for (const auto dof : DoFTools::extract_boundary_dofs(body.dofs(), {}, { boundary_id::clamp }))
        result.add_line(dof);
      result.close();
      return result;
    }

    Triangulation<2> triangulation;
    const ElasticBody<2> body;
    FiniteStatics statics;
    Vector<double> displacement;
  };
} // namespace

// A moment M bends it to an arc of the angle M L / EI. Its fibres carry dead forces that are normal to the section as it comes to
// stand. At strains of up to t kappa / 2 the solid's energy differs from the beam's by some (t kappa / 2)^2 of it, and the mesh
// of 120 x 2 elements is stiffer by less than 1e-4 of the angle, see LeafSpring.StiffnessConvergesToBeamTheory.
TEST(Elastica, EndMomentBendsAnArc)
{
  const auto leaf = thin_leaf();
  for (const double angle : { pi / 3., 0.45 * pi })
  {
    Cantilever cantilever(leaf, { 120, 2 });
    const double moment = bending_stiffness(leaf) * angle / leaf.length;
    const double factor = moment / (leaf.width * std::pow(leaf.thickness, 3) / 12.);
    // Outward normal of the end once it has turned: (-1, 0) by a positive angle.
    const Tensor<1, 2> normal = Point<2>(-std::cos(angle), -std::sin(angle));
    cantilever.load(cantilever.end_loads([&](const Point<2> &p) { return factor * p[1] * normal; }), 30);

    const double radius = leaf.length / angle;
    const Point<2> exact(-radius * std::sin(angle), -radius * (1. - std::cos(angle)));
    const double strain = 0.5 * leaf.thickness / radius;
    const double error  = cantilever.tip(leaf).distance(exact) / leaf.length;
    RecordProperty("error", std::to_string(error));
    std::printf("angle %.4f: tip off by %.2e of the length\n", angle, error);
    EXPECT_LE(error, (strain * strain + 1e-4) * angle);
  }
}

// A dead force P across, by elliptic integrals (Bisshopp & Drucker, Q. Appl. Math. 3, 1945): with the end turned by phi,
// p = sqrt((1 + sin phi)/2), sin psi = 1/(p sqrt 2): P L^2/EI = (K(p) - F(psi, p))^2. Shear and stretch add
// P/(kappa G A) + P/(E A), 2.4 + 1 times P L^2/EI t^2/(12 L^2), to slopes of order 1.
TEST(Elastica, EndForceMeetsEllipticIntegrals)
{
  const auto leaf = thin_leaf();
  for (const double phi : { pi / 3., 75. * pi / 180. })
  {
    const double p    = std::sqrt(0.5 * (1. + std::sin(phi)));
    const double psi  = std::asin(1. / (p * std::sqrt(2.)));
    const double root = boost::math::ellint_1(p) - boost::math::ellint_1(p, psi);
    const double load = root * root; // P L^2 / EI
    const Point<2> exact(-leaf.length * std::sqrt(2. * std::sin(phi)) / root,
                         leaf.length * (1. - 2. / root * (boost::math::ellint_2(p) - boost::math::ellint_2(p, psi))));

    Cantilever cantilever(leaf, { 120, 2 });
    const double force    = load * bending_stiffness(leaf) / (leaf.length * leaf.length);
    const double traction = force / (leaf.width * leaf.thickness);
    cantilever.load(cantilever.end_loads([&](const Point<2> &) { return Tensor<1, 2>(Point<2>(0., traction)); }), 30);

    const double slenderness = leaf.thickness / leaf.length;
    const double error       = cantilever.tip(leaf).distance(exact) / leaf.length;
    RecordProperty("error", std::to_string(error));
    std::printf("end turned by %.4f, P L^2/EI = %.4f: tip off by %.2e of the length\n", phi, load, error);
    EXPECT_LE(error, 3.4 * load * slenderness * slenderness / 12. + 1e-4);
  }
}

// Pressed along its axis a cantilever stays straight, and stable up to Euler's load pi^2 EI/(4 L^2). The mesh, shear and
// shortening move that by some 1e-4.
TEST(Elastica, ColumnIsStableUpToEulersLoad)
{
  const auto leaf    = thin_leaf();
  const double euler = pi * pi * bending_stiffness(leaf) / (4. * leaf.length * leaf.length);
  for (const double share : { 0.999, 1.001 })
  {
    Cantilever cantilever(leaf, { 60, 2 });
    const double traction = share * euler / (leaf.width * leaf.thickness);
    cantilever.load(cantilever.end_loads([&](const Point<2> &) { return Tensor<1, 2>(Point<2>(traction, 0.)); }), 1);
    EXPECT_EQ(cantilever.is_stable(), share < 1.);
    EXPECT_NEAR(cantilever.tip(leaf)[1], 0., 1e-6);
  }
}
