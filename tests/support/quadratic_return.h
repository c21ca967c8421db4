// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/model.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace sprag
{
  // From h away from an equilibrium along a direction of movement 1 a consistent correction returns but for a share of it
  // proportional to h, as long as no point changes between stick, slip and separation. Points are 0.01 mm apart and the
  // penetration (some 1e-3 mm) falls to 0 along the circle (56 mm) at a slope of 1e-2: within 1e-5 mm no more than a point in a
  // hundred changes, and its pressure is then small. A tangent wrong in one term leaves a share that does not depend on h.
  inline void expect_quadratic_return(Model &model, const State &equilibrium, const State &accepted,
                                      const dealii::Vector<double> &direction)
  {
    for (const double h : { 1e-6, 1e-7 })
    {
      Step step  = model.begin_step(accepted, equilibrium.drive);
      step.trial = equilibrium;
      auto moved = direction; // of dofs that are not looked at nothing comes back
      for (unsigned int i = 0; i < moved.size() && !step.near.empty(); ++i)
        if (!std::binary_search(step.near.begin(), step.near.end(), i))
          moved[i] = 0.;
      step.trial.coordinates.add(h, moved);
      dealii::Vector<double> left = model.correction(model.evaluate(step, FrictionMode::cone));
      left.add(h, moved);
      EXPECT_LE(model.movement(left), (5e3 * h + 1e-12 / h) * h) << "h " << h;
    }
  }
} // namespace sprag
