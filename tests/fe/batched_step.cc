// SPDX-License-Identifier: GPL-3.0-only
#include "bed_of_springs.h"
#include "cylinder_kinematics.h"
#include "fe/contact/surface_contact.h"
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

// Eight points at once are what each is by itself.
TEST_P(BatchedStepOfAnAxis, AStepInTimeFollowsTheLawsAtEachPoint)
{
  const Cylinder cylinder = short_barrel(GetParam());
  const RigidCylinder rigid(model_a().geometry, cylinder);
  FrictionLaw regularised{ CoulombFriction{ 0.6 } };
  regularised.regularisation_speed = 20.;
  for (const auto &friction : { FrictionLaw{ CoulombFriction{ 0.4 } }, FrictionLaw{ CoulombFriction{ 50. } }, FrictionLaw{},
                                FrictionLaw{ StribeckFriction{} }, regularised })
  {
    Bed bed(cylinder, 12.5, 3, friction);
    const auto weights = generalised_alpha(0.8, 6e-3);
    const auto step    = [&](const auto &from, const auto &to, const double x, const std::vector<ContactHistory> &history)
    {
      FaceEvaluation<3> found;
      InterfaceStep step_to{ { 0., x - 0.7, 112., 0. }, history, { 6e-3, x, 112., 0., 0.3 }, { from, {}, {} }, to, {}, weights };
      step_to.request = Request::complete;
      bed.surface().evaluate(step_to, found);
      return found;
    };
    const auto before = bed.pressed(0.12), begin = bed.pressed(0.1); // at places further back the cylinder lies lower
    auto end = bed.pressed(0.03);
    for (unsigned int dof = 0; dof < bed.layout.surface; ++dof)
      end[dof] += 1e-3 * std::sin(1.3 * dof);
    const auto history = step(before, begin, Bed::x - 0.7, {}).history();
    ASSERT_GT(history.size(), 50u);
    const auto found = step(begin, end, Bed::x, history);

    StepContactLaw law;
    law.normal        = { bed.surface().penalties().normal, 1. };
    law.slip          = slip_law(friction, bed.surface().penalties().tangential);
    law.weights       = weights;
    const auto turned = [&](const dealii::Vector<double> &displacements)
    {
      return bed.layout.slopes > 0 ? AxisSlopes{ { displacements[bed.layout.slope(0)], displacements[bed.layout.slope(1)] } }
                                   : AxisSlopes{};
    };
    const double share = weights.stiffness();
    const auto mixed   = [share](const double a, const double b) { return (1. - share) * a + share * b; };
    const auto hub     = bed.layout.rotation();
    const auto at_end = rigid.pose(Bed::x, end[hub], turned(end)), at_begin = rigid.pose(Bed::x - 0.7, begin[hub], turned(begin));
    const KinematicsAtPose seen_at_end(rigid, at_end);
    AxisSlopes between_slopes{};
    for (unsigned int i = 0; i < 2; ++i)
      between_slopes[i] = mixed(at_begin.turned[i], at_end.turned[i]);
    const KinematicsAtPose seen_between(
        rigid, rigid.pose(mixed(at_begin.x, at_end.x), mixed(at_begin.theta, at_end.theta), between_slopes));
    double energy = 0., dissipated = 0., algorithmic = 0., moment = 0.;
    unsigned int pressed = 0;
    for (const auto &state : found.points)
    {
      const auto &point = bed.points()[state.index];
      auto from         = point.position;
      for (const auto &[node, shape] : point.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          from[d] += shape * begin[3 * node + d];
      const auto known =
          std::find_if(history.begin(), history.end(), [&](const auto &entry) { return entry.point == state.index; });
      const double gap_begin = rigid.gap_and_gradient(at_begin, from).first;
      if (state.gap >= 0. && gap_begin >= 0. && known == history.end())
      {
        EXPECT_EQ(state.pressure, 0.);
        continue;
      }
      const auto placed = seen_at_end(state.position);
      const auto middle = seen_between(from + share * (state.position - from));
      const auto slips  = compute_slips(rigid, at_begin, from);
      StepKinematics<7, 2> kinematics;
      kinematics.gap_begin = gap_begin;
      kinematics.gap_end   = placed.gap;
      kinematics.gap_row   = middle.gap_row;
      dealii::Tensor<1, 7> change;
      for (unsigned int d = 0; d < 3; ++d)
        change[d] = state.position[d] - from[d];
      change[3] = at_end.theta - at_begin.theta;
      change[4] = at_end.x - at_begin.x;
      for (unsigned int i = 0; i < 2; ++i)
        change[5 + i] = at_end.turned[i] - at_begin.turned[i];
      kinematics.gap_bend = change * (middle.gap_curvature * change);
      for (unsigned int s = 0; s < 2; ++s)
      {
        kinematics.slip_change[s] = placed.slip[s] - slips[s] + (s == 0 ? 0.3 : 0.);
        kinematics.slip_row[s]    = middle.slip_row[s];
        kinematics.slip_bend[s]   = change * (middle.slip_curvature[s] * change);
      }
      const auto expected = mean_response(kinematics, known != history.end() ? *known : ContactHistory{}, law);
      const double scale  = 1e-9; // of round-off that stiff springs make of places
      EXPECT_NEAR(state.pressure, expected.pressure, scale);
      EXPECT_LT((state.traction - expected.traction).norm(), scale);
      EXPECT_NEAR(state.mu, expected.mu, scale);
      EXPECT_EQ(state.slipping, expected.slipping);
      EXPECT_LT((state.history.slip_speed - expected.history.slip_speed).norm(), 1e3 * scale);
      energy += point.weight * expected.energy;
      dissipated += point.weight * expected.friction;
      algorithmic += point.weight * expected.algorithmic;
      moment += point.weight * expected.force[3];
      pressed += expected.pressure > 0. ? 1 : 0;
    }
    EXPECT_GT(pressed, 50u);
    EXPECT_NEAR(found.sums.stored, energy, 1e-9 * energy);
    EXPECT_NEAR(found.sums.work.friction, dissipated, 1e-9 * std::abs(dissipated));
    EXPECT_NEAR(found.sums.work.algorithmic, algorithmic, 1e-8 * std::abs(algorithmic));
    const auto &forces = found.forces;
    const auto place   = std::find(forces.dofs.begin(), forces.dofs.end(), hub) - forces.dofs.begin();
    EXPECT_NEAR(forces.values[static_cast<unsigned int>(place)], moment, 1e-9 * std::abs(moment));
  }
}

namespace
{
  /// Interpolates a quantity of points at `travel` before a point on its line; returns nothing beyond the line.
  template <class Quantity>
  std::optional<double> before(const std::vector<FacePoint<3>> &points, const unsigned int point, const double travel,
                               const Quantity &at_point)
  {
    const double xi = points[point].position[0] - travel;
    std::optional<unsigned int> below, above;
    for (unsigned int q = 0; q < points.size(); ++q)
      if (std::abs(points[q].position[2] - points[point].position[2]) < 1e-6)
      {
        const double at = points[q].position[0];
        if (at <= xi && (!below || at > points[*below].position[0]))
          below = q;
        if (at > xi && (!above || at < points[*above].position[0]))
          above = q;
      }
    if (!below || !above)
      return {};
    const double from = points[*below].position[0], to = points[*above].position[0];
    return at_point(*below) + (xi - from) / (to - from) * (at_point(*above) - at_point(*below));
  }
} // namespace

TEST_P(BatchedStepOfAnAxis, AStepWithoutInertiaFollowsTheLawsAtEachPoint)
{
  const Cylinder cylinder = short_barrel(GetParam());
  const RigidCylinder rigid(model_a().geometry, cylinder);
  const double run    = 0.3;
  using Case          = std::tuple<FrictionLaw, FrictionMode, bool>;
  const auto cone     = FrictionMode::cone;
  const auto coulomb  = FrictionLaw{ CoulombFriction{ 0.4 } };
  const auto stribeck = FrictionLaw{ StribeckFriction{} };
  for (const auto &[friction, mode, augmented] :
       { Case{ coulomb, cone, false }, Case{ FrictionLaw{ CoulombFriction{ 50. } }, cone, false }, Case{ stribeck, cone, true },
         Case{ coulomb, FrictionMode::stick, false }, Case{ FrictionLaw{}, FrictionMode::stick, true } })
  {
    Bed bed(cylinder, 12.5, 2);
    const StaticTerms terms{ friction, 6e-3, mode, augmented, 0.31, 1.2 };
    const auto step = [&](const auto &from, const auto &to, const double x, const std::vector<ContactHistory> &history)
    { return bed.evaluated(from, x - 0.7, to, x, history, run, terms); };
    const auto begin = bed.pressed(0.1);
    auto end         = bed.pressed(0.03);
    for (unsigned int dof = 0; dof < bed.layout.surface; ++dof)
      end[dof] += 1e-3 * std::sin(1.3 * dof);
    auto history = step(bed.pressed(0.12), begin, Bed::x - 0.7, {}).history();
    ASSERT_GT(history.size(), 50u);
    for (auto &entry : history)
      entry.normal_multiplier = augmented ? 0.1 * (1. + std::sin(0.7 * entry.point)) : 0.;
    const auto found = step(begin, end, Bed::x, history);

    StepContactLaw law;
    law.normal         = { bed.surface().penalties().normal, 1. };
    law.slip.stiffness = bed.surface().penalties().tangential;
    law.slip.friction  = friction;
    law.balance        = ForceBalance::end;
    law.mode           = mode;
    law.weights.dt     = terms.duration;
    const auto turned  = [&](const dealii::Vector<double> &displacements)
    {
      return bed.layout.slopes > 0 ? AxisSlopes{ { displacements[bed.layout.slope(0)], displacements[bed.layout.slope(1)] } }
                                   : AxisSlopes{};
    };
    const auto hub = bed.layout.rotation();
    const KinematicsAtPose seen_at_end(rigid, rigid.pose(Bed::x, end[hub], turned(end)));
    const auto at_begin    = rigid.pose(Bed::x - 0.7, begin[hub], turned(begin));
    const auto &points     = bed.points();
    const auto slips_begin = [&](const unsigned int q)
    {
      auto from = points[q].position;
      for (const auto &[node, shape] : points[q].nodes)
        for (unsigned int d = 0; d < 3; ++d)
          from[d] += shape * begin[3 * node + d];
      return compute_slips(rigid, at_begin, from);
    };
    const auto history_at = [&](const unsigned int q)
    {
      const auto known = std::find_if(history.begin(), history.end(), [q](const auto &entry) { return entry.point == q; });
      return known != history.end() ? *known : ContactHistory{};
    };
    double moment = 0., penetration = 0.;
    unsigned int pressed = 0, shifted = 0;
    for (const auto &state : found.points)
    {
      const auto &point = points[state.index];
      const auto was    = history_at(state.index);
      const auto placed = seen_at_end(state.position);
      EXPECT_NEAR(state.trial_pressure, was.normal_multiplier - law.normal.stiffness * placed.gap, 1e-9);
      if (state.trial_pressure <= 0.)
      {
        EXPECT_EQ(state.pressure, 0.);
        continue;
      }
      const auto from    = slips_begin(state.index);
      auto kinematics    = StepKinematics<7, 2>();
      kinematics.gap_end = placed.gap;
      kinematics.gap_row = placed.gap_row;
      for (unsigned int s = 0; s < 2; ++s)
      {
        kinematics.slip_change[s] = placed.slip[s] - from[s] + (s == 0 ? run : 0.);
        kinematics.slip_row[s]    = placed.slip_row[s];
      }
      double slope = placed.slip_row[0][0], shift = 0., elastic = 0.;
      for (unsigned int a = 0; a < point.nodes.size(); ++a)
        for (unsigned int d = 0; d < 3; ++d)
          slope += placed.slip_row[0][d] * point.slopes[a] * end[3 * point.nodes[a].first + d];
      if (const auto slip = before(points, state.index, terms.travel, [&](const auto q) { return slips_begin(q)[0]; }))
      {
        const auto traction = before(points, state.index, terms.travel, [&](const auto q) { return history_at(q).traction[0]; });
        shift               = from[0] - *slip - terms.travel * slope;
        elastic             = augmented ? 0. : (*traction - was.traction[0]) / law.slip.stiffness;
        ++shifted;
      }
      kinematics.slip_shift[0] = shift + elastic;
      const auto expected      = end_response(kinematics, was, law);
      const double scale       = 1e-9; // of round-off that stiff springs make of places
      EXPECT_NEAR(state.pressure, expected.pressure, scale);
      EXPECT_LT((state.traction - expected.traction).norm(), scale);
      EXPECT_NEAR(state.mu, expected.mu, scale);
      EXPECT_EQ(state.slipping, expected.slipping);
      EXPECT_NEAR(state.slip_change[0], terms.speed_ratio * (kinematics.slip_change[0] + shift), scale);
      EXPECT_NEAR(state.slip_change[1], terms.speed_ratio * kinematics.slip_change[1], scale);
      EXPECT_NEAR(state.elastic_slip, (expected.traction - (augmented ? was.traction : Slip())).norm() / law.slip.stiffness,
                  scale);
      for (unsigned int i = 0; i < 5; ++i)
        EXPECT_NEAR(state.end_force[i], expected.force[i], 1e-7 * expected.force.norm());
      moment += point.weight * expected.force[3];
      penetration = std::max(penetration, expected.pressure / law.normal.stiffness);
      ++pressed;
    }
    EXPECT_GT(pressed, 50u);
    EXPECT_GT(shifted, 50u);
    EXPECT_NEAR(found.sums.penetration, penetration, 1e-10);
    const auto &forces = found.forces;
    const auto place   = std::find(forces.dofs.begin(), forces.dofs.end(), hub) - forces.dofs.begin();
    EXPECT_NEAR(forces.values[static_cast<unsigned int>(place)], moment, 1e-9 * std::abs(moment));
  }
}

// The forces do not depend on whether their tangent is requested, nor the tangent on what was evaluated before.
TEST_P(BatchedStepOfAnAxis, ForcesAreTheSameWithAndWithoutATangent)
{
  const FrictionLaw friction{ CoulombFriction{ 0.4 } };
  const auto weights = generalised_alpha(0.8, 6e-3);
  const std::vector<ContactHistory> nothing;
  Bed bed(skewed(GetParam()), 12.5, 6, friction);
  const auto begin = bed.pressed(0.1), end = bed.pressed(0.03);
  const DrivePoint from{ 0., Bed::x - 0.7, 112., 0. }, to{ 6e-3, Bed::x, 112., 0. };
  const Kinematic at_begin{ begin, {}, {} };
  const auto evaluate = [&](const Request request, FaceEvaluation<3> &found) {
    bed.surface().evaluate(InterfaceStep{ from, nothing, to, at_begin, end, {}, weights, request }, found);
  };
  FaceEvaluation<3> at_once, one_by_one;
  evaluate(Request::with_tangent, at_once);
  evaluate(Request::forces, one_by_one);
  EXPECT_FALSE(one_by_one.forces.has_tangent);
  EXPECT_EQ(one_by_one.forces.dofs, at_once.forces.dofs);
  EXPECT_EQ(one_by_one.forces.values, at_once.forces.values);
  evaluate(Request::with_tangent, one_by_one);
  EXPECT_TRUE(one_by_one.forces.has_tangent);
  EXPECT_GT(at_once.forces.dofs.size(), 20u);
  EXPECT_EQ(one_by_one.forces.dofs, at_once.forces.dofs);
  EXPECT_EQ(one_by_one.forces.values, at_once.forces.values);
  EXPECT_EQ(one_by_one.forces.tangent, at_once.forces.tangent);
}

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

// Steady sliding is evaluated point by point where its parts are wanted, and eight at once where not.
TEST_P(BatchedStepOfAnAxis, ASlideIsThatOfItsParts)
{
  const FrictionLaw friction{ StribeckFriction{} };
  Bed bed(skewed(GetParam()), 12.5, 6, friction);
  const auto displacements = bed.pressed(0.03);
  const DrivePoint drive{ 0., Bed::x, -112., 0. };
  for (const auto rubs : { ContactFriction::sliding, ContactFriction::none })
  {
    const SlidingState state{ displacements, drive, -112., nullptr, rubs };
    FaceEvaluation<3> found, in_parts;
    bed.surface().evaluate_sliding(state, found);
    bed.surface().add_points(found);
    auto rest            = bed.surface().linearise(state, in_parts).stiffness();
    const auto &expected = in_parts.forces;
    ASSERT_GT(expected.dofs.size(), 20u);
    ASSERT_EQ(found.forces.dofs, expected.dofs);
    rest.add(-1., found.forces.tangent);
    EXPECT_LT(rest.frobenius_norm(), 1e-9 * found.forces.tangent.frobenius_norm());
    auto difference = found.forces.values;
    difference -= expected.values;
    EXPECT_LT(difference.linfty_norm(), 1e-9 * expected.values.linfty_norm());
    EXPECT_NEAR(found.sums.stored, in_parts.sums.stored, 1e-9 * in_parts.sums.stored);
    EXPECT_EQ(std::abs(found.sums.work.drive) + std::abs(found.sums.work.friction) + std::abs(found.sums.work.algorithmic), 0.);
    ASSERT_EQ(found.points.size(), in_parts.points.size());
    for (unsigned int i = 0; i < found.points.size(); ++i)
    {
      const auto &point = found.points[i], &other = in_parts.points[i];
      EXPECT_NEAR(point.pressure, other.pressure, 1e-9);
      EXPECT_LT((point.traction - other.traction).norm(), 1e-9);
      EXPECT_LT((point.slip_change - other.slip_change).norm(), 1e-9);
      EXPECT_LT((point.end_force - other.end_force).norm(), 1e-7);
      EXPECT_EQ(point.slipping, other.slipping);
      EXPECT_NEAR(point.mu, other.mu, 1e-15);
    }
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
