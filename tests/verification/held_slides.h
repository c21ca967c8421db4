// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/limit_cycle/limit_cycle.h"
#include "mpi_environment.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "verification/run_transient.h"

#include <gtest/gtest.h>

namespace sprag
{
  /// A scene's model with its slide checked.
  struct JudgedSlide
  {
    Scene scene;
    Dynamics dynamics;
    SlideStability stability;

    explicit JudgedSlide(const Scene &scene_)
        : scene(held_scene(scene_))
        , dynamics(DynamicsMaker().make(scene))
        , stability(check_slide(dynamics.model(), held_drive(scene), with_shapes(checked_modes(scene))))
    {
    }

    const HeldSlide &slide() const
    {
      return *stability.slide;
    }

    const Eigenmode &mode() const
    {
      return watched_mode(stability);
    }

    double step() const
    {
      return choose_step(mode(), scene.sprag_slip);
    }

    /// Checks the slide at another x with the same model.
    SlideStability checked_at(const double x) const
    {
      DrivePoint there = held_drive(scene);
      there.x          = x;
      return check_slide(dynamics.model(), there, with_shapes(checked_modes(scene)));
    }
  };

  /// A perturbation of a slide that flutters grows at the rate of its eigenvalue, up to the error of steps and of a nonlinear
  /// contact.
  inline void expect_predicted_growth(const JudgedSlide &checked)
  {
    ASSERT_EQ(checked.stability.kind, SlideKind::flutter);
    HeldRun run(checked.dynamics.model(), checked.step());
    const auto ignore = [](const Row &) {};
    const auto growth = measure_growth(checked.dynamics.model(), checked.stability, checked.scene.sprag_slip, run, ignore);
    EXPECT_TRUE(growth.reached);
    EXPECT_TRUE(growth.slid);
    EXPECT_NEAR(growth.growth_difference(), 0., 0.003);
    EXPECT_NEAR(growth.frequency_difference(), 0., 0.0005);
  }

  inline Scene held_at(Scene scene, const double x)
  {
    scene.stability.position = x;
    return scene;
  }

  /// Model A moving back at x = 65: flutter with the lever of 6 mm, stable with that of 20 mm.
  inline Scene backward_a(const ModelType model, const double depth)
  {
    Scene scene          = with_lever(with_coulomb(in_time(model_a(), model), 0.73), depth, 13068.5, 1.50185);
    scene.mesh.face_size = 2.;
    return held_at(scene, 65.);
  }

  /// Model B moving back at x = 44 with a lever of 12 mm on a stiff contact: flutter.
  inline Scene backward_b()
  {
    return held_at(with_lever(with_coulomb(in_time(model_b(), ModelType::beam), 0.73), 12., 1e4, 1.), 44.);
  }
} // namespace sprag
