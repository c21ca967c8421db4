// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_spring.h"

#include "base/errors.h"
#include "fe/algebra/block_krylov.h"
#include "fe/body/body_mass.h"
#include "fe/leaf/leaf_body.h"
#include "scene/closed_form.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  void add_inertia(LeafBody &leaf, const double density, const double joint_mass, LeafBehaviour &behaviour)
  {
    constexpr unsigned int n_modes = 8;
    const auto &body               = leaf.body();
    const auto shape               = leaf.rest().rate;
    LeverInertia masses            = { { { material_id::leaf, density } }, joint_mass };
    masses.source                  = InertiaSource::as_built;
    const BodyMass<2> mass(body, masses, boundary_faces(body.dofs(), boundary_id::joint));
    const auto momentum = [&](const Vector<double> &weighed) -> std::array<double, 2> {
      return { { mass.sum_along(0, weighed), mass.sum_along(1, weighed) } };
    };

    const auto weighed = mass(shape);
    behaviour.mass     = mass.total_mass;
    behaviour.inertia  = weighed * shape;
    behaviour.momentum = momentum(weighed);

    const Vector<double> at_rest(body.n_dofs());
    const auto deformation = [&](const Vector<double> &loads) { return leaf.statics().response(at_rest, loads); };
    const auto inertia     = [&](const Vector<double> &motion) { return mass(motion); };
    const Pencil pencil{ body.n_dofs(), column_by_column(body.n_dofs(), deformation), column_by_column(body.n_dofs(), inertia) };
    for (const auto &[omega_squared, mode] : normal_modes(pencil, n_modes))
    {
      const auto mode_momenta = mass(Vector<double>(mode.begin(), mode.end()));
      behaviour.modes.push_back({ omega_squared, mode_momenta * shape, momentum(mode_momenta) });
    }
  }

  namespace
  {
    using State = LeafBody::State;

    /// Admissible error of the law between samples, over the largest moment.
    constexpr double precision = 1e-8;

    /// This times the leaf's length is the arm at which the forces that round-off leaves err in moments between samples. They
    /// balance cell by cell; leaves of 0.02 to 0.1 mm and 100 mm length have a sixth of that.
    constexpr double round_off_arm = 0.01;

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
                               round_off_arm * length * leaf.statics().round_off(state.displacement) });
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

      State midpoint(const State &from, const State &to)
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
        const State middle = midpoint(from, to);
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
    const double rest       = kinematics(device.geometry, 0.).theta + device.spring.rest_angle;
    const double smallest   = std::min(0., kinematics(device.geometry, device.drive.minimum()).theta - rest);
    const double largest    = std::max(0., kinematics(device.geometry, device.drive.maximum()).theta - rest);
    const double margin     = std::max(0.02, 0.5 * std::max(-smallest, largest));
    const double joint_mass = 0.5 * device.pair.joint_mass; // the mirrored lever's leaf carries the other half
    const auto plane        = result.leaf.plane;
    result.behaviour        = leaf_behaviour(result.leaf, plane, smallest - margin, largest + margin, joint_mass);
    result.stiffness        = result.behaviour.law.linear_stiffness();
    if (swings(device))
      result.swing = swinging_leaf(result.leaf, plane, joint_mass);
    return result;
  }
} // namespace sprag
