#pragma once

#include "model/linearisation.h"
#include "model/port_layout.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  // What a contact of one lever and that of a pair, see MirroredContact, are asked differently. `lever` is 0, or 1 of a pair.

  /// At x from the pivot frame's origin and inclinations theta.
  template <class Contact>
  const PortSelection &reachable_ports(Contact &contact, const double x, const OfLevers &theta)
  {
    if constexpr (Contact::levers == 1)
      return contact.reachable_ports(x, theta.front());
    else
      return contact.reachable_ports(x, theta);
  }

  template <class Contact>
  double gap_change(const Contact &contact, [[maybe_unused]] const unsigned int lever,
                    const dealii::Vector<double> &change_of_ports)
  {
    if constexpr (Contact::levers == 1)
      return contact.gap_change(change_of_ports);
    else
      return contact.gap_change(change_of_ports, lever);
  }

  template <class Contact>
  void observe_contact(const Contact &contact, [[maybe_unused]] const unsigned int lever, Row &row)
  {
    if constexpr (Contact::levers == 1)
      contact.observe(row);
    else
      contact.observe(row, lever);
  }

  template <class Contact>
  SurfaceShape surface_shape(const Contact &contact, [[maybe_unused]] const unsigned int lever,
                             const dealii::Vector<double> &ports)
  {
    if constexpr (Contact::levers == 1)
      return contact.surface_shape(ports);
    else
      return contact.surface_shape(ports, lever);
  }

  /// Absolute value of the largest change of a lever's gap by a small change of the ports.
  template <class Contact>
  double largest_gap_change(const Contact &contact, const dealii::Vector<double> &change_of_ports)
  {
    double largest = 0.;
    for (unsigned int lever = 0; lever < Contact::levers; ++lever)
      largest = std::max(largest, std::abs(gap_change(contact, lever, change_of_ports)));
    return largest;
  }

  /// Change of the gap that a complex change of the ports moves most.
  template <class Contact>
  std::complex<double> largest_gap_change(const Contact &contact, const ComplexVector &change_of_ports)
  {
    std::complex<double> largest;
    for (unsigned int lever = 0; lever < Contact::levers; ++lever)
    {
      const std::complex<double> gap(gap_change(contact, lever, change_of_ports[0]),
                                     gap_change(contact, lever, change_of_ports[1]));
      if (std::abs(gap) > std::abs(largest))
        largest = gap;
    }
    return largest;
  }
} // namespace sprag
