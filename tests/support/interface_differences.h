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
  void expect_tangent_parts(Contact &contact, const dealii::Vector<double> &displacements, const double skewness,
                            const double x = 0.)
  {
    const DrivePoint drive{ 0., x, 100., 0. };
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

  /// Tests the linearised forces of a slide at x against steps from it, all weight on their ends. At every point the return to
  /// the cone of stick is Euler's backward rule for the delay, (1 + time/dt) tau = stiffness_row . z + rate_row . z/dt.
  /// Differences are over `size`(dof), dofs without one are left out.
  template <class Contact, class Size>
  void expect_delays_as_in_steps(Contact &contact, const dealii::Vector<double> &at, const double x, const double tolerance,
                                 const Size &size)
  {
    for (const double speed : { 100., -100. })
      for (const double dt : { 1e-5, 1e-4 })
      {
        typename Contact::Evaluation found;
        const DrivePoint from{ 0., x, speed, 0. }, to{ dt, x, 0., 0., speed * dt };
        const auto linear = contact.linearise({ at, from, speed }, found);
        ASSERT_GT(linear.delays.size(), 10u);
        const auto history = found.history();
        auto exact         = linear.immediate_stiffness();
        exact.add(1. / dt, linear.immediate_damping());
        double longest = 0.;
        for (const auto &delay : linear.delays)
        {
          longest = std::max(longest, delay.time);
          for (unsigned int i = 0; i < exact.m(); ++i)
            for (unsigned int j = 0; j < exact.n(); ++j)
              exact(i, j) += delay.force[i] * (delay.stiffness_row[j] + delay.rate_row[j] / dt) / (1. + delay.time / dt);
        }
        EXPECT_GT(longest, 1e-5);
        const dealii::Vector<double> rest(at.size());
        const Kinematic begin{ at, rest, rest };
        const auto moved = [&](const unsigned int dof, const double by)
        {
          auto end  = at;
          auto rate = rest;
          end[dof] += by;
          rate[dof] = by / dt;
          contact.evaluate(InterfaceStep{ from, history, to, begin, end, rate, { dt, 0., 0., 0.25, 0.5 } }, found);
          return found.forces;
        };
        const double largest = exact.linfty_norm();
        for (unsigned int j = 0; j < linear.dofs.size(); ++j)
        {
          const double h = size(linear.dofs[j]);
          if (h == 0.)
            continue;
          const auto right = moved(linear.dofs[j], h);
          const auto left  = moved(linear.dofs[j], -h);
          ASSERT_EQ(right.dofs, linear.dofs);
          for (unsigned int i = 0; i < linear.dofs.size(); ++i)
            if (size(linear.dofs[i]) != 0.)
              EXPECT_NEAR(exact(i, j), (right.values[i] - left.values[i]) / (2. * h), tolerance * largest)
                  << speed << " " << i << " " << j;
        }
      }
  }
} // namespace sprag
