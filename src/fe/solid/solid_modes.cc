// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_modes.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/algebra/block_krylov.h"
#include "fe/solid/solid_mass.h"
#include "fe/solid/solid_stiffness.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Admissible |phi - omega^2 K^-1 M phi| over |phi|, times omega^2 over that of the lowest mode, by which round-off grows
    /// there. Solves with more or fewer columns differ by some 1e-11 of the softest motion.
    constexpr double largest_residual = 1e-9;

    constexpr double alike = 1e-6; ///< relative difference of displacements, as those of both sides in a mode that twists

    /// The lever in its free elastic displacements, the vibrations of its leaf spring with the hub held and last the rotation of
    /// its hub. There the stiffness is that of the body, of these vibrations and of the spring, which feel nothing of each other.
    class FreeLever
    {
    public:
      FreeLever(const SolidBody &body_, const SolidMass &mass_, const LeafBehaviour &leaf_, const double spring_)
          : body(body_)
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
        total.add(rotation(q), mass.arms());
        return mass(total);
      }

      /// Along xi and eta, with that of the leaf spring; `impulses` of the motion.
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

      void multiply_mass(const double *const q, double *const result) const
      {
        const auto impulses = impulse(q);
        for (std::size_t i = 0; i < free.size(); ++i)
          result[i] = impulses[free[i]];
        double of_hub = mass.arms() * impulses + mass.hub * rotation(q);
        for (std::size_t i = 0; i < leaf.modes.size(); ++i)
        {
          const double vibration  = q[free.size() + i];
          result[free.size() + i] = vibration + leaf.modes[i].participation * rotation(q);
          of_hub += leaf.modes[i].participation * vibration;
        }
        result[free.size() + leaf.modes.size()] = of_hub;
      }

      /// M q of motions, one after another.
      std::vector<double> inertia(const std::vector<double> &motions) const
      {
        std::vector<double> result(motions.size());
        for (std::size_t begin = 0; begin < motions.size(); begin += size())
          multiply_mass(&motions[begin], &result[begin]);
        return result;
      }

      /// K^-1 f of forces, one after another.
      std::vector<double> deformation(std::vector<double> columns) const
      {
        const std::size_t n_dofs = body.n_dofs();
        std::vector<double> loads(columns.size() / size() * n_dofs, 0.);
        const auto each = [&](const auto &of_dof)
        {
          for (std::size_t j = 0; j < columns.size() / size(); ++j)
            for (std::size_t i = 0; i < free.size(); ++i)
              of_dof(loads[j * n_dofs + free[i]], columns[j * size() + i]);
        };
        each([](double &load, const double force) { load = force; });
        body.respond(loads);
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

      const SolidBody &body;
      const SolidMass &mass;
      const LeafBehaviour &leaf;
      const double spring;
      std::vector<unsigned int> free;
    };

    /// With a modal mass of 1, the hub turning forward, or where it hardly turns, the first of the largest displacements
    /// positive.
    void normalise(const FreeLever &lever, std::vector<double> &mode)
    {
      std::vector<double> momentum(mode.size());
      lever.multiply_mass(mode.data(), momentum.data());
      double modal_mass = 0., largest = 0.;
      for (std::size_t i = 0; i < mode.size(); ++i)
        modal_mass += mode[i] * momentum[i];
      for (const double value : mode)
        if (std::abs(value) > (1. + alike) * std::abs(largest))
          largest = value;
      const double reference = std::abs(mode.back()) < 1e-8 * std::abs(largest) ? largest : mode.back();
      const double factor    = (reference < 0. ? -1. : 1.) / std::sqrt(modal_mass);
      for (double &value : mode)
        value *= factor;
    }

    void require_residuals(const FreeLever &lever, const std::vector<NormalMode> &modes)
    {
      std::vector<double> images;
      for (const auto &[omega_squared, mode] : modes)
        images.insert(images.end(), mode.begin(), mode.end());
      images = lever.deformation(lever.inertia(images));
      for (std::size_t j = 0; j < modes.size(); ++j)
      {
        const auto &[omega_squared, mode] = modes[j];
        double difference = 0., size = 0.;
        for (std::size_t i = 0; i < mode.size(); ++i)
        {
          difference = std::max(difference, std::abs(omega_squared * images[j * mode.size() + i] - mode[i]));
          size       = std::max(size, std::abs(mode[i]));
        }
        if (!(difference < largest_residual * omega_squared / modes.front().value * size))
          throw AnalysisError("vibration mode " + std::to_string(j + 1) + " was found with a residual of only " +
                              number_text(difference / size));
      }
    }

    FullMatrix<double> stiffness_of_layer(const SolidBody &body, const std::vector<Vector<double>> &modes)
    {
      const auto m         = static_cast<unsigned int>(modes.size());
      const auto &fe       = body.dofs().get_fe();
      const unsigned int n = fe.n_dofs_per_cell();
      CellStiffness stiffness(body.cell_mapping(), fe, body.body_properties());
      std::vector<types::global_dof_index> indices(n);
      FullMatrix<double> local(n, m), forces(n, m), result(m, m);
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        if (cell->material_id() != material_id::layer)
          continue;
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < m; ++j)
            local(i, j) = modes[j][indices[i]];
        stiffness(cell).mmult(forces, local);
        local.Tmmult(result, forces, true);
      }
      return result;
    }
  } // namespace

  SolidModes solid_modes(const SolidBody &body, const LeverInertia &inertia, const double spring_stiffness, const unsigned int n)
  {
    const SolidMass mass(body, inertia);
    FreeLever lever(body, mass, inertia.leaf, spring_stiffness);
    auto modes = lowest_eigenpairs({ lever.size(), [&](auto forces) { return lever.deformation(std::move(forces)); },
                                     [&](const auto &motions) { return lever.inertia(motions); } },
                                   n);
    require_residuals(lever, modes);
    SolidModes result;
    for (auto &[omega_squared, mode] : modes)
    {
      normalise(lever, mode);
      const auto impulse = lever.impulse(mode.data());
      result.stiffness.push_back(omega_squared);
      result.displacements.push_back(lever.elastic(mode.data()));
      result.rotation.push_back(mode.back());
      auto total = result.displacements.back();
      total.add(mode.back(), mass.arms());
      result.across.push_back(mass.shares(total, 1.));
      result.momentum.push_back(lever.momentum(mode.data(), impulse));
    }
    result.layer_stiffness   = stiffness_of_layer(body, result.displacements);
    result.density_factor    = mass.density_factor;
    result.total_mass        = mass.total_mass;
    result.moment_of_inertia = mass.moment_of_inertia;
    return result;
  }

  void tell_motion(const std::vector<const SolidModes *> &structures, std::vector<Eigenmode> &vibrations)
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
