// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/solid_run.h"

using namespace sprag;

namespace
{
  Scene frame(const double web)
  {
    Scene scene         = solid_model_a(0.);
    scene.lever.outline = LeverOutline::frame;
    scene.frame.web     = web;
    return scene;
  }
} // namespace

// Flanges rest on a web a quarter as wide, in their middle: beside it they yield, which the plane does not know. The frame is
// softer than the plane's: P changes by 3e-4 at most and its peak falls by 7e-5. With holes both are the same.
TEST(SolidFrame, AWebInTheMiddleIsSofterThanThePlanesSlow)
{
  const auto loss = [](const double web)
  {
    const Scene scene = frame(web);
    const SolidRun solid(scene);
    const auto rows = run_scene(in_plane(scene));
    EXPECT_LT(solid.exactness.displacement, 5e-5) << web;
    EXPECT_LT(difference(rows, solid.rows, Column::P), 1e-3) << web;
    return 1. - largest(solid.rows, Column::P) / largest(rows, Column::P);
  };
  for (const double whole : { 0., 40. })
    EXPECT_LT(std::abs(loss(whole)), 3e-6);
  EXPECT_GT(loss(10.), 3e-5);
}
