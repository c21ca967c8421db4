#include "fe/fields/body_fields.h"

#include "fe/body/cell_elasticity.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <optional>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    bool touches_what_is_held(const ElasticBody<2> &body, const DoFHandler<2>::active_cell_iterator &cell)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (body.is_held(static_cast<unsigned int>(cell->vertex_dof_index(v, 0))))
          return true;
      return false;
    }

    /// Where the dilatation is projected, so is the pressure [MPa]: at each point by itself it would swing within the cell.
    void set_stress(const BodyProperties &properties, const ElasticConstants &constants, const Tensor<2, 2> &gradient,
                    const std::optional<double> &pressure, NodalField &node)
    {
      const Lame lame    = plane_constants(constants, properties.plane);
      const bool linear  = properties.material == MaterialModel::linear;
      const auto F       = Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient;
      const double J     = linear ? 1. : determinant(F);
      const auto at_node = pressure ? stress_at_pressure<2>(properties.material, lame.mu, gradient, *pressure)
                                    : stress_of<2>(properties.material, lame, gradient);
      node.stress        = symmetrize(linear ? at_node.piola : at_node.piola * transpose(F) / J);
      if (pressure)
        node.out_of_plane = *pressure / J;
      else if (properties.material == MaterialModel::neo_hookean)
        node.out_of_plane = lame.lambda * std::log(J) / J;
      else if (properties.plane == PlaneState::strain && linear)
        node.out_of_plane = constants.poisson_ratio * trace(node.stress);
      else if (properties.plane == PlaneState::strain)
        node.out_of_plane = lame.lambda * (0.5 * (F.norm_square() - 2.)) / J; // by the trace of the strain
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
      , places(QIterated<2>(QTrapezoid<1>(), body.body_properties().degree))
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
        std::optional<double> pressure;
        if (is_projected)
          pressure = plane_constants(properties.constants.at(material), properties.plane).lambda *
                     elasticity.dilatation()(all_nodes[result.size()].position);
        if (is_elastic)
          set_stress(properties, properties.constants.at(material), gradients[q], pressure, node);
        result.push_back(node);
      }
    }
    return result;
  }
} // namespace sprag
