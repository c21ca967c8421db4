// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact_of_levers.h"
#include "model/joined_memory.h"
#include "model/joined_ports.h"
#include "model/linearisation.h"
#include "model/port_layout.h"
#include "model/port_step.h"

#include <algorithm>
#include <array>
#include <memory>

namespace sprag
{
  /// The contacts of both levers of a mirrored pair, each with ports of its own in its own axes. Contact: see PointContact.
  template <class Contact>
  class MirroredContact
  {
  public:
    static constexpr bool uses_rates       = Contact::uses_rates;
    static constexpr bool keeps_tangent    = Contact::keeps_tangent;
    static constexpr bool stands_for_layer = Contact::stands_for_layer;
    static constexpr unsigned int levers   = 2;

    /// Result of an evaluation.
    struct Evaluation
    {
      std::array<typename Contact::Evaluation, 2> per_lever;
      PortForces forces;
      bool within_reach   = true;
      unsigned int points = 0; ///< of a lever, see joined_memory()

      auto memory() const
      {
        return joined_memory(points, per_lever[0].memory(), per_lever[1].memory());
      }
      StepWork work() const
      {
        StepWork result = per_lever[0].work();
        result += per_lever[1].work();
        return result;
      }
      double energy() const
      {
        return per_lever[0].energy() + per_lever[1].energy();
      }
      double overlap() const
      {
        return std::max(per_lever[0].overlap(), per_lever[1].overlap());
      }
    };

    /// `layout` is the pair's; memories of a contact number fewer than `points`.
    MirroredContact(std::array<std::unique_ptr<Contact>, 2> contacts, const PortLayout &layout_, const unsigned int points_)
        : contact(std::move(contacts))
        , layout(layout_)
        , points(points_)
    {
    }

    void evaluate(const PortStep &step, Evaluation &found) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto memory = lever_memory(lever, points, step.memory);
        const auto surface =
            step.surface_memory != nullptr ? lever_memory(lever, points, *step.surface_memory) : std::vector<PointMemory<2>>();
        const Kinematic begin{ lever_ports(lever, step.begin.position), lever_ports(lever, step.begin.velocity),
                               lever_ports(lever, step.begin.acceleration) };
        const auto end  = lever_ports(lever, step.end);
        const auto rate = lever_ports(lever, step.end_rate);
        contact[lever]->evaluate(PortStep{ step.from, memory, step.to, begin, end, rate, step.weights, &surface, step.request },
                                 found.per_lever[lever]);
      }
      join(found);
    }

    void evaluate_sliding(const SlidingState &state, Evaluation &found) const
    {
      for_each_lever(state, found,
                     [&](const unsigned int lever, const SlidingState &own)
                     { contact[lever]->evaluate_sliding(own, found.per_lever[lever]); });
    }

    PortPerturbation linearise(const SlidingState &state, Evaluation &found) const
    {
      std::array<PortPerturbation, 2> own;
      for_each_lever(state, found,
                     [&](const unsigned int lever, const SlidingState &sliding)
                     { own[lever] = contact[lever]->linearise(sliding, found.per_lever[lever]); });
      PortPerturbation result(found.forces.ports);
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        for (auto &port : own[lever].ports)
          port = joined_port(layout, lever, port);
        result.add(own[lever]);
      }
      return result;
    }

    const PortSelection &reachable_ports(const double x, const PerLever &theta)
    {
      reachable.clear();
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const unsigned int port : contact[lever]->reachable_ports(x, { { theta[lever] } }))
          if (port < layout.ports_per_lever())
            reachable.push_back(layout.first(lever) + port);
      if (layout.sprung)
        reachable.push_back(layout.support());
      return reachable;
    }

    void widen_reach()
    {
      for (const auto &lever_contact : contact)
        lever_contact->widen_reach();
    }

    auto touch(const dealii::Vector<double> &ports, const DrivePoint &drive, Evaluation &found) const
    {
      const auto touch_lever = [&](const unsigned int lever)
      { return contact[lever]->touch(lever_ports(lever, ports), drive, found.per_lever[lever]); };
      const auto first  = touch_lever(0);
      const auto memory = joined_memory(points, first, touch_lever(1));
      join(found);
      return memory;
    }

    double gap_change(const Evaluation &found, const dealii::Vector<double> &port_change, const unsigned int lever) const
    {
      return contact[lever]->gap_change(found.per_lever[lever], lever_ports(lever, port_change));
    }

    /// Mean slip of the first lever [mm].
    double mean_slip(const Evaluation &found, const dealii::Vector<double> &from, const double from_x,
                     const dealii::Vector<double> &to, const double to_x) const
    {
      return contact[0]->mean_slip(found.per_lever[0], lever_ports(0, from), from_x, lever_ports(0, to), to_x);
    }

    void observe(const Evaluation &found, Row &row, const unsigned int lever) const
    {
      contact[lever]->observe(found.per_lever[lever], row);
    }

    double drive_force(const Evaluation &found) const
    {
      return contact[0]->drive_force(found.per_lever[0]) + contact[1]->drive_force(found.per_lever[1]);
    }

    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, const unsigned int lever) const
    {
      return contact[lever]->surface_shape(lever_ports(lever, displacements));
    }

    /// Points of the face of either lever.
    FacePoints face_points() const
    {
      return contact[0]->face_points();
    }
    FaceState face_state(const Evaluation &found, const DrivePoint &drive) const
    {
      return joined_faces(contact[0]->face_state(found.per_lever[0], drive), contact[1]->face_state(found.per_lever[1], drive));
    }

    void visit_history(Archive &archive)
    {
      for (const auto &lever_contact : contact)
        lever_contact->visit_history(archive);
    }

  private:
    const std::array<std::unique_ptr<Contact>, 2> contact;
    const PortLayout layout;
    const unsigned int points;
    PortSelection reachable;

    dealii::Vector<double> lever_ports(const unsigned int lever, const dealii::Vector<double> &pair_ports) const
    {
      return extract_lever_ports(layout, lever, pair_ports);
    }

    /// Evaluates both contacts, each at its own ports.
    template <class Evaluate>
    void for_each_lever(const SlidingState &state, Evaluation &found, const Evaluate &evaluate) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto ports = lever_ports(lever, state.ports);
        const auto rates = state.rates != nullptr ? lever_ports(lever, *state.rates) : dealii::Vector<double>();
        evaluate(lever, SlidingState{ ports, state.drive, state.speed, state.rates != nullptr ? &rates : nullptr, state.friction,
                                      state.request, state.friction_share });
      }
      join(found);
    }

    void join(Evaluation &found) const
    {
      const auto &evaluations = found.per_lever;
      join_forces(layout, { &evaluations[0].forces, &evaluations[1].forces }, found.forces);
      found.within_reach = evaluations[0].within_reach && evaluations[1].within_reach;
      found.points       = points;
    }
  };
} // namespace sprag
