// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "mpi_environment.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;
using namespace dealii;

namespace
{
  constexpr double pi = numbers::PI;

  /// A displacement of the unit square or cube that vanishes on its boundary.
  template <int dim>
  class Displacement : public Function<dim>
  {
  public:
    /// `waves` with strains of up to 0.3, and in a plane the curl of `stream` sin^2 (pi x) sin^2 (pi y), which keeps volumes
    /// where strains are small.
    Displacement(const double waves_, const double stream_)
        : Function<dim>(dim)
        , waves(waves_)
        , stream(stream_)
    {
    }

    double value(const Point<dim> &p, const unsigned int component) const override
    {
      double wave = waves * sizes[component];
      for (unsigned int d = 0; d < dim; ++d)
        wave *= std::sin(number(component, d) * p[d]);
      const double x = p[component], y = p[component == 0 ? 1 : 0];
      return wave + sign(component) * stream * pi * std::pow(std::sin(pi * x), 2) * std::sin(2. * pi * y);
    }

    Tensor<1, dim> gradient(const Point<dim> &p, const unsigned int component) const override
    {
      Tensor<1, dim> result;
      for (unsigned int e = 0; e < dim; ++e)
      {
        result[e] = waves * sizes[component];
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double a = number(component, d);
          result[e] *= d == e ? a * std::cos(a * p[d]) : std::sin(a * p[d]);
        }
      }
      const unsigned int other = component == 0 ? 1 : 0;
      const double x = p[component], y = p[other];
      result[component] += sign(component) * stream * pi * pi * std::sin(2. * pi * x) * std::sin(2. * pi * y);
      result[other] += sign(component) * stream * 2. * pi * pi * std::pow(std::sin(pi * x), 2) * std::cos(2. * pi * y);
      return result;
    }

  private:
    static constexpr double sizes[3] = { 0.03, -0.05, 0.02 };

    static double number(const unsigned int component, const unsigned int direction)
    {
      return component == 0 && direction == 0 ? 2. * pi : pi;
    }

    static double sign(const unsigned int component)
    {
      return component == 0 ? 1. : -1.;
    }

    const double waves, stream;
  };

  template <int dim>
  struct Problem
  {
    MaterialModel material;
    ElasticConstants elastic;
    Displacement<dim> exact;
  };

  template <int dim>
  Problem<dim> compressible(const MaterialModel material)
  {
    return { material, { 20., 0.3 }, { 1., 0. } };
  }

  /// Volumes change so little that lambda theta is of the size of the other stresses. Strains of 0.03; at finite strain, where
  /// the curl changes volumes by their square, of 0.006.
  Problem<2> nearly_incompressible(const MaterialModel material)
  {
    if (material == MaterialModel::linear)
      return { material, { 20., 0.4999 }, { 2e-5, 1.5e-3 } };
    return { material, { 20., 0.499 }, { 2e-5, 3e-4 } };
  }

  /// First Piola-Kirchhoff stress of the exact displacement, in plane strain, written anew here.
  template <int dim>
  Tensor<2, dim> exact_stress(const Problem<dim> &problem, const Point<dim> &p)
  {
    const auto &[material, elastic, exact] = problem;
    const double mu                        = elastic.young_modulus / (2. * (1. + elastic.poisson_ratio));
    const double lambda                    = 2. * mu * elastic.poisson_ratio / (1. - 2. * elastic.poisson_ratio);
    Tensor<2, dim> H, I;
    for (unsigned int d = 0; d < dim; ++d)
    {
      H[d]    = exact.gradient(p, d);
      I[d][d] = 1.;
    }
    if (material == MaterialModel::linear)
      return lambda * trace(H) * I + mu * (H + transpose(H));
    const auto F = I + H, turned = transpose(invert(F));
    return mu * (F - turned) + lambda * std::log(determinant(F)) * turned;
  }

  /// -Div P by central differences of fourth order: h^4 and round-off leave 1e-10 of the stress.
  template <int dim>
  Tensor<1, dim> body_force(const Problem<dim> &problem, const Point<dim> &p)
  {
    const double h = 1e-3;
    Tensor<1, dim> force;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const auto stress = [&](const double step) { return exact_stress(problem, p + step * Point<dim>::unit_vector(d)); };
      const auto slope  = (8. * (stress(h) - stress(-h)) - (stress(2. * h) - stress(-2. * h))) / (12. * h);
      for (unsigned int i = 0; i < dim; ++i)
        force[i] -= slope[i][d];
    }
    return force;
  }

  struct Errors
  {
    double l2;
    double h1;
  };

  /// Cells of a square or cube that is smoothly distorted inside, the whole boundary held.
  template <int dim>
  void make_cube(const unsigned int n, Triangulation<dim> &triangulation)
  {
    GridGenerator::subdivided_hyper_cube(triangulation, n);
    for (const auto &cell : triangulation.active_cell_iterators())
      cell->set_material_id(material_id::lever);
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(boundary_id::hub);
    const auto distorted = [](const Point<dim> &p)
    {
      double bump = 0.05;
      for (unsigned int d = 0; d < dim; ++d)
        bump *= std::sin(pi * p[d]);
      Point<dim> result = p;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += bump * (d == 0 ? p[1] : 1. - p[d - 1]);
      return result;
    };
    GridTools::transform(distorted, triangulation);
  }

  template <int dim>
  Vector<double> assemble_loads(const Problem<dim> &problem, const ElasticBody<dim> &body)
  {
    const auto &fe = body.dofs().get_fe();
    FEValues<dim> values(body.cell_mapping(), fe, QGauss<dim>(fe.degree + 5 - dim),
                         update_values | update_quadrature_points | update_JxW_values);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    Vector<double> loads(body.n_dofs());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(indices);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const auto force = body_force(problem, values.quadrature_point(q));
        for (unsigned int i = 0; i < indices.size(); ++i)
          loads[indices[i]] += values.shape_value(i, q) * force[fe.system_to_component_index(i).first] * values.JxW(q);
      }
    }
    return loads;
  }

  /// Newton's method from the interpolated displacement to round-off, which grows with lambda/mu, up to 5e3.
  template <int dim>
  Vector<double> equilibrium(const Problem<dim> &problem, const ElasticBody<dim> &body)
  {
    const auto loads = assemble_loads(problem, body);
    Vector<double> displacement(body.n_dofs());
    VectorTools::interpolate(body.cell_mapping(), body.dofs(), problem.exact, displacement);
    PETScWrappers::SparseMatrix matrix;
    body.reinit(matrix);
    Mumps factors(MatrixKind::positive_definite);
    double size = 1.;
    for (unsigned int i = 0; i < 10 && size > 1e-13; ++i)
    {
      matrix = 0.;
      Vector<double> forces(body.n_dofs()), correction;
      body.assemble(displacement, matrix, forces);
      Vector<double> residual = loads;
      residual -= forces;
      for (unsigned int d = 0; d < residual.size(); ++d)
        if (body.is_held(d))
          residual[d] = 0.;
      factors.factorise(matrix);
      factors.solve(residual, correction);
      displacement += correction;
      size = correction.linfty_norm();
    }
    const double nu = problem.elastic.poisson_ratio;
    EXPECT_LE(size, std::max(1e-12, 4e-15 * 2. * nu / (1. - 2. * nu)));
    return displacement;
  }

  template <int dim>
  Errors compute_errors(const Problem<dim> &problem, const unsigned int degree, const unsigned int n)
  {
    Triangulation<dim> triangulation;
    make_cube(n, triangulation);
    BodyProperties properties;
    properties.degree    = degree;
    properties.plane     = PlaneState::strain;
    properties.material  = problem.material;
    properties.constants = { { material_id::lever, problem.elastic } };
    const ElasticBody<dim> body(triangulation, properties);
    const auto displacement = equilibrium(problem, body);

    Vector<float> cell_errors;
    const auto norm = [&](const VectorTools::NormType type)
    {
      VectorTools::integrate_difference(body.cell_mapping(), body.dofs(), displacement, problem.exact, cell_errors,
                                        QGauss<dim>(degree + 5 - dim), type);
      return VectorTools::compute_global_error(triangulation, cell_errors, type);
    };
    return { norm(VectorTools::L2_norm), norm(VectorTools::H1_seminorm) };
  }

  // On halving the cells the errors fall by 2^(p+1) and 2^p, to leading order; the next order changes the exponent by less than
  // 0.1 from 16 to 32 cells, and by less than 0.15 from the coarser ones of a cube.
  template <int dim>
  void expect_orders(const Problem<dim> &problem, const unsigned int degree)
  {
    const unsigned int n = dim == 2 ? 16 : 8 / degree;
    const auto coarse    = compute_errors(problem, degree, n);
    const auto fine      = compute_errors(problem, degree, 2 * n);
    EXPECT_NEAR(std::log2(coarse.l2 / fine.l2), degree + 1., dim == 2 ? 0.1 : 0.15) << coarse.l2 << " -> " << fine.l2;
    EXPECT_NEAR(std::log2(coarse.h1 / fine.h1), degree, dim == 2 ? 0.1 : 0.15) << coarse.h1 << " -> " << fine.h1;
    // It is this displacement that is met, of L2 norm 0.03 and H1 seminorm 0.2 (at most a tenth of that where volumes are kept).
    EXPECT_LT(fine.l2, dim == 2 ? 1e-4 : 5e-4);
    EXPECT_LT(fine.h1, dim == 2 ? 1e-2 : 3e-2);
  }
} // namespace

TEST(ManufacturedSolution, HasItsOrders)
{
  for (const unsigned int degree : { 1u, 2u })
    for (const auto material : { MaterialModel::linear, MaterialModel::neo_hookean })
    {
      SCOPED_TRACE(degree);
      expect_orders(compressible<2>(material), degree);
      if (material == MaterialModel::linear)
        expect_orders(compressible<3>(material), degree);
    }
}

TEST(ManufacturedSolution, NearlyIncompressibleElasticityHasTheSameOrders)
{
  for (const unsigned int degree : { 1u, 2u })
    for (const auto material : { MaterialModel::linear, MaterialModel::neo_hookean })
    {
      SCOPED_TRACE(degree);
      expect_orders(nearly_incompressible(material), degree);
    }
}
