// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/vibration_accuracy.h"

#include "mpi_environment.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Model A's slide at x = 30 mm moving back, of a condensed lever.
  Scene slide(const double face_size)
  {
    Scene scene               = model_a();
    scene.analysis.type       = AnalysisType::stability;
    scene.analysis.model      = ModelType::condensed;
    scene.mesh.face_size      = face_size;
    scene.condensed.modes     = 6;
    scene.stability.position  = 30.;
    scene.stability.direction = Direction::backward;
    return held_scene(scene);
  }

  /// In three dimensions.
  Scene slide_in_space(const double face_size, const unsigned int across)
  {
    Scene scene                = slide(face_size);
    scene.analysis.dimension   = 3;
    scene.mesh.elements_across = across;
    scene.drive                = Drive(DriveProfile::triangle, 28., 32., 112., 0.5);
    return scene;
  }

  std::vector<ErrorEstimate> estimated(const Scene &scene)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    const auto found    = check_slide(dynamics.model(), held_drive(scene), checked_modes(scene));
    return vibration_accuracy(scene, found, dynamics.meshed, maker);
  }
} // namespace

TEST(VibrationAccuracy, ToldErrorsHoldTheChangeToAFinerMesh)
{
  const Scene scene = slide(0.5);
  DynamicsMaker maker(false);
  const auto coarse = check_slide(scene, maker);
  const auto fine   = check_slide(slide(0.2), maker);
  const auto errors = estimated(scene);
  ASSERT_EQ(errors.size(), 2u);
  const double growth    = std::abs(coarse.growth_rate() / fine.growth_rate() - 1.);
  const double frequency = std::abs(coarse.frequency() / fine.frequency() - 1.);
  EXPECT_GT(total_error(errors[0]), 0.5 * growth);
  EXPECT_GT(total_error(errors[1]), 0.5 * frequency);
  for (const auto &error : errors)
  {
    ASSERT_EQ(error.parts.size(), 3u);
    EXPECT_LT(total_error(error), 0.05) << error.quantity;
    for (const auto &part : error.parts)
    {
      EXPECT_TRUE(std::isfinite(part.value)) << error.quantity << ' ' << part.name;
      EXPECT_EQ(part.remedy.find("augmented"), std::string::npos) << "which runs with inertia refuse";
    }
  }
}

// Three faces in contact: meshes of 1 and 2 mm give the same frequency here by chance.
TEST(VibrationAccuracy, ToldErrorsHoldThePlaceBetweenTheNodes)
{
  const auto undamped_slide = [](const double face_size)
  {
    Scene scene               = slide(face_size);
    scene.stability.position  = 40.;
    scene.stability.direction = Direction::forward;
    scene.stability.damping   = false;
    return held_scene(scene);
  };
  DynamicsMaker maker(false);
  const double coarse          = check_slide(undamped_slide(1.), maker).frequency();
  const double fine            = check_slide(undamped_slide(0.25), maker).frequency();
  const double error           = std::abs(coarse / fine - 1.);
  const double estimated_error = total_error(estimated(undamped_slide(1.))[1]);
  EXPECT_GT(error, 0.02);
  EXPECT_GT(estimated_error, 0.5 * error);
  EXPECT_LT(estimated_error, 3. * error);
}

TEST(VibrationAccuracy, InThreeDimensionsToldErrorsHoldTheChangeToAFinerMeshSlow)
{
  const Scene scene = slide_in_space(4., 2);
  DynamicsMaker maker(false), fine_maker(false);
  const auto coarse = check_slide(scene, maker);
  const auto fine   = check_slide(slide_in_space(2., 4), fine_maker);
  const auto errors = estimated(scene);
  ASSERT_EQ(errors.size(), 2u);
  const double true_errors[] = { std::abs(coarse.growth_rate() / fine.growth_rate() - 1.),
                                 std::abs(coarse.frequency() / fine.frequency() - 1.) };
  for (unsigned int i = 0; i < 2; ++i)
  {
    ASSERT_EQ(errors[i].parts.size(), 3u) << errors[i].unknown;
    EXPECT_GT(total_error(errors[i]), 0.5 * true_errors[i]) << errors[i].quantity;
    EXPECT_LT(total_error(errors[i]), 0.2) << errors[i].quantity;
  }
}

TEST(VibrationAccuracy, LeversWithoutAMeshTellNone)
{
  Scene scene          = slide(0.5);
  scene.analysis.model = ModelType::beam;
  EXPECT_TRUE(estimated(scene).empty());
}
