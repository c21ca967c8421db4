#pragma once

#include "model/joined_memory.h"
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
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto ports = ports_of(lever, state.ports);
        const auto rates = state.rates != nullptr ? ports_of(lever, *state.rates) : dealii::Vector<double>();
        contact[lever]->evaluate_sliding(SlidingState{ ports, state.drive, state.speed, state.rates != nullptr ? &rates : nullptr,
                                                       state.friction, state.part });
      }
      join_forces();
    }

    const PortForces &forces() const
    {
      return joined;
    }

    std::vector<FrictionDelay> friction_delays() const
    {
      std::vector<FrictionDelay> result;
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const auto &delay : contact[lever]->friction_delays())
          result.push_back({ delay.time, joined_row(lever, delay.force), joined_row(lever, delay.stiffness_row),
                             joined_row(lever, delay.rate_row) });
      return result;
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

    /// Of the first lever.
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

    /// Of either lever.
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
      if (of_pair.size() == 0)
        return {};
      const unsigned int n = layout.of_a_lever();
      dealii::Vector<double> result(n + (layout.sprung ? 1 : 0));
      std::copy_n(of_pair.begin() + layout.first(lever), n, result.begin());
      if (layout.sprung)
        result[n] = of_pair[layout.support()];
      return result;
    }

    unsigned int port_of_pair(const unsigned int lever, const unsigned int port) const
    {
      return port < layout.of_a_lever() ? layout.first(lever) + port : layout.support();
    }

    void join_forces()
    {
      std::vector<unsigned int> ports;
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const unsigned int port : contact[lever]->forces().ports)
          ports.push_back(port_of_pair(lever, port));
      std::sort(ports.begin(), ports.end());
      ports.erase(std::unique(ports.begin(), ports.end()), ports.end());
      const auto n = static_cast<unsigned int>(ports.size());
      joined       = { std::move(ports), dealii::Vector<double>(n), dealii::FullMatrix<double>(n, n) };
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto &of_lever = contact[lever]->forces();
        const auto places    = places_of(lever);
        for (unsigned int a = 0; a < places.size(); ++a)
        {
          joined.values[places[a]] += of_lever.values[a];
          for (unsigned int b = 0; b < places.size(); ++b)
            joined.tangent(places[a], places[b]) += of_lever.tangent(a, b);
        }
      }
    }

    /// Of a lever's forces among the joined ones.
    std::vector<unsigned int> places_of(const unsigned int lever) const
    {
      std::vector<unsigned int> result;
      for (const unsigned int port : contact[lever]->forces().ports)
        result.push_back(place_of(port_of_pair(lever, port), joined.ports));
      return result;
    }

    dealii::Vector<double> joined_row(const unsigned int lever, const dealii::Vector<double> &row) const
    {
      const auto places = places_of(lever);
      dealii::Vector<double> result(static_cast<unsigned int>(joined.ports.size()));
      for (unsigned int a = 0; a < places.size(); ++a)
        result[places[a]] = row[a];
      return result;
    }
  };
} // namespace sprag
