// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/model_correction.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"
#include "levers/dynamics.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <array>

namespace sprag
{
  namespace
  {
    constexpr unsigned int places = 24; ///< over the drive, each way

    /// P and Q over x, one way.
    std::array<MonotoneCubic, 2> differences(const Scene &scene, DynamicModel &model, const double v)
    {
      const double from = scene.drive.minimum();
      const double to   = scene.drive.maximum();
      std::vector<double> x, P, Q;
      if (from == 0.) // where nothing presses
      {
        x.push_back(0.);
        P.push_back(0.);
        Q.push_back(0.);
      }
      for (unsigned int i = 1; i <= places; ++i)
      {
        const DrivePoint drive{ 0., from + (to - from) * i / places, v, 0. };
        const auto found = model.sliding_forces(drive);
        if (!found)
          throw AnalysisError("the model has no steady slide at x = " + mm(drive.x) + (v < 0. ? " backward" : " forward") +
                              ", so that it cannot correct the closed form: take Analysis/Model = closed form");
        const auto closed = closed_form(scene, drive.x, v);
        x.push_back(drive.x);
        P.push_back(found->P - closed.P);
        Q.push_back(found->Q - closed.Q);
      }
      return { { MonotoneCubic(x, P), MonotoneCubic(x, Q) } };
    }
  } // namespace

  ModelCorrection model_correction(const Scene &scene, const double peak_speed)
  {
    if (!identifies_by_model(scene))
      return [](double, int) { return ForceDifference{}; };
    Scene held             = scene;
    held.stability.damping = false;
    held                   = held_scene(held);
    const auto dynamics    = DynamicsMaker(false).make(held);
    const auto forward     = differences(scene, dynamics.model(), peak_speed);
    const auto back        = differences(scene, dynamics.model(), -peak_speed);
    return [forward, back](const double x, const int direction)
    {
      const auto &way = direction > 0 ? forward : back;
      return ForceDifference{ way[0].value(x), way[1].value(x) };
    };
  }
} // namespace sprag
