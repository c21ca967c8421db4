#pragma once

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
    static constexpr bool stands_for_layer = Contact::stands_for_layer;
    static constexpr unsigned int levers   = 2;

    /// `layout` is the pair's; memories of a contact number fewer than `points`.
    MirroredContact(std::array<std::unique_ptr<Contact>, 2> contacts, const PortLayout &layout_, const unsigned int points_)
        : contact(std::move(contacts))
        , layout(layout_)
        , points(points_)
    {
    }

    void evaluate(const PortStep &step)
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto memory = memory_of_lever(lever, points, step.memory);
        const Kinematic begin{ ports_of(lever, step.begin.position), ports_of(lever, step.begin.velocity),
                               ports_of(lever, step.begin.acceleration) };
        const auto end  = ports_of(lever, step.end);
        const auto rate = ports_of(lever, step.end_rate);
        contact[lever]->evaluate(PortStep{ step.from, memory, step.to, begin, end, rate, step.weights });
      }
      join_forces();
    }

    void evaluate_sliding(const SlidingState &state)
    {
      of_levers(state, [&](const unsigned int lever, const SlidingState &own) { contact[lever]->evaluate_sliding(own); });
    }

    PortPerturbation linearise(const SlidingState &state)
    {
      std::array<PortPerturbation, 2> own;
      of_levers(state,
                [&](const unsigned int lever, const SlidingState &sliding) { own[lever] = contact[lever]->linearise(sliding); });
      PortPerturbation result(joined.ports);
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        for (auto &port : own[lever].ports)
          port = joined_port(layout, lever, port);
        result.add(own[lever]);
      }
      return result;
    }

    const PortForces &forces() const
    {
      return joined;
    }

    const PortSelection &reachable_ports(const double x, const OfLevers &theta)
    {
      reachable.clear();
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const unsigned int port : contact[lever]->reachable_ports(x, theta[lever]))
          if (port < layout.of_a_lever())
            reachable.push_back(layout.first(lever) + port);
      if (layout.sprung)
        reachable.push_back(layout.support());
      return reachable;
    }

    bool within_reach() const
    {
      return contact[0]->within_reach() && contact[1]->within_reach();
    }

    void widen_reach()
    {
      for (const auto &of_lever : contact)
        of_lever->widen_reach();
    }

    std::vector<ContactMemory> memory() const
    {
      return joined_memory(points, { { contact[0]->memory(), contact[1]->memory() } });
    }

    std::vector<ContactMemory> touch(const dealii::Vector<double> &ports, const DrivePoint &drive)
    {
      return joined_memory(points,
                           { { contact[0]->touch(ports_of(0, ports), drive), contact[1]->touch(ports_of(1, ports), drive) } });
    }

    void add_work(StepWork &work) const
    {
      for (const auto &of_lever : contact)
        of_lever->add_work(work);
    }

    double energy() const
    {
      return contact[0]->energy() + contact[1]->energy();
    }

    double overlap() const
    {
      return std::max(contact[0]->overlap(), contact[1]->overlap());
    }

    double gap_change(const dealii::Vector<double> &change_of_ports, const unsigned int lever) const
    {
      return contact[lever]->gap_change(ports_of(lever, change_of_ports));
    }

    /// Mean slip of the first lever [mm].
    double mean_slip(const dealii::Vector<double> &from, const double from_x, const dealii::Vector<double> &to,
                     const double to_x) const
    {
      return contact[0]->mean_slip(ports_of(0, from), from_x, ports_of(0, to), to_x);
    }

    void observe(Row &row, const unsigned int lever) const
    {
      contact[lever]->observe(row);
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
    FaceState face_state(const DrivePoint &drive) const
    {
      return joined_faces(contact[0]->face_state(drive), contact[1]->face_state(drive));
    }

  private:
    const std::array<std::unique_ptr<Contact>, 2> contact;
    const PortLayout layout;
    const unsigned int points;
    PortForces joined;
    PortSelection reachable;

    dealii::Vector<double> ports_of(const unsigned int lever, const dealii::Vector<double> &of_pair) const
    {
      return ports_of_lever(layout, lever, of_pair);
    }

    /// Evaluates both contacts, each at its own ports.
    template <class Evaluate>
    void of_levers(const SlidingState &state, const Evaluate &evaluate)
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto ports = ports_of(lever, state.ports);
        const auto rates = state.rates != nullptr ? ports_of(lever, *state.rates) : dealii::Vector<double>();
        evaluate(lever,
                 SlidingState{ ports, state.drive, state.speed, state.rates != nullptr ? &rates : nullptr, state.friction });
      }
      join_forces();
    }

    void join_forces()
    {
      joined = joined_forces(layout, { &contact[0]->forces(), &contact[1]->forces() });
    }
  };
} // namespace sprag
