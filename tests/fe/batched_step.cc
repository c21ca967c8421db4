// SPDX-License-Identifier: GPL-3.0-only
#include "bed_of_springs.h"
#include "fe/contact/face_contact.h"
#include "mpi_environment.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Cylinder short_barrel(const bool is_free)
  {
    return barrel(is_free, 40., 4., 8000.);
  }
} // namespace

/// The parameter says if the axis is free on its shaft.
class BatchedStepOfAnAxis : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(IsFree, BatchedStepOfAnAxis, testing::Bool());

// A contact that has travelled finds the same as one that starts here, to the last bit.
TEST_P(BatchedStepOfAnAxis, NothingIsPassedOverThatTouches)
{
  const FrictionLaw friction{ CoulombFriction{ 0.4 } };
  const auto weights = generalised_alpha(0.8, 6e-3);
  const std::vector<ContactHistory> nothing;
  Bed traveller(short_barrel(GetParam()), 12.5, 3, friction);
  unsigned int touching = 0;
  double x              = Bed::x - 0.3;
  auto begin            = traveller.pressed(-0.01);
  for (unsigned int k = 0; k < 24; ++k)
  {
    auto end = traveller.pressed(0.02 + 0.06 * std::sin(0.3 * k));
    for (unsigned int dof = 0; dof < traveller.layout.surface; ++dof)
      end[dof] += 2e-3 * std::sin(1.3 * dof + k);
    const double to = x + (k % 4 == 0 ? 0.05 : 0.02);
    const auto step = [&](Bed &bed)
    {
      FaceEvaluation<3> found;
      InterfaceStep step_to{ { 0., x, 112., 0. }, nothing, { 6e-3, to, 112., 0. }, { begin, {}, {} }, end, {}, weights };
      step_to.request = Request::complete;
      bed.surface().evaluate(step_to, found);
      bed.surface().add_points(found);
      return found;
    };
    Bed newcomer(short_barrel(GetParam()), 12.5, 3, friction);
    const auto found = step(traveller), expected = step(newcomer);
    EXPECT_EQ(found.forces.dofs, expected.forces.dofs);
    EXPECT_EQ(found.forces.values, expected.forces.values);
    EXPECT_EQ(found.forces.tangent, expected.forces.tangent);
    EXPECT_EQ(found.sums.stored, expected.sums.stored);
    ASSERT_EQ(found.points.size(), expected.points.size());
    for (unsigned int i = 0; i < found.points.size(); ++i)
    {
      EXPECT_EQ(found.points[i].gap, expected.points[i].gap);
      EXPECT_EQ(found.points[i].position, expected.points[i].position);
      EXPECT_EQ(found.points[i].traction, expected.points[i].traction);
    }
    touching += found.forces.dofs.empty() ? 0 : 1;
    if (k % 3 == 0) // steps are tried several times before the next begins
    {
      begin = end;
      x     = to;
    }
  }
  EXPECT_GT(touching, 9u);
  EXPECT_LT(touching, 24u);
}

// A step returns only those points that matter to its record.
TEST_P(BatchedStepOfAnAxis, PointsInContactTellWhatAllPointsTell)
{
  const FrictionLaw friction{ CoulombFriction{ 0.4 } };
  const auto weights = generalised_alpha(0.8, 6e-3);
  const std::vector<ContactHistory> nothing;
  Bed bed(short_barrel(GetParam()), 12.5, 6, friction);
  const ContactFace<3> &view = bed.surface();
  for (const double penetration : { 0.06, 0.02, -0.01 })
  {
    const auto begin = bed.pressed(penetration - 0.01), end = bed.pressed(penetration);
    FaceEvaluation<3> found;
    InterfaceStep step_to{
      { 0., Bed::x - 0.1, 112., 0. }, nothing, { 6e-3, Bed::x, 112., 0. }, { begin, {}, {} }, end, {}, weights
    };
    step_to.request = Request::complete;
    bed.surface().evaluate(step_to, found);
    auto all = found;
    bed.surface().add_points(all);
    EXPECT_EQ(found.points.size() < all.points.size(), penetration > 0.);
    const auto before = [](const auto &a, const auto &b) { return a.index < b.index; };
    EXPECT_TRUE(std::is_sorted(found.points.begin(), found.points.end(), before));
    const auto deepest = [](const FaceEvaluation<3> &evaluation)
    {
      return std::min_element(evaluation.points.begin(), evaluation.points.end(),
                              [](const auto &a, const auto &b) { return a.gap < b.gap; });
    };
    EXPECT_EQ(deepest(found)->index, deepest(all)->index);
    Row some_row, all_row;
    view.observe(found, some_row);
    view.observe(all, all_row);
    EXPECT_GE(all_row[Column::active_points], penetration > 0. ? 100. : 0.);
    for (std::size_t i = 0; i < n_columns; ++i)
    {
      const auto column = static_cast<Column>(i);
      EXPECT_TRUE(some_row[column] == all_row[column] || (std::isnan(some_row[column]) && std::isnan(all_row[column]))) << i;
    }
    EXPECT_EQ(some_row.across, all_row.across);
    EXPECT_EQ(found.history().size(), all.history().size());
  }
}

namespace
{
  /// Compares every entry of the tangent with differences of the forces that `evaluated(displacements)` finds. Where differences
  /// over two ways do not agree the forces have no derivative: a point comes into contact or begins to slip. `every`: of so many
  /// columns one, and those of the frame.
  template <class Evaluated>
  void expect_every_entry(const Bed &bed, const dealii::Vector<double> &displacements, const Evaluated &evaluated,
                          const unsigned int every)
  {
    const auto found  = evaluated(displacements).forces;
    const auto moment = [&](const unsigned int dof) { return bed.unit_length(dof) * (dof == bed.layout.rotation() ? 120. : 1.); };
    unsigned int compared = 0;
    for (unsigned int j = 0; j < found.dofs.size(); ++j)
    {
      if (j % every != 0 && found.dofs[j] < bed.layout.surface)
        continue;
      const auto difference = [&](const double way)
      {
        auto before = displacements, after = displacements;
        before[found.dofs[j]] -= way / moment(found.dofs[j]);
        after[found.dofs[j]] += way / moment(found.dofs[j]);
        const auto low = evaluated(before).forces, high = evaluated(after).forces;
        auto result = high.values;
        EXPECT_EQ(low.dofs, found.dofs);
        EXPECT_EQ(high.dofs, found.dofs);
        result -= low.values;
        result /= 2. * way;
        return result;
      };
      const auto far = difference(4e-6), near = difference(2e-6);
      for (unsigned int i = 0; i < found.dofs.size(); ++i)
      {
        const double to_force = moment(found.dofs[i]), expected = near[i] / to_force;
        const double size = std::abs(found.tangent(i, i)) / (to_force * to_force) + 1e-3;
        if (std::abs(far[i] - near[i]) / to_force > 1e-6 * size || std::abs(expected) < 1e-5 * size)
          continue;
        ++compared;
        EXPECT_NEAR(found.tangent(i, j) / (to_force * moment(found.dofs[j])), expected, 1e-4 * std::abs(expected) + 1e-6 * size)
            << i << ' ' << j;
      }
    }
    EXPECT_GT(compared, 3 * found.dofs.size());
  }

  dealii::Vector<double> waved(const Bed &bed, const double penetration)
  {
    auto result = bed.pressed(penetration);
    for (unsigned int dof = 0; dof < bed.layout.surface; ++dof)
      result[dof] += 1e-3 * std::sin(1.3 * dof);
    for (unsigned int i = 0; i < bed.layout.slopes; ++i)
      result[bed.layout.slope(i)] = 3e-4 * (1. + i);
    return result;
  }
} // namespace

TEST_P(BatchedStepOfAnAxis, EveryEntryOfTheTangentIsTheDerivativeOfAForce)
{
  const double speed = 112.;
  FrictionLaw regularised{ CoulombFriction{ 0.6 } };
  regularised.regularisation_speed = 20.;
  const FrictionLaw falling{ StribeckFriction{ 0.6, 0.2, 100. } };
  const auto weights = generalised_alpha(0.8, 6e-3);
  unsigned int every = 8; // of one law more columns
  for (const auto &friction :
       { falling, FrictionLaw{ CoulombFriction{ 0.4 } }, FrictionLaw{ CoulombFriction{ 50. } }, FrictionLaw{}, regularised })
  {
    Bed bed(short_barrel(GetParam()), 12.5, 2, friction);
    const auto before = bed.pressed(0.12), begin = bed.pressed(0.1), end = waved(bed, 0.03);
    const auto in_time =
        [&](const auto &from, const auto &to, const double x, const std::vector<ContactHistory> &history, const Request request)
    {
      FaceEvaluation<3> found;
      InterfaceStep step_to{
        { 0., x - 0.7, speed, 0. }, history, { 6e-3, x, speed, 0., 0.3 }, { from, {}, {} }, to, {}, weights
      };
      step_to.request = request;
      bed.surface().evaluate(step_to, found);
      return found;
    };
    const auto history = in_time(before, begin, Bed::x - 0.7, {}, Request::complete).history();
    expect_every_entry(
        bed, end, [&](const auto &at) { return in_time(begin, at, Bed::x, history, Request::with_tangent); }, every);

    StaticTerms terms{ friction, 6e-3, FrictionMode::cone, false, 0.31, 1.2 };
    expect_every_entry(
        bed, end, [&](const auto &at) { return bed.evaluated(begin, Bed::x - 0.7, at, Bed::x, history, 0.3, terms); }, every);

    const DrivePoint drive{ 0., Bed::x, speed, 0. };
    expect_every_entry(
        bed, end,
        [&](const auto &at)
        {
          FaceEvaluation<3> found;
          bed.surface().evaluate_sliding(SlidingState{ at, drive, -speed }, found);
          return found;
        },
        every);
    every = 13;
  }
}
