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
  /// A block, see make_block(), its hub held. Below its face lies a rigid circle that touches it at x = 0 and moves into it by x:
  /// the axes of the block are turned by a right angle.
  inline LeverProperties block_properties(const double radius, const double coefficient)
  {
    LeverProperties result;
    result.body.plane  = PlaneState::strain;
    result.geometry    = { radius, 0., radius, 0. };
    result.centre      = [radius](const double x, double) { return LeverPoint{ 0., x - radius }; };
    result.ideal_theta = [](double) { return 0.5 * M_PI; };
    result.spring      = { MomentLaw(1e9), 0.5 * M_PI, 1. };
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

  /// The accepted state at a drive position x from `accepted`, with the path of the counterface's surface by turning [mm]; their
  /// sum counts as time. Augments where `model` has multipliers.
  inline Equilibrium step_to(Model &model, const State &accepted, const double x, const ContactSettings &contact,
                             const double surface = 0.)
  {
    Step step   = model.begin_step(accepted, { x + surface, x, 1., 0., surface });
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

  /// A block or two that are pressed together by a depth in a few steps, without friction.
  struct PressedBlock
  {
    FaceProfile face;
    double load;       ///< per length out of plane [N/mm]
    double half_width; ///< [mm]

    double largest_pressure() const
    {
      return *std::max_element(face.pressure.begin(), face.pressure.end());
    }
  };

  inline PressedBlock pressed(const Mesh &mesh, const LeverProperties &properties, const double depth)
  {
    StaticLever<2> model(mesh, properties);
    Equilibrium at{ model.initial_state({ 0., 0., 1. }), {} };
    for (const double share : { 0.5, 0.75, 1. })
      at = step_to(model, at.state, share * depth, properties.contact);
    Row row;
    model.observe(at.state, at.found, row);
    return { profile(model, at), row[Column::P] / properties.body.width, 0.5 * row[Column::contact_width] };
  }
} // namespace sprag
