// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/lever_modes.h"

#include "fe/algebra/block_krylov.h"
#include "fe/body/cell_stiffness.h"
#include "fe/body/end_face.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Mass and stiffness of a lever. Its coordinates are the free elastic displacements, the vibrations of its leaf spring with
    /// the hub held and last the rotation of the hub. The stiffness does not couple these three groups.
    template <int dim>
    class FreeLever
    {
    public:
      FreeLever(const ElasticBody<dim> &body_, const Response &response_, const BodyMass<dim> &mass_, const LeafBehaviour &leaf_,
                const double spring_)
          : body(body_)
          , response(response_)
          , mass(mass_)
          , leaf(leaf_)
          , spring(spring_)
      {
        for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
          if (!body.is_held(dof))
            free.push_back(dof);
      }

      std::size_t size() const
      {
        return free.size() + leaf.modes.size() + 1;
      }

      Vector<double> elastic(const double *const q) const
      {
        Vector<double> result(body.n_dofs());
        for (std::size_t i = 0; i < free.size(); ++i)
          result[free[i]] = q[i];
        return result;
      }

      /// Mass times the total displacement of a motion.
      Vector<double> impulse(const double *const q) const
      {
        auto total = elastic(q);
        total.add(rotation(q), mass.arms);
        return mass(total);
      }

      /// Returns the momentum along xi and eta, leaf spring included; `impulses` is impulse(q).
      std::array<double, 2> momentum(const double *const q, const Vector<double> &impulses) const
      {
        std::array<double, 2> result{};
        for (unsigned int axis = 0; axis < 2; ++axis)
        {
          result[axis] = mass.sum_along(axis, impulses) + leaf.momentum[axis] * rotation(q);
          for (std::size_t i = 0; i < leaf.modes.size(); ++i)
            result[axis] += leaf.modes[i].momentum[axis] * q[free.size() + i];
        }
        return result;
      }

      /// M q of motions, one after another.
      std::vector<double> inertia(const std::vector<double> &motions) const
      {
        std::vector<double> all(motions.size());
        for (std::size_t begin = 0; begin < motions.size(); begin += size())
        {
          const double *const q = &motions[begin];
          double *const result  = &all[begin];
          const auto impulses   = impulse(q);
          for (std::size_t i = 0; i < free.size(); ++i)
            result[i] = impulses[free[i]];
          double &hub_inertia = result[size() - 1] = mass.arms * impulses + mass.hub * rotation(q);
          for (std::size_t i = 0; i < leaf.modes.size(); ++i)
          {
            const double vibration  = q[free.size() + i];
            result[free.size() + i] = vibration + leaf.modes[i].participation * rotation(q);
            hub_inertia += leaf.modes[i].participation * vibration;
          }
        }
        return all;
      }

      /// K^-1 f of forces, one after another.
      std::vector<double> deformation(std::vector<double> columns) const
      {
        const std::size_t n_dofs = body.n_dofs();
        std::vector<double> loads(columns.size() / size() * n_dofs, 0.);
        const auto each = [&](const auto &visit)
        {
          for (std::size_t j = 0; j < columns.size() / size(); ++j)
            for (std::size_t i = 0; i < free.size(); ++i)
              visit(loads[j * n_dofs + free[i]], columns[j * size() + i]);
        };
        each([](double &load, const double force) { load = force; });
        loads = response(std::move(loads));
        each([](const double displacement, double &place) { place = displacement; });
        for (std::size_t begin = 0; begin < columns.size(); begin += size())
        {
          for (std::size_t i = 0; i < leaf.modes.size(); ++i)
            columns[begin + free.size() + i] /= leaf.modes[i].stiffness;
          columns[begin + size() - 1] /= spring;
        }
        return columns;
      }

    private:
      /// Rotation of the hub in a motion, or the moment of forces.
      double rotation(const double *const q) const
      {
        return q[free.size() + leaf.modes.size()];
      }

      const ElasticBody<dim> &body;
      const Response &response;
      const BodyMass<dim> &mass;
      const LeafBehaviour &leaf;
      const double spring;
      std::vector<unsigned int> free;
    };

    /// Returns for each degree of freedom its mirror image at the middle plane; empty where one has none. `axes` are their
    /// directions.
    std::vector<unsigned int> mirrored_dofs(const ElasticBody<3> &body, const std::vector<int> &axes)
    {
      std::vector<Point<3>> places(body.n_dofs());
      DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), places);
      const auto key = [&](const unsigned int dof, const double side)
      {
        const auto &place = places[dof];
        return std::array<long, 4>{ { std::lround(1e6 * place[0]), std::lround(1e6 * place[1]),
                                      std::lround(1e6 * side * place[2]), axes[dof] } };
      };
      std::map<std::array<long, 4>, unsigned int> known;
      for (unsigned int dof = 0; dof < places.size(); ++dof)
        known[key(dof, 1.)] = dof;
      std::vector<unsigned int> result;
      for (unsigned int dof = 0; dof < places.size(); ++dof)
      {
        const auto found = known.find(key(dof, -1.));
        if (found == known.end())
          return {};
        result.push_back(found->second);
      }
      return result;
    }

    /// Adds the shares of the kinetic energy in the plane, in twisting and sideways. Modes have the modal mass 1 t; hub and leaf
    /// spring move in the plane. The shares are NaN if the body is not symmetric about its middle plane.
    void add_shares(const ElasticBody<3> &body, const BodyMass<3> &mass, LeverModes &modes)
    {
      const auto axes     = turning_axes(body);
      const auto mirrored = mirrored_dofs(body, axes);
      modes.across.resize(modes.displacements.size());
      for (unsigned int i = 0; i < modes.across.size() && !mirrored.empty(); ++i)
      {
        auto total = modes.displacements[i];
        total.add(modes.rotation[i], mass.arms);
        Vector<double> antisymmetric(total.size());
        for (unsigned int dof = 0; dof < antisymmetric.size(); ++dof)
          antisymmetric[dof] = 0.5 * (total[dof] + (axes[dof] == 2 ? 1. : -1.) * total[mirrored[dof]]);
        const auto momentum = mass(antisymmetric);
        double sideways     = 0.;
        for (unsigned int dof = 0; dof < antisymmetric.size(); ++dof)
          sideways += axes[dof] == 2 ? antisymmetric[dof] * momentum[dof] : 0.;
        const double antisymmetric_share = antisymmetric * momentum;
        modes.across[i]                  = { 1. - antisymmetric_share, antisymmetric_share - sideways, sideways };
      }
    }

    template <int dim>
    FullMatrix<double> project_layer_stiffness(const ElasticBody<dim> &body, const std::vector<Vector<double>> &modes)
    {
      const auto m         = static_cast<unsigned int>(modes.size());
      const unsigned int n = body.dofs().get_fe().n_dofs_per_cell();
      CellStiffness<dim> stiffness(body);
      FullMatrix<double> local(n, m), forces(n, m), result(m, m);
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        if (cell->material_id() != material_id::layer)
          continue;
        const auto indices = cell_dofs(cell);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < m; ++j)
            local(i, j) = modes[j][indices[i]];
        stiffness(cell).mmult(forces, local);
        local.Tmmult(result, forces, true);
      }
      return result;
    }
  } // namespace

  template <int dim>
  LeverModes lever_modes(const ElasticBody<dim> &body, const Response &response, const LeverInertia &inertia,
                         const double spring_stiffness, const unsigned int n)
  {
    const BodyMass<dim> mass(body, inertia);
    const FreeLever<dim> lever(body, response, mass, inertia.leaf, spring_stiffness);
    const auto modes = normal_modes({ lever.size(), [&](auto forces) { return lever.deformation(std::move(forces)); },
                                      [&](const auto &motions) { return lever.inertia(motions); } },
                                    n);
    LeverModes result;
    for (const auto &[omega_squared, mode] : modes)
    {
      result.stiffness.push_back(omega_squared);
      result.displacements.push_back(lever.elastic(mode.data()));
      result.rotation.push_back(mode.back());
      result.leaf.emplace_back(mode.end() - 1 - static_cast<std::ptrdiff_t>(inertia.leaf.modes.size()), mode.end() - 1);
      result.momentum.push_back(lever.momentum(mode.data(), lever.impulse(mode.data())));
    }
    if constexpr (dim == 3)
      add_shares(body, mass, result);
    result.layer_stiffness          = project_layer_stiffness(body, result.displacements);
    static_cast<MassSums &>(result) = mass;
    return result;
  }

  template LeverModes lever_modes(const ElasticBody<2> &, const Response &, const LeverInertia &, double, unsigned int);
  template LeverModes lever_modes(const ElasticBody<3> &, const Response &, const LeverInertia &, double, unsigned int);

  void find_across_shares(const std::vector<const LeverModes *> &structures, std::vector<Eigenmode> &vibrations)
  {
    for (auto &vibration : vibrations)
    {
      Eigenmode::AcrossShares sum{ 0., 0., 0. };
      double whole                  = 0.;
      const auto &[real, imaginary] = vibration.mode.coordinates;
      const auto n                  = static_cast<unsigned int>(real.size() / structures.size());
      for (unsigned int i = 0; i < structures.size(); ++i)
        for (unsigned int j = 0; j < structures[i]->across.size(); ++j)
        {
          const auto &own       = structures[i]->across[j];
          const unsigned int at = i * n + j;
          const double energy   = real[at] * real[at] + imaginary[at] * imaginary[at];
          whole += energy;
          sum.plane += energy * own.plane;
          sum.twisting += energy * own.twisting;
          sum.sideways += energy * own.sideways;
        }
      vibration.across = { sum.plane / whole, sum.twisting / whole, sum.sideways / whole };
    }
  }
} // namespace sprag
