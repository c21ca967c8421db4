// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"

#include "base/errors.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "scene/scene.h"
#include "support/shipped.h"
#include "support/thrown.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Scene of params for model A or B, on a coarse mesh.
  Scene calibration(const std::string &model, std::vector<std::string> changes = {})
  {
    changes.push_back("Mesh/Face size=1");
    return shipped("calibration-" + model, changes);
  }

  std::string refusal(const Scene &scene)
  {
    return thrown_text([&] { calibrate_parts(scene); });
  }

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

TEST(Calibration, TheLeafsThicknessMeetsK)
{
  for (const auto &[model, k] : { std::pair<std::string, double>{ "a", 7.40e4 }, { "b", 6.41e4 } })
  {
    const auto parts = calibrate_parts(calibration(model));
    ASSERT_TRUE(parts.thickness);
    EXPECT_NEAR(parts.scene.spring.stiffness, k, 1e-9 * k);
    // k = 4 EI/L of a beam; its shear and the clamps, which hinder Poisson's contraction, change k by less than 1e-3.
    const auto &leaf  = parts.scene.spring.leaf;
    const double beam = std::cbrt(3. * k * leaf.length / (leaf.young_modulus * leaf.width));
    EXPECT_NEAR(*parts.thickness, beam, 3e-4 * beam);
  }
}

TEST(Calibration, AddedMassMeetsJSlow)
{
  for (const auto &[model, J] : { std::pair<std::string, double>{ "a", 6.45 }, { "b", 6.86 } })
    for (const std::string place : { "hub", "tip" })
    {
      const auto parts = calibrate_parts(calibration(model, { "Calibration/Mass=" + place }));
      ASSERT_TRUE(parts.added);
      EXPECT_EQ(parts.scene.lever.inertia, InertiaSource::as_built);
      EXPECT_NEAR(reduced_constants(parts.scene).moment_of_inertia, J, 1e-10 * J);
      // The added inertia makes up for that of bar and layer alone; the leaf has 0.004 t mm^2, and a mesh's bar has depth.
      const auto &lever  = parts.scene.lever;
      const double L     = lever.length;
      const double e_a   = parts.scene.geometry.interface_offset + 1. + 0.5 * lever.depth;
      const double bar   = lever.width * (lever.depth * lever.density + 2e-10) * (L * L * L / 3. + L * e_a * e_a);
      const double added = place == "hub" ? lever.hub_inertia : lever.tip_mass * (L * L + e_a * e_a);
      EXPECT_NEAR(added, J - bar, 1e-2 * J);
    }
}

TEST(Calibration, TargetsThatCannotBeReachedAreRefused)
{
  const auto light = refusal(calibration("a", { "Calibration/Moment of inertia=3" }));
  EXPECT_TRUE(contains(light, "Calibration/Moment of inertia = 3 t mm2 cannot be reached: the parts as built have 4.")) << light;
  const auto stiff = refusal(calibration("a", { "Calibration/Stiffness=1e12" }));
  EXPECT_TRUE(contains(stiff, "Calibration/Stiffness = 1e+12 N mm/rad cannot be reached")) << stiff;
  const auto soft = refusal(calibration("a", { "Calibration/Stiffness=1e-3" }));
  EXPECT_TRUE(contains(soft, "cannot be reached")) << soft;
}

/// Round trip: k, J and the section of the bar come back from its mesh, and the beam made of them does what the mesh does.
TEST(Calibration, TheBeamOfAMeshDoesWhatTheMeshDoesSlow)
{
  for (const std::string model : { "a", "b" })
  {
    const auto parts   = calibrate_parts(calibration(model));
    const auto reduced = reduced_constants(parts.scene);
    const auto &lever  = parts.scene.lever;
    const double EI    = lever.young_modulus * lever.width * std::pow(lever.depth, 3) / 12.;
    // Shear adds some 3 (d / L)^2 / 4 E / (kappa G) to the deflection, 0.7 %.
    EXPECT_NEAR(reduced.bending.stiffness, EI, 1e-2 * EI);
    EXPECT_LT(reduced.bending.stiffness, EI);
    EXPECT_NEAR(reduced.bending.neutral_axis_offset, parts.scene.geometry.interface_offset + 1. + 0.5 * lever.depth,
                0.01 * lever.depth);

    const auto meshed = prepared(variant(parts.scene, { "Analysis/Type=transient", "Analysis/Model=condensed" }));
    auto changes      = reduced.overrides;
    changes.push_back("Analysis/Type=transient");
    const auto found = compare(meshed, prepared(variant(parts.scene, changes)));
    EXPECT_EQ(found.sliding.size(), 28u);
    // A single power law fits the layer to 0.25 %; friction shifts the layer's centre of pressure by some 0.1 mm, which the
    // beam's contact point knows nothing of: 1 % of Q (see tests/deviation.md).
    EXPECT_LT(found.force_deviation(0), 5e-3);
    EXPECT_LT(found.force_deviation(1), 1.5e-2);
    for (unsigned int i = 0; i < 2; ++i)
    {
      EXPECT_NEAR(found.free_frequencies[1][i], found.free_frequencies[0][i], 2e-3 * found.free_frequencies[0][i]);
      EXPECT_NEAR(found.contact_frequencies[1][i], found.contact_frequencies[0][i], 1e-2 * found.contact_frequencies[0][i]);
    }
  }
}
