// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_forces.h"
#include "model/step/linearisation.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace sprag
{
  /// Largest difference between the tangent and divided differences of the forces, over the largest entry. `evaluate` sets the
  /// forces to those at the displacements.
  template <class Evaluate>
  double tangent_error(const InterfaceForces &forces, dealii::Vector<double> &displacements, const Evaluate &evaluate)
  {
    evaluate();
    const InterfaceForces at = forces;
    double largest           = 0.;
    double error             = 0.;
    for (unsigned int j = 0; j < at.dofs.size(); ++j)
    {
      const double h    = 1e-7;
      const double from = displacements[at.dofs[j]];
      dealii::Vector<double> difference;
      for (const double sign : { 1., -1. })
      {
        displacements[at.dofs[j]] = from + sign * h;
        evaluate();
        EXPECT_EQ(forces.dofs, at.dofs);
        if (sign > 0.)
          difference = forces.values;
        else
          difference -= forces.values;
      }
      displacements[at.dofs[j]] = from;
      for (unsigned int i = 0; i < at.dofs.size(); ++i)
      {
        largest = std::max(largest, std::abs(at.tangent(i, j)));
        error   = std::max(error, std::abs(difference[i] / (2. * h) - at.tangent(i, j)));
      }
    }
    evaluate();
    return error / largest;
  }

  /// That the parts of a slide's tangent, summed apart, are what Newton's method is given, and that the pressure's is symmetric,
  /// up to a share of the tangent.
  template <class Contact>
  void expect_tangent_parts(Contact &contact, const dealii::Vector<double> &displacements, const double skewness)
  {
    const DrivePoint drive{ 0., 0., 100., 0. };
    for (const auto friction : { ContactFriction::sliding, ContactFriction::none, ContactFriction::stuck })
    {
      const SlidingState state{ displacements, drive, 100., nullptr, friction };
      typename Contact::Evaluation found;
      contact.evaluate_sliding(state, found);
      const auto tangent   = found.forces.tangent;
      const auto linear    = contact.linearise(state, found);
      const double largest = tangent.frobenius_norm();
      auto rest            = tangent;
      rest.add(-1., linear.stiffness());
      EXPECT_LT(rest.frobenius_norm(), 1e-12 * largest);
      rest = linear.pressure;
      rest.Tadd(-1., linear.pressure);
      EXPECT_LT(rest.frobenius_norm(), skewness * largest);
      EXPECT_EQ(linear.friction.frobenius_norm() > 1e-3 * largest, friction != ContactFriction::none);
      EXPECT_EQ(linear.friction_rate.frobenius_norm() > 0., friction == ContactFriction::sliding);
      EXPECT_EQ(linear.delays.empty(), friction != ContactFriction::sliding);
    }
  }
} // namespace sprag
