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
      std::array<typename Contact::Evaluation, 2> of_lever;
      PortForces forces;
      bool within_reach   = true;
      unsigned int points = 0; ///< of a lever, see joined_memory()

      auto memory() const
      {
        return joined_memory(points, of_lever[0].memory(), of_lever[1].memory());
      }
      StepWork work() const
      {
        StepWork result = of_lever[0].work();
        result += of_lever[1].work();
        return result;
      }
      double energy() const
      {
        return of_lever[0].energy() + of_lever[1].energy();
      }
      double overlap() const
      {
        return std::max(of_lever[0].overlap(), of_lever[1].overlap());
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
        const auto memory = memory_of_lever(lever, points, step.memory);
        const auto surface =
            step.surface_memory != nullptr ? memory_of_lever(lever, points, *step.surface_memory) : std::vector<PointMemory<2>>();
        const Kinematic begin{ ports_of(lever, step.begin.position), ports_of(lever, step.begin.velocity),
                               ports_of(lever, step.begin.acceleration) };
        const auto end  = ports_of(lever, step.end);
        const auto rate = ports_of(lever, step.end_rate);
        contact[lever]->evaluate(PortStep{ step.from, memory, step.to, begin, end, rate, step.weights, &surface, step.wanted },
                                 found.of_lever[lever]);
      }
      join(found);
    }

    void complete(Evaluation &found) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
        contact[lever]->complete(found.of_lever[lever]);
    }

    void evaluate_sliding(const SlidingState &state, Evaluation &found) const
    {
      of_levers(state, found,
                [&](const unsigned int lever, const SlidingState &own)
                { contact[lever]->evaluate_sliding(own, found.of_lever[lever]); });
    }

    PortPerturbation linearise(const SlidingState &state, Evaluation &found) const
    {
      std::array<PortPerturbation, 2> own;
      of_levers(state, found,
                [&](const unsigned int lever, const SlidingState &sliding)
                { own[lever] = contact[lever]->linearise(sliding, found.of_lever[lever]); });
      PortPerturbation result(found.forces.ports);
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        for (auto &port : own[lever].ports)
          port = joined_port(layout, lever, port);
        result.add(own[lever]);
      }
      return result;
    }

    const PortSelection &reachable_ports(const double x, const OfLevers &theta)
    {
      reachable.clear();
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const unsigned int port : contact[lever]->reachable_ports(x, { { theta[lever] } }))
          if (port < layout.of_a_lever())
            reachable.push_back(layout.first(lever) + port);
      if (layout.sprung)
        reachable.push_back(layout.support());
      return reachable;
    }

    void widen_reach()
    {
      for (const auto &of_lever : contact)
        of_lever->widen_reach();
    }

    auto touch(const dealii::Vector<double> &ports, const DrivePoint &drive, Evaluation &found) const
    {
      const auto of_lever = [&](const unsigned int lever)
      { return contact[lever]->touch(ports_of(lever, ports), drive, found.of_lever[lever]); };
      const auto first  = of_lever(0);
      const auto memory = joined_memory(points, first, of_lever(1));
      join(found);
      return memory;
    }

    double gap_change(const Evaluation &found, const dealii::Vector<double> &change_of_ports, const unsigned int lever) const
    {
      return contact[lever]->gap_change(found.of_lever[lever], ports_of(lever, change_of_ports));
    }

    /// Mean slip of the first lever [mm].
    double mean_slip(const Evaluation &found, const dealii::Vector<double> &from, const double from_x,
                     const dealii::Vector<double> &to, const double to_x) const
    {
      return contact[0]->mean_slip(found.of_lever[0], ports_of(0, from), from_x, ports_of(0, to), to_x);
    }

    void observe(const Evaluation &found, Row &row, const unsigned int lever) const
    {
      contact[lever]->observe(found.of_lever[lever], row);
    }

    double drive_force(const Evaluation &found) const
    {
      return contact[0]->drive_force(found.of_lever[0]) + contact[1]->drive_force(found.of_lever[1]);
    }

    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, const unsigned int lever) const
    {
      return contact[lever]->surface_shape(ports_of(lever, displacements));
    }

    /// Points of the face of either lever.
    FacePoints face_points() const
    {
      return contact[0]->face_points();
    }
    FaceState face_state(const Evaluation &found, const DrivePoint &drive) const
    {
      return joined_faces(contact[0]->face_state(found.of_lever[0], drive), contact[1]->face_state(found.of_lever[1], drive));
    }

    void visit_history(Archive &archive)
    {
      for (const auto &of_lever : contact)
        of_lever->visit_history(archive);
    }

  private:
    const std::array<std::unique_ptr<Contact>, 2> contact;
    const PortLayout layout;
    const unsigned int points;
    PortSelection reachable;

    dealii::Vector<double> ports_of(const unsigned int lever, const dealii::Vector<double> &of_pair) const
    {
      return ports_of_lever(layout, lever, of_pair);
    }

    /// Evaluates both contacts, each at its own ports.
    template <class Evaluate>
    void of_levers(const SlidingState &state, Evaluation &found, const Evaluate &evaluate) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto ports = ports_of(lever, state.ports);
        const auto rates = state.rates != nullptr ? ports_of(lever, *state.rates) : dealii::Vector<double>();
        evaluate(lever, SlidingState{ ports, state.drive, state.speed, state.rates != nullptr ? &rates : nullptr, state.friction,
                                      state.wanted, state.friction_share });
      }
      join(found);
    }

    void join(Evaluation &found) const
    {
      const auto &of = found.of_lever;
      join_forces(layout, { &of[0].forces, &of[1].forces }, found.forces);
      found.within_reach = of[0].within_reach && of[1].within_reach;
      found.points       = points;
    }
  };
} // namespace sprag
