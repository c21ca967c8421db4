#pragma once

#include "model/port_forces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace sprag
{
  /// Of constant forces on ports that move.
  inline double work_of(const PortForces &forces, const dealii::Vector<double> &from, const dealii::Vector<double> &to)
  {
    double sum = 0.;
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      sum += forces.values[a] * (to[forces.ports[a]] - from[forces.ports[a]]);
    return sum;
  }

  /// Largest difference between the tangent and divided differences of the forces, over the largest entry. `evaluate` sets the
  /// contact's forces at the ports.
  template <class Contact, class Evaluate>
  double tangent_error(const Contact &contact, dealii::Vector<double> &ports, const Evaluate &evaluate)
  {
    evaluate();
    const PortForces at = contact.forces();
    double largest      = 0.;
    double error        = 0.;
    for (unsigned int j = 0; j < at.ports.size(); ++j)
    {
      const double h    = 1e-7;
      const double from = ports[at.ports[j]];
      dealii::Vector<double> difference;
      for (const double sign : { 1., -1. })
      {
        ports[at.ports[j]] = from + sign * h;
        evaluate();
        EXPECT_EQ(contact.forces().ports, at.ports);
        if (sign > 0.)
          difference = contact.forces().values;
        else
          difference -= contact.forces().values;
      }
      ports[at.ports[j]] = from;
      for (unsigned int i = 0; i < at.ports.size(); ++i)
      {
        largest = std::max(largest, std::abs(at.tangent(i, j)));
        error   = std::max(error, std::abs(difference[i] / (2. * h) - at.tangent(i, j)));
      }
    }
    evaluate();
    return error / largest;
  }
} // namespace sprag
