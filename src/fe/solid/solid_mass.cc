#include "fe/solid/solid_mass.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/solid/solid_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Of unit density, between the scalar shape functions of a cell.
    FullMatrix<double> unit_mass(const FEValues<3> &values)
    {
      const auto &fe       = values.get_fe();
      const unsigned int n = fe.base_element(0).n_dofs_per_cell();
      FullMatrix<double> result(n, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            result(a, b) += values.JxW(q) * values.shape_value(fe.component_to_system_index(0, a), q) *
                            values.shape_value(fe.component_to_system_index(0, b), q);
      return result;
    }
  } // namespace

  SolidMass::SolidMass(const SolidBody &body, const LeverInertia &inertia)
      : hub(inertia.hub)
      , rotation_arms(body.n_dofs())
      , component(body.n_dofs())
  {
    find_arms(body);
    find_cells(body);
    const auto use_densities = [&](const double factor)
    {
      for (std::size_t i = 0; i < cells.size(); ++i)
        cells[i].density = factor * inertia.densities.at(materials[i]) * body.body_properties().width;
    };
    use_densities(1.);
    const double of_cells = rotation_arms * (*this)(rotation_arms);
    if (inertia.source == InertiaSource::scaled)
    {
      if (inertia.moment_of_inertia <= hub)
        throw InputError("Lever/Hub inertia alone is " + rounded_text(hub) +
                         " t mm^2: Lever/Moment of inertia = " + rounded_text(inertia.moment_of_inertia) + " must be larger");
      density_factor = (inertia.moment_of_inertia - hub) / of_cells;
      use_densities(density_factor);
    }
    moment_of_inertia = density_factor * of_cells + hub;
    Vector<double> along(body.n_dofs());
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      along[dof] = component[dof] == 0 ? 1. : 0.;
    total_mass = along * (*this)(along);
  }

  void SolidMass::find_arms(const SolidBody &body)
  {
    std::vector<Point<3>> places(body.n_dofs());
    DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), places);
    const auto &fe = body.dofs().get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const auto direction      = fe.system_to_component_index(i).first;
        component[indices[i]]     = static_cast<char>(direction);
        const auto &place         = places[indices[i]];
        rotation_arms[indices[i]] = direction == 0 ? -place[1] : direction == 1 ? place[0] : 0.;
      }
    }
    find_mirrored(places);
  }

  void SolidMass::find_mirrored(const std::vector<Point<3>> &places)
  {
    const auto key = [&](const unsigned int dof, const double side)
    {
      const auto &place = places[dof];
      return std::array<long, 4>{ { std::lround(1e6 * place[0]), std::lround(1e6 * place[1]), std::lround(1e6 * side * place[2]),
                                    component[dof] } };
    };
    std::map<std::array<long, 4>, unsigned int> known;
    for (unsigned int dof = 0; dof < places.size(); ++dof)
      known[key(dof, 1.)] = dof;
    for (unsigned int dof = 0; dof < places.size(); ++dof)
    {
      const auto found = known.find(key(dof, -1.));
      if (found == known.end())
        return mirrored.clear();
      mirrored.push_back(found->second);
    }
  }

  Eigenmode::AcrossShares SolidMass::shares(const Vector<double> &displacement) const
  {
    if (mirrored.empty())
      return {};
    Vector<double> opposite(displacement.size());
    for (unsigned int dof = 0; dof < opposite.size(); ++dof)
      opposite[dof] = 0.5 * (displacement[dof] + (component[dof] == 2 ? 1. : -1.) * displacement[mirrored[dof]]);
    const auto momentum = (*this)(opposite);
    double sideways     = 0.;
    for (unsigned int dof = 0; dof < opposite.size(); ++dof)
      sideways += component[dof] == 2 ? opposite[dof] * momentum[dof] : 0.;
    const double whole = displacement * (*this)(displacement), of_opposite = opposite * momentum;
    return { 1. - of_opposite / whole, (of_opposite - sideways) / whole, sideways / whole };
  }

  void SolidMass::find_cells(const SolidBody &body)
  {
    const auto &fe          = body.dofs().get_fe();
    const unsigned int n    = fe.n_dofs_per_cell();
    const unsigned int each = fe.base_element(0).n_dofs_per_cell();
    FEValues<3> values(body.cell_mapping(), fe, QGauss<3>(fe.degree + 1), update_values | update_JxW_values);
    std::map<std::vector<long>, const FullMatrix<double> *> known;
    std::vector<types::global_dof_index> indices(n);
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      if (cell->material_id() == material_id::hub)
        continue;
      const auto [found, is_new] = known.try_emplace(likeness(cell));
      if (is_new)
      {
        values.reinit(cell);
        found->second = &masses.emplace_back(unit_mass(values));
      }
      cell->get_dof_indices(indices);
      Cell of_cell{ found->second, 0., std::vector<std::array<unsigned int, 3>>(each) };
      for (unsigned int a = 0; a < each; ++a)
        for (unsigned int d = 0; d < 3; ++d)
          of_cell.dofs[a][d] = static_cast<unsigned int>(indices[fe.component_to_system_index(d, a)]);
      cells.push_back(std::move(of_cell));
      materials.push_back(cell->material_id());
    }
  }

  Vector<double> SolidMass::operator()(const Vector<double> &displacement) const
  {
    Vector<double> result(displacement.size());
    for (const auto &[mass, density, dofs] : cells)
      for (unsigned int a = 0; a < dofs.size(); ++a)
      {
        std::array<double, 3> sum{};
        const double *const row = &(*mass)(a, 0);
        for (unsigned int b = 0; b < dofs.size(); ++b)
          for (unsigned int d = 0; d < 3; ++d)
            sum[d] += row[b] * displacement[dofs[b][d]];
        for (unsigned int d = 0; d < 3; ++d)
          result[dofs[a][d]] += density * sum[d];
      }
    return result;
  }

  double SolidMass::sum_along(const unsigned int axis, const Vector<double> &of_dofs) const
  {
    double result = 0.;
    for (unsigned int dof = 0; dof < of_dofs.size(); ++dof)
      if (static_cast<unsigned int>(component[dof]) == axis)
        result += of_dofs[dof];
    return result;
  }
} // namespace sprag
