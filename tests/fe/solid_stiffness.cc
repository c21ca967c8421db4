// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/solid_stiffness.h"

#include "mpi_environment.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <gtest/gtest.h>
#include <optional>

using namespace sprag;
using namespace dealii;

namespace
{
  constexpr ElasticConstants elastic{ 20., 0.3 };

  /// The unit cube in n^3 cells that are no parallelepipeds, its faces flat.
  class SkewedCube
  {
  public:
    SkewedCube(const unsigned int n, const unsigned int degree)
    {
      GridGenerator::subdivided_hyper_cube(triangulation, n);
      const auto bump = [](const double a, const double b, const double c)
      { return 0.1 * std::sin(M_PI * a) * std::cos(M_PI * (b + 0.3)) * std::sin(2. * c + 0.5); };
      GridTools::transform(
          [&](const Point<3> &p)
          { return Point<3>(p[0] + bump(p[0], p[1], p[2]), p[1] + bump(p[1], p[2], p[0]), p[2] + bump(p[2], p[0], p[1])); },
          triangulation);
      for (const auto &cell : triangulation.active_cell_iterators())
        cell->set_material_id(material_id::lever);
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(boundary_id::hub);
      BodyProperties properties;
      properties.plane     = PlaneState::strain;
      properties.degree    = degree;
      properties.constants = { { material_id::lever, elastic } };
      body.emplace(triangulation, properties);
    }

    MatrixEntries stiffness() const
    {
      return assemble_stiffness(*body, {});
    }

    Triangulation<3> triangulation;
    std::optional<ElasticBody<3>> body;
  };

  /// Displacements that vanish on the cube's sides, and the body force that they need.
  class Manufactured : public Function<3>
  {
  public:
    Manufactured()
        : Function<3>(3)
    {
    }

    /// s_i = sin(pi x_i); u = (1, -2, 0.5) s_0 s_1 s_2.
    double value(const Point<3> &p, const unsigned int d) const override
    {
      return amplitude[d] * std::sin(M_PI * p[0]) * std::sin(M_PI * p[1]) * std::sin(M_PI * p[2]);
    }

    Tensor<1, 3> gradient(const Point<3> &p, const unsigned int d) const override
    {
      Tensor<1, 3> result;
      for (unsigned int e = 0; e < 3; ++e)
      {
        result[e] = amplitude[d] * M_PI;
        for (unsigned int f = 0; f < 3; ++f)
          result[e] *= f == e ? std::cos(M_PI * p[f]) : std::sin(M_PI * p[f]);
      }
      return result;
    }

    /// -(lambda + mu) grad div u - mu laplace u.
    Tensor<1, 3> force(const Point<3> &p) const
    {
      const auto lame = plane_constants(elastic, PlaneState::strain);
      Tensor<1, 3> result;
      for (unsigned int d = 0; d < 3; ++d)
      {
        result[d] = 3. * M_PI * M_PI * lame.mu * value(p, d);
        for (unsigned int e = 0; e < 3; ++e)
        {
          double second = amplitude[e] * M_PI * M_PI; // of u_e by d and e
          for (unsigned int f = 0; f < 3; ++f)
            second *= d != e && (f == d || f == e) ? std::cos(M_PI * p[f]) : std::sin(M_PI * p[f]);
          result[d] -= (lame.lambda + lame.mu) * (d == e ? -second : second);
        }
      }
      return result;
    }

  private:
    const double amplitude[3] = { 1., -2., 0.5 };
  };

  /// Errors of displacement and its gradient.
  std::array<double, 2> errors(const unsigned int n, const unsigned int degree)
  {
    const SkewedCube cube(n, degree);
    const Manufactured exact;
    FEValues<3> values(cube.body->cell_mapping(), cube.body->dofs().get_fe(), QGauss<3>(degree + 2),
                       update_values | update_quadrature_points | update_JxW_values);
    std::vector<double> solution(cube.body->dofs().n_dofs());
    std::vector<types::global_dof_index> indices(cube.body->dofs().get_fe().n_dofs_per_cell());
    for (const auto &cell : cube.body->dofs().active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(indices);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const auto force = exact.force(values.quadrature_point(q));
        for (unsigned int i = 0; i < indices.size(); ++i)
          if (!cube.body->is_held(static_cast<unsigned int>(indices[i])))
            solution[indices[i]] +=
                values.shape_value(i, q) * force[cube.body->dofs().get_fe().system_to_component_index(i).first] * values.JxW(q);
      }
    }
    Mumps factors(MatrixKind::solid_stiffness);
    factors.factorise(cube.stiffness());
    factors.solve(solution);
    const Vector<double> found(solution.begin(), solution.end());
    const auto error = [&](const VectorTools::NormType norm)
    {
      Vector<double> cell_errors(cube.triangulation.n_active_cells());
      VectorTools::integrate_difference(cube.body->cell_mapping(), cube.body->dofs(), found, exact, cell_errors,
                                        QGauss<3>(degree + 2), norm);
      return cell_errors.l2_norm();
    };
    return { { error(VectorTools::L2_norm), error(VectorTools::H1_seminorm) } };
  }
} // namespace

TEST(SolidStiffness, ErrorsFallAtTheOrderOfTheDegree)
{
  for (const unsigned int degree : { 1u, 2u })
  {
    const unsigned int n     = degree == 1 ? 8 : 4;
    const auto coarse        = errors(n, degree);
    const auto fine          = errors(2 * n, degree);
    const double value_order = std::log2(coarse[0] / fine[0]), gradient_order = std::log2(coarse[1] / fine[1]);
    EXPECT_NEAR(value_order, degree + 1., 0.15) << "degree " << degree;
    EXPECT_NEAR(gradient_order, degree, 0.1) << "degree " << degree;
  }
}
