// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "fe/statics/static_lever.h"
#include "scene/scene.h"
#include "verification/block.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <utility>

namespace sprag
{
  /// A rigid plane at height y(x), its material at xi = c(x).
  inline Counterface rigid_plane(std::function<double(double)> height, std::function<double(double)> place)
  {
    return [=](const double x, double)
    {
      return [eta = height(x), xi = place(x)](const LeverPoint &point)
      {
        ContactKinematics<4> result;
        result.gap         = point.eta - eta;
        result.gap_row[1]  = 1.;
        result.slip        = point.xi - xi;
        result.slip_row[0] = 1.;
        return result;
      };
    };
  }

  /// A rigid circle whose centre moves over x. The body's axes rest.
  inline Counterface rigid_circle(const double radius, std::function<LeverPoint(double)> centre)
  {
    return [=](const double x, double)
    {
      return [=, at = centre(x)](const LeverPoint &point)
      {
        const Geometry geometry = { radius, 0., at.xi, -at.eta };
        auto result             = moving_circle_contact(placed_for_points(geometry, 0., 0.), point);
        for (const unsigned int i : { 2, 3 })
        {
          result.gap_row[i] = result.slip_row[i] = 0.;
          for (unsigned int j = 0; j < 4; ++j)
          {
            result.gap_curvature[i][j] = result.gap_curvature[j][i] = 0.;
            result.slip_curvature[i][j] = result.slip_curvature[j][i] = 0.;
          }
        }
        return result;
      };
    };
  }

  /// A block, see make_block(), against an counterface, its axes held.
  inline LeverProperties block_properties(Counterface counterface, const double coefficient)
  {
    LeverProperties result;
    result.body.plane  = PlaneState::strain;
    result.counterface = std::move(counterface);
    result.ideal_theta = [](double) { return 0.; };
    result.centre      = [](double, double) { return LeverPoint{ 0., 0. }; };
    result.spring      = { MomentLaw(1e9), 0., 1. };
    result.friction    = { CoulombFriction{ coefficient }, FrictionSpeed::sliding };
    return result;
  }

  /// Equilibrium from the coordinates of the trial state; if it is not found so, from the stick predictor.
  inline NewtonSolution<Evaluation> equilibrate(Model &model, Step &step)
  {
    const State guess = step.trial;
    auto result       = solve_equilibrium(model, step, false);
    if (result.converged)
      return result;
    step.trial = guess;
    return solve_equilibrium(model, step, true);
  }

  /// The accepted state at drive position x (also its time), from `accepted`; augments where `model` has multipliers.
  inline Equilibrium step_to(Model &model, const State &accepted, const double x, const ContactSettings &contact)
  {
    Step step   = model.begin_step(accepted, { x, x, 1. });
    auto solved = equilibrate(model, step);
    EXPECT_TRUE(solved.converged) << "x " << x;
    if (contact.enforcement == Enforcement::augmented_lagrangian)
      for (unsigned int i = 0; model.penetration(solved.found) > contact.penetration_tolerance; ++i)
      {
        model.augment(solved.found, step.trial);
        solved               = equilibrate(model, step);
        const bool converged = i < contact.maximum_augmentations && solved.converged;
        EXPECT_TRUE(converged) << "x " << x << ", penetration " << model.penetration(solved.found);
        if (!converged)
          break;
      }
    model.store_history(solved.found, step.trial);
    return { std::move(step.trial), std::move(solved.found) };
  }

  /// A profile along the face: position, pressure and traction of the points under pressure.
  struct FaceProfile
  {
    std::vector<double> xi, pressure, traction;
  };

  inline FaceProfile profile(const Model &model, const Equilibrium &at)
  {
    const auto points = model.face_points();
    const auto face   = model.face_state(at.state, at.found);
    FaceProfile result;
    for (std::size_t q = 0; q < points.xi.size(); ++q)
      if (face.pressure[q] > 0.)
      {
        result.xi.push_back(points.xi[q]);
        result.pressure.push_back(face.pressure[q]);
        result.traction.push_back(face.traction[q]);
      }
    return result;
  }
} // namespace sprag
