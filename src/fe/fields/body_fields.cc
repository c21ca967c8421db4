#include "fe/fields/body_fields.h"

#include "fe/body/cell_elasticity.h"
#include "fe/body/dilatation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    Quadrature<2> equidistant(const unsigned int degree)
    {
      return QIterated<2>(QTrapezoid<1>(), degree);
    }

    bool touches_what_is_held(const ElasticBody<2> &body, const DoFHandler<2>::active_cell_iterator &cell)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (body.is_held(static_cast<unsigned int>(cell->vertex_dof_index(v, 0))))
          return true;
      return false;
    }

    void set_stress(const BodyProperties &properties, const ElasticConstants &constants, const Tensor<2, 2> &gradient,
                    NodalField &node)
    {
      const Lame lame   = plane_constants(constants, properties.plane);
      const bool strain = properties.plane == PlaneState::strain;
      const auto turned = [](const Tensor<2, 2> &stress) { return symmetrize(stress); };
      if (properties.material == MaterialModel::linear)
      {
        node.stress       = turned(linear_elastic<2>(lame, gradient).piola);
        node.out_of_plane = strain ? constants.poisson_ratio * trace(node.stress) : 0.;
        return;
      }
      const auto F   = Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient;
      const double J = determinant(F);
      if (properties.material == MaterialModel::st_venant_kirchhoff)
      {
        node.stress         = turned(st_venant_kirchhoff<2>(lame, gradient).piola * transpose(F) / J);
        const double volume = 0.5 * (F.norm_square() - 2.); // trace of the strain
        node.out_of_plane   = strain ? lame.lambda * volume / J : 0.;
        return;
      }
      node.stress       = turned(neo_hookean<2>(lame, F).piola * transpose(F) / J);
      node.out_of_plane = lame.lambda * std::log(J) / J;
    }

    /// Where the dilatation is projected, so is the pressure: at each point by itself it would swing within the cell.
    void set_stress_at_pressure(const BodyProperties &properties, const double mu, const Tensor<2, 2> &gradient,
                                const double pressure, NodalField &node)
    {
      const auto piola  = stress_at_pressure<2>(properties.material, mu, gradient, pressure).piola;
      const auto F      = Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient;
      const bool finite = properties.material != MaterialModel::linear;
      const double J    = finite ? determinant(F) : 1.;
      node.stress       = symmetrize(finite ? piola * transpose(F) / J : piola);
      node.out_of_plane = pressure / J;
    }
  } // namespace

  double von_mises(const NodalField &node)
  {
    const double a = node.stress[0][0] - node.stress[1][1];
    const double b = node.stress[1][1] - node.out_of_plane;
    const double c = node.out_of_plane - node.stress[0][0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * node.stress[0][1] * node.stress[0][1]);
  }

  BodyFields::BodyFields(const ElasticBody<2> &of)
      : body(of)
      , places(equidistant(body.body_properties().degree))
  {
    const unsigned int p = body.body_properties().degree;
    FEValues<2> values(body.cell_mapping(), body.dofs().get_fe(), places, update_quadrature_points);
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      const auto first  = static_cast<unsigned int>(all_nodes.size());
      const bool at_hub = cell->material_id() == material_id::hub || touches_what_is_held(body, cell);
      for (const auto &point : values.get_quadrature_points())
        all_nodes.push_back({ point, cell->material_id(), at_hub });
      for (unsigned int j = 0; j < p; ++j)
        for (unsigned int i = 0; i < p; ++i)
        {
          const unsigned int corner = first + j * (p + 1) + i;
          quads.insert(quads.end(), { corner, corner + 1, corner + p + 2, corner + p + 1 });
        }
    }
  }

  unsigned int BodyFields::nodes_per_cell() const
  {
    return places.size();
  }

  std::vector<NodalField> BodyFields::at(const Vector<double> &displacement) const
  {
    const auto &properties = body.body_properties();
    const auto &fe         = body.dofs().get_fe();
    FEValues<2> values(body.cell_mapping(), fe, places, update_values | update_gradients);
    CellElasticity<2> elasticity(body.cell_mapping(), fe, properties);
    Vector<double> of_cell(fe.n_dofs_per_cell());
    const FEValuesExtractors::Vector vector(0);
    std::vector<Tensor<1, 2>> displacements(places.size());
    std::vector<Tensor<2, 2>> gradients(places.size());
    std::vector<NodalField> result;
    result.reserve(all_nodes.size());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      values[vector].get_function_values(displacement, displacements);
      values[vector].get_function_gradients(displacement, gradients);
      const auto material     = cell->material_id();
      const bool is_elastic   = material != material_id::hub;
      const bool is_projected = is_elastic && is_nearly_incompressible(properties, material);
      if (is_projected)
      {
        cell->get_dof_values(displacement, of_cell);
        elasticity.reinit(cell, of_cell);
      }
      for (unsigned int q = 0; q < places.size(); ++q)
      {
        NodalField node{ displacements[q], {}, 0. };
        if (is_projected)
        {
          const Lame lame = plane_constants(properties.constants.at(material), properties.plane);
          set_stress_at_pressure(properties, lame.mu, gradients[q],
                                 lame.lambda * elasticity.dilatation()(all_nodes[result.size()].position), node);
        }
        else if (is_elastic)
          set_stress(properties, properties.constants.at(material), gradients[q], node);
        result.push_back(node);
      }
    }
    return result;
  }
} // namespace sprag
