// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_spring.h"

#include "base/errors.h"
#include "fe/algebra/compressed_rows.h"
#include "fe/algebra/free_modes.h"
#include "fe/leaf/leaf_body.h"
#include "scene/closed_form.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_modes = 8;

    /// A mass per area of the cells or length of the faces that `values` visits, once for every call of `add`.
    struct MassOf
    {
      const FEValuesBase<2> &values;
      PETScWrappers::SparseMatrix &mass;
      FullMatrix<double> local                     = FullMatrix<double>(values.get_fe().n_dofs_per_cell());
      std::vector<types::global_dof_index> indices = std::vector<types::global_dof_index>(local.m());

      template <class Cell>
      void add(const Cell &cell, const double density)
      {
        const auto &fe = values.get_fe();
        local          = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < local.m(); ++i)
            for (unsigned int j = 0; j < local.n(); ++j)
              if (fe.system_to_component_index(i).first == fe.system_to_component_index(j).first)
                local(i, j) += density * values.JxW(q) * values.shape_value(i, q) * values.shape_value(j, q);
        cell->get_dof_indices(indices);
        mass.add(indices, local);
      }
    };

    void assemble_mass(const ElasticBody<2> &body, const double density, PETScWrappers::SparseMatrix &mass)
    {
      const auto &fe = body.dofs().get_fe();
      FEValues<2> values(body.cell_mapping(), fe, QGauss<2>(fe.degree + 1), update_values | update_JxW_values);
      body.reinit(mass);
      MassOf of_cells{ values, mass };
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        values.reinit(cell);
        of_cells.add(cell, density * body.body_properties().width_of(cell->material_id()));
      }
      mass.compress(VectorOperation::add);
    }

    /// A mass on the section at the joint, evenly over it.
    void assemble_joint(const ElasticBody<2> &body, const double joint_mass, PETScWrappers::SparseMatrix &mass)
    {
      const auto &fe = body.dofs().get_fe();
      FEFaceValues<2> values(body.cell_mapping(), fe, QGauss<1>(fe.degree + 1), update_values | update_JxW_values);
      const auto on_joint = [&](const auto &visit)
      {
        for (const auto &cell : body.dofs().active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary_id::joint)
            {
              values.reinit(cell, f);
              visit(cell);
            }
      };
      double length = 0.;
      on_joint([&](const auto &)
               { length = std::accumulate(values.get_JxW_values().begin(), values.get_JxW_values().end(), length); });
      MassOf of_section{ values, mass };
      on_joint([&](const auto &cell) { of_section.add(cell, joint_mass / length); });
      mass.compress(VectorOperation::add);
    }

    /// Unit displacements of all along xi and along eta.
    std::array<Vector<double>, 2> translations(const ElasticBody<2> &body)
    {
      std::array<Vector<double>, 2> result{ { Vector<double>(body.n_dofs()), Vector<double>(body.n_dofs()) } };
      const auto &fe = body.dofs().get_fe();
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          result[fe.system_to_component_index(i).first][indices[i]] = 1.;
      }
      return result;
    }

    Vector<double> product(const PETScWrappers::SparseMatrix &matrix, const Vector<double> &vector)
    {
      const CompressedRows rows(matrix);
      Vector<double> result(vector.size());
      rows.multiply<1>({ { &vector } }, { { &result } });
      return result;
    }
  } // namespace

  void add_inertia(LeafBody &leaf, const double density, const double joint_mass, LeafBehaviour &behaviour)
  {
    const auto &body    = leaf.body();
    const auto &statics = leaf.statics();
    const auto shape    = leaf.rest().rate;
    const auto axes     = translations(body);
    PETScWrappers::SparseMatrix mass, reduced_mass, reduced_stiffness;
    assemble_mass(body, density, mass);
    if (joint_mass > 0.)
      assemble_joint(body, joint_mass, mass);
    statics.reduce(mass, reduced_mass);
    statics.reduce(statics.stiffness(), reduced_stiffness);

    const auto weighed = product(mass, shape);
    behaviour.mass     = body.mass_and_inertia(density)[0] + joint_mass;
    behaviour.inertia  = weighed * shape;
    behaviour.momentum = { { weighed * axes[0], weighed * axes[1] } };

    const auto modes = free_modes(reduced_stiffness, reduced_mass, n_modes);
    for (unsigned int i = 0; i < modes.shapes.size(); ++i)
    {
      const auto of_mode = product(mass, statics.expand(modes.shapes[i]));
      behaviour.modes.push_back({ modes.stiffness[i], of_mode * shape, { { of_mode * axes[0], of_mode * axes[1] } } });
    }
  }

  namespace
  {
    using State = LeafBody::State;

    /// Admissible error of the law between samples, over the largest moment.
    constexpr double precision = 1e-8;

    /// Over the leaf's length: the arm at which the forces that round-off leaves err in moments between samples. They balance
    /// cell by cell; leaves of 0.02 to 0.1 mm and 100 mm length have a sixth of that.
    constexpr double arm_of_round_off = 0.01;

    /// Halvings of a step of the turn between samples.
    constexpr unsigned int most_halvings = 12;

    /// Cubic Hermite interpolation in the middle between two states.
    double middle_moment(const State &a, const State &b)
    {
      return 0.5 * (a.moment + b.moment) + 0.125 * (b.turn - a.turn) * (a.stiffness - b.stiffness);
    }

    Vector<double> middle_displacement(const State &a, const State &b)
    {
      Vector<double> result = a.displacement;
      result.sadd(0.5, 0.5, b.displacement);
      result.add(0.125 * (b.turn - a.turn), a.rate, -0.125 * (b.turn - a.turn), b.rate);
      return result;
    }

    /// Samples the moment of a leaf over the turn.
    class Sampler
    {
    public:
      Sampler(LeafBody &leaf_, const double length, const double smallest_turn, const double largest_turn)
          : leaf(leaf_)
      {
        const State rest = leaf.rest();
        std::vector<State> states;
        if (smallest_turn < 0.)
          states = leaf.steps(rest, smallest_turn);
        std::reverse(states.begin(), states.end());
        states.push_back(rest);
        if (largest_turn > 0.)
          for (auto &state : leaf.steps(rest, largest_turn))
            states.push_back(std::move(state));
        for (const auto &state : states)
          allowed = std::max({ allowed, precision * std::abs(state.moment),
                               arm_of_round_off * length * leaf.statics().round_off(state.displacement) });
        add(states.front());
        for (std::size_t i = 1; i < states.size(); ++i)
          refine(states[i - 1], states[i], most_halvings);
      }

      const std::vector<MomentLaw::Sample> &samples() const
      {
        return all;
      }

    private:
      void add(const State &state)
      {
        all.push_back({ state.turn, state.moment, state.stiffness });
      }

      State middle_of(const State &from, const State &to)
      {
        const double turn = 0.5 * (from.turn + to.turn);
        try
        {
          return leaf.state(turn, middle_displacement(from, to));
        }
        catch (const AnalysisError &)
        {
          return leaf.steps(from, turn).back();
        }
      }

      /// Adds what comes after `from` up to `to`. Halving a step divides the error of cubic interpolation by 16, of which half is
      /// trusted.
      void refine(const State &from, const State &to, const unsigned int halvings)
      {
        const State middle = middle_of(from, to);
        const bool fine    = std::abs(middle.moment - middle_moment(from, to)) <= 8. * allowed;
        if (!fine && halvings == 0)
          throw AnalysisError("the moment of the leaf spring jumps over its turn: it snaps through. Try a smaller 'Leaf "
                              "spring/Sagitta' or 'Leaf spring/Axial' = free");
        if (fine)
          add(middle);
        else
          refine(from, middle, halvings - 1);
        if (fine)
          add(to);
        else
          refine(middle, to, halvings - 1);
      }

      LeafBody &leaf;
      double allowed = 0.;
      std::vector<MomentLaw::Sample> all;
    };
  } // namespace

  LeafBehaviour leaf_behaviour(const LeafSpring &leaf, const PlaneState plane, const double smallest_turn,
                               const double largest_turn, const double joint_mass)
  {
    LeafBody body(leaf, plane);
    LeafBehaviour behaviour;
    add_inertia(body, leaf.density, joint_mass, behaviour);
    const double stiffness = body.rest().stiffness;
    behaviour.law          = MomentLaw(stiffness, Sampler(body, leaf.length, smallest_turn, largest_turn).samples());
    return behaviour;
  }

  LeafBehaviour swinging_leaf(LeafSpring leaf, const PlaneState plane, const double joint_mass)
  {
    leaf.end = LeafEnd::loose;
    LeafBody body(leaf, plane);
    LeafBehaviour behaviour;
    add_inertia(body, leaf.density, joint_mass, behaviour);
    return behaviour;
  }

  RotationalSpring prepared_spring(const Device &device)
  {
    RotationalSpring result = device.spring;
    if (result.type != SpringType::leaf)
      return result;
    const double rest       = kinematics(device.geometry, 0.).theta;
    const double smallest   = std::min(0., kinematics(device.geometry, device.drive.minimum()).theta - rest);
    const double largest    = std::max(0., kinematics(device.geometry, device.drive.maximum()).theta - rest);
    const double room       = std::max(0.02, 0.5 * std::max(-smallest, largest));
    const double joint_mass = 0.5 * device.pair.joint_mass; // the mirrored lever's leaf carries the other half
    const auto plane        = result.leaf.plane;
    result.behaviour        = leaf_behaviour(result.leaf, plane, smallest - room, largest + room, joint_mass);
    result.stiffness        = result.behaviour.law.linear_stiffness();
    if (swings(device))
      result.swing = swinging_leaf(result.leaf, plane, joint_mass);
    return result;
  }
} // namespace sprag
