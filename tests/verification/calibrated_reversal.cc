// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"
#include "input/read.h"
#include "levers/dynamics.h"
#include "levers/prepared_scene.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "support/params_folder.h"
#include "verification/run_transient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene calibration(const std::string &model)
  {
    const auto file = params_folder() / ("calibration-" + model + ".prm");
    return read_scene(file.string());
  }

  double peak_P(const Scene &scene)
  {
    const auto dynamics = DynamicsMaker(false).make(scene);
    double peak         = 0.;
    for (const auto &row : run_in_time(dynamics.model(), scene).rows)
      peak = std::max(peak, row[Column::P]);
    return peak;
  }

  /// Returns the two lowest frequencies of vibration in contact without friction [Hz].
  std::array<double, 2> contact_frequencies(const Scene &scene)
  {
    const auto dynamics = DynamicsMaker(false).make(scene);
    const auto slide    = dynamics.model().hold(held_drive(scene), ContactFriction::none);
    EXPECT_TRUE(slide);
    std::vector<double> found;
    for (const auto &mode : dynamics.model().vibrations(*slide, true, 2))
      if (mode.mode.eigenvalue.imag() > 0.)
        found.push_back(mode.mode.eigenvalue.imag() / (2. * M_PI));
    std::sort(found.begin(), found.end());
    return { { found.at(0), found.at(1) } };
  }
} // namespace

/// The leaf spring's own vibrations included, which ring with the lever. What is asked for is 3 %; statics and frequencies agree
/// to 0.5 %, and the peak follows the first swing after the reversal.
TEST(CalibratedReversal, TheBeamsPeakIsThatOfTheMeshSlow)
{
  for (const std::string model : { "a", "b" })
  {
    const auto parts = calibrate_parts(calibration(model));
    auto beam        = reduced_constants(parts.scene).overrides;
    beam.push_back("Analysis/Type=transient");
    const double mesh_result = peak_P(prepared(variant(parts.scene, { "Analysis/Type=transient", "Analysis/Model=condensed" })));
    const double beam_result = peak_P(prepared(variant(parts.scene, beam)));
    EXPECT_NEAR(beam_result, mesh_result, 1e-2 * mesh_result) << model;
  }
}

/// All degrees of freedom in time. A condensed lever has them to 1e-5 in the frequencies and 2e-4 in P. Cells of 0.5 mm raise the
/// frequencies by 0.3 %, which the peak does not feel.
TEST(CalibratedReversal, SlowTheBeamIsThatOfTheFullFiniteElements)
{
  const auto parts = calibrate_parts(calibration("a"));
  auto beam        = reduced_constants(parts.scene).overrides;
  beam.push_back("Analysis/Type=transient");
  const Scene reduced    = prepared(variant(parts.scene, beam));
  const Scene meshed     = prepared(variant(parts.scene, { "Analysis/Type=transient", "Analysis/Model=finite element" }));
  const auto beam_result = contact_frequencies(reduced);
  const auto mesh_result = contact_frequencies(meshed);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(beam_result[i], mesh_result[i], 5e-3 * mesh_result[i]);
  const double peak = peak_P(prepared(variant(meshed, { "Mesh/Face size=0.5" })));
  EXPECT_NEAR(peak_P(reduced), peak, 1e-2 * peak);
}
