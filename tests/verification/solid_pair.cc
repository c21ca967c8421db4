// SPDX-License-Identifier: GPL-3.0-only
#include "scene/held_slide.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"
#include "support/scene_parts.h"
#include "verification/solid_run.h"
#include "verification/solid_steps.h"

#include <functional>

// A full pair of levers in three dimensions.

using namespace sprag;

namespace
{
  /// Levers that differ in all that a plane knows, joined so that they swing together.
  Scene unlike_levers(Scene scene)
  {
    return paired(std::move(scene), SpringJoint::free, 0.2, 0.9);
  }

  using Value = std::function<double(const Row &)>;

  Value first_value(const Column column)
  {
    return [column](const Row &row) { return row[column]; };
  }

  Value second_value(const Column column)
  {
    return [column](const Row &row) { return row.second_value(column); };
  }

  /// Returns one of columns_across() of the first lever or the second.
  Value across(const std::size_t index, const unsigned int lever = 0)
  {
    return [i = index + lever * columns_across().size()](const Row &row) { return row.across.at(i); };
  }

  /// Largest difference of a value from `factor` times another's, over the largest of it.
  double apart(const std::vector<Row> &rows, const Value &value, const std::vector<Row> &others, const Value &other,
               const double factor = 1.)
  {
    EXPECT_EQ(rows.size(), others.size());
    double difference = 0., largest = 0.;
    for (std::size_t i = 0; i < std::min(rows.size(), others.size()); ++i)
    {
      difference = std::max(difference, std::abs(value(rows[i]) - factor * other(others[i])));
      largest    = std::max(largest, std::abs(value(rows[i])));
    }
    EXPECT_GT(largest, 0.);
    return difference / largest;
  }

  constexpr std::size_t centre_across = 1, twisting_moment = 2, turning_moment = 3;

  Scene in_time(const unsigned int dimension)
  {
    Scene scene                = unlike_levers(solid_model_a(0.));
    scene.analysis.type        = AnalysisType::transient;
    scene.analysis.model       = ModelType::condensed;
    scene.analysis.dimension   = dimension;
    scene.mesh.elements_across = 2;
    scene.condensed.modes      = 12;
    scene.spring.swing         = scene.spring.behaviour; // of which levers have more than when they mirror each other
    scene.spring.swing->inertia += 1.;
    scene.drive = Drive(DriveProfile::triangle, 20., 24., 112., 0.5);
    return scene;
  }
} // namespace

TEST(SolidPair, WithoutContractionItIsThatOfThePlane)
{
  const Scene scene = unlike_levers(solid_model_a(0.));
  const SolidRun solid(scene);
  const auto rows = run_scene(in_plane(scene));
  for (const Column column : { Column::P, Column::Q, Column::theta })
  {
    EXPECT_LT(apart(rows, first_value(column), solid.rows, first_value(column)), 1e-6) << column_info(column).name;
    EXPECT_LT(apart(rows, second_value(column), solid.rows, second_value(column)), 1e-6) << column_info(column).name;
  }
  EXPECT_LT(apart(rows, first_value(Column::friction_work), solid.rows, first_value(Column::friction_work)), 1e-6);
  const Value lateral = [](const Row &row) { return row.lateral_force(); };
  EXPECT_LT(apart(rows, lateral, solid.rows, lateral), 1e-5); // a difference of forces
  EXPECT_LT(solid.exactness.displacement, 1e-5);
}

// Half a turn about the cylinder's path brings the second lever in place of the first, the other side of the width in place of
// one, and leaves a tilted axis where it is.
TEST(SolidPair, ATiltedAxisPressesTheOtherSideOfTheSecondLever)
{
  const SolidRun run(paired(tilted(solid_model_a(0.3), 2e-4), SpringJoint::free));
  const auto &rows = run.rows;
  EXPECT_GT(rows[15].across[centre_across], 1.);
  for (const Column column : { Column::P, Column::F, Column::theta, Column::largest_pressure })
    EXPECT_LT(apart(rows, first_value(column), rows, second_value(column)), 1e-6) << column_info(column).name;
  for (const std::size_t column : { centre_across, twisting_moment, turning_moment })
    EXPECT_LT(apart(rows, across(column), rows, across(column, 1), -1.), 1e-5) << columns_across()[column].name;
}

TEST(SolidPair, InTimeItIsThatOfThePlane)
{
  const auto plane = first_steps(in_time(2)), solid = first_steps(in_time(3));
  EXPECT_GT(largest(plane, Column::P), 0.5);
  for (const Column column : { Column::P, Column::Q, Column::theta })
  {
    EXPECT_LT(apart(plane, first_value(column), solid, first_value(column)), 1e-5) << column_info(column).name;
    EXPECT_LT(apart(plane, second_value(column), solid, second_value(column)), 1e-5) << column_info(column).name;
  }
}

// Modes in which levers mirror each other and in which they swing, under an axis out of true; those of a lever alone are those in
// which its mirror image moves with it.
TEST(SolidPair, ItsModesAreThoseOfALeverAndOfTheSwingSlow)
{
  Scene scene              = in_time(3);
  scene.pair               = paired(scene, SpringJoint::free).pair;
  scene.analysis.type      = AnalysisType::stability;
  scene.stability.critical = "none";
  scene.stability.position = 22.;
  Scene alone              = scene;
  alone.pair.type          = PairType::half;
  const auto compute_modes = [](const Scene &slide_scene)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(slide_scene);
    const auto slide    = dynamics.model().hold(held_drive(slide_scene), ContactFriction::sliding);
    EXPECT_TRUE(slide);
    return dynamics.model().vibrations(*slide, true, 40);
  };
  const auto pair_modes = compute_modes(scene), lever_modes = compute_modes(alone);
  unsigned int symmetric = 0;
  for (const auto &mode : pair_modes)
  {
    EXPECT_NEAR(std::abs(mode.symmetry), 1., 1e-6);
    const auto is_same = [&](const Eigenmode &other)
    { return std::abs(other.mode.eigenvalue - mode.mode.eigenvalue) < 1e-6 * std::abs(mode.mode.eigenvalue); };
    if (mode.symmetry > 0.)
      symmetric += std::any_of(lever_modes.begin(), lever_modes.end(), is_same) ? 1 : 0;
  }
  EXPECT_EQ(pair_modes.size(), 2 * lever_modes.size());
  EXPECT_EQ(symmetric, lever_modes.size());
}
