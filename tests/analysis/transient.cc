// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient.h"

#include "analytic/step_clock.h"
#include "base/errors.h"
#include "model/lever/reduced_lever.h"
#include "model/step/force_history.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/thrown.h"
#include "verification/run_transient.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Ends of the steps that a clock makes if left alone.
  std::vector<double> step_ends(StepClock clock)
  {
    std::vector<double> result;
    for (; !clock.finished(); clock.advance())
      result.push_back(clock.step_end());
    return result;
  }

  /// Hands everything on to another model.
  class Wrapped : public DynamicModel
  {
  public:
    explicit Wrapped(const Scene &scene)
        : inner(make_reduced_lever(scene))
    {
    }
    Motion initial_motion(const DrivePoint &drive) override
    {
      return inner->initial_motion(drive);
    }
    StepOutcome step(const Motion &accepted, const DrivePoint &to, const StepWeights &weights) override
    {
      return inner->step(accepted, to, weights);
    }
    std::vector<SlidingForces> sliding_forces(const DrivePoint &drive) override
    {
      return inner->sliding_forces(drive);
    }
    std::optional<HeldSlide> hold(const DrivePoint &drive, const ContactFriction friction) override
    {
      return inner->hold(drive, friction);
    }
    double drive_force(const Motion &motion) const override
    {
      return inner->drive_force(motion);
    }
    double largest_friction_share(const DrivePoint &drive, const double resolution) override
    {
      return inner->largest_friction_share(drive, resolution);
    }
    std::vector<Eigenmode> vibrations(const HeldSlide &slide, const bool in_contact, const unsigned int number) override
    {
      return inner->vibrations(slide, in_contact, number);
    }
    std::vector<std::complex<double>> eigenvalues(const HeldSlide &slide, const unsigned int number) override
    {
      return inner->eigenvalues(slide, number);
    }
    Motion perturbed(const HeldSlide &slide, const Eigenmode &mode, const double amplitude) override
    {
      return inner->perturbed(slide, mode, amplitude);
    }
    ModeShape mode_shape(const Eigenmode &mode) const override
    {
      return inner->mode_shape(mode);
    }
    StoredEnergy stored_energy(const Motion &motion) const override
    {
      return inner->stored_energy(motion);
    }
    void observe(const Motion &motion, Row &row) const override
    {
      inner->observe(motion, row);
    }
    FacePoints face_points() const override
    {
      return inner->face_points();
    }
    FaceState face_state(const Motion &motion) const override
    {
      return inner->face_state(motion);
    }
    void serialise_history(Archive &archive) override
    {
      inner->serialise_history(archive);
    }

  private:
    const std::unique_ptr<DynamicModel> inner;
  };

  /// Finds no solution, or throws, in each 31st attempt.
  class Failing : public Wrapped
  {
  public:
    using Wrapped::Wrapped;

    StepOutcome step(const Motion &accepted, const DrivePoint &to, const StepWeights &weights) override
    {
      auto outcome = Wrapped::step(accepted, to, weights);
      if (++calls % 62 == 0)
        throw AnalysisError("the 31st");
      if (calls % 31 == 0)
        outcome.motion.reset();
      return outcome;
    }

  private:
    unsigned int calls = 0;
  };

  Scene around_the_reversal(const double depth, const bool sprung)
  {
    Scene scene        = with_lever(in_time(model_a(), ModelType::beam), depth, 10451., 1.4726);
    scene.support.type = sprung ? SupportType::sprung : SupportType::rigid;
    return with_drive(scene, Drive(DriveProfile::triangle, 60., 65., 112., 1., 5e-3));
  }

  /// Every term matters: a thin lever on a sprung support that vibrates, in long steps with much algorithmic dissipation.
  Scene scene_with_everything()
  {
    return with_spectral_radius(with_fixed_step(around_the_reversal(6., true), 2e-4), 0.);
  }

  const std::vector<std::pair<Column, double>> terms = { { Column::drive_work, 1. },       { Column::kinetic_energy, -1. },
                                                         { Column::spring_energy, -1. },   { Column::elastic_energy, -1. },
                                                         { Column::support_energy, -1. },  { Column::contact_energy, -1. },
                                                         { Column::friction_work, -1. },   { Column::damping_work, -1. },
                                                         { Column::algorithmic_work, -1. } };

  /// Largest energy that the columns leave open over the run, without one of them, over the largest work. The layer's energy is
  /// part of the elastic one.
  double open_share(const std::vector<Row> &rows, const std::optional<Column> left_out)
  {
    double open    = 0.;
    double largest = 0.;
    for (const auto &row : rows)
    {
      double sum = 0.;
      for (const auto &[column, sign] : terms)
        if (column != left_out)
          sum += sign * (row[column] - rows.front()[column]);
      if (left_out == Column::layer_energy)
        sum += row[Column::layer_energy] - rows.front()[Column::layer_energy];
      open    = std::max(open, std::abs(sum));
      largest = std::max({ largest, std::abs(row[Column::drive_work]), row[Column::friction_work] });
    }
    return open / largest;
  }

  /// Returns the decay of the log amplitude per radian of q'' = -q in time, from the energy over many steps.
  double damping_in_time(const double spectral_radius, const double angle)
  {
    const auto w = generalised_alpha(spectral_radius, angle);
    double q = 1., v = 0., a = -1.;
    const auto steps = static_cast<unsigned int>(200. / angle);
    for (unsigned int i = 0; i < steps; ++i)
    {
      // (1 - alpha_m) a_1 + alpha_m a + (1 - alpha_f) q_1 + alpha_f q = 0.
      const double drift = q + w.dt * v + w.dt * w.dt * (0.5 - w.beta) * a;
      const double left  = 1. - w.alpha_m + (1. - w.alpha_f) * w.beta * w.dt * w.dt;
      const double next  = -(w.alpha_m * a + (1. - w.alpha_f) * drift + w.alpha_f * q) / left;
      q                  = drift + w.dt * w.dt * w.beta * next;
      v += w.dt * ((1. - w.gamma) * a + w.gamma * next);
      a = next;
    }
    return -0.5 * std::log(q * q + v * v) / (steps * angle);
  }

  Scene light_rigid_lever()
  {
    Scene scene                   = model_a();
    scene.analysis.type           = AnalysisType::transient;
    scene.analysis.model          = ModelType::rigid;
    scene.contact.stiffness       = 9541.32;
    scene.contact.exponent        = 1.45485;
    scene.lever.moment_of_inertia = 6.45e-3;
    scene.drive                   = Drive(DriveProfile::triangle, 45., 65., 112., 1., 5e-3);
    return scene;
  }
} // namespace

TEST(StepClock, EndsAStepOnEveryKink)
{
  const Drive drive(DriveProfile::triangle, 0., 65., 112., 1., 5e-3);
  const auto ends = step_ends(StepClock(drive, 5e-5, 0));
  ASSERT_GE(drive.kinks().size(), 3u);
  for (const double kink : drive.kinks())
    EXPECT_NE(std::find(ends.begin(), ends.end(), kink), ends.end()) << kink;
  EXPECT_EQ(ends.back(), drive.duration());
  EXPECT_TRUE(std::is_sorted(ends.begin(), ends.end()));
}

TEST(StepClock, HalvesWithoutMovingWhatIsBehindAndDoublesOnlyInStepWithTheWholeSteps)
{
  const Drive drive(DriveProfile::harmonic, 0., 10., 100., 0.5);
  StepClock clock(drive, drive.duration() / 8., 4);
  const double whole = clock.duration();
  clock.advance();
  clock.halve();
  EXPECT_NEAR(clock.step_end(), 1.5 * whole, 1e-15);
  clock.advance();
  clock.grow(); // half a step along: not yet
  EXPECT_EQ(clock.duration(), 0.5 * whole);
  clock.advance();
  clock.grow();
  EXPECT_EQ(clock.duration(), whole);
  clock.grow();
  EXPECT_EQ(clock.duration(), 2. * whole);
  for (unsigned int i = 0; i < 10; ++i)
    clock.grow();
  EXPECT_LE(clock.duration(), 16. * whole);
  while (!clock.finished())
  {
    EXPECT_LE(clock.step_end(), drive.duration());
    clock.advance();
  }
}

class Ledger : public ::testing::TestWithParam<Column>
{
};

TEST_P(Ledger, IsOpenWithoutOneOfItsTerms)
{
  static const auto rows = run_in_time(scene_with_everything()).rows;
  EXPECT_LT(open_share(rows, {}), 1e-6);
  EXPECT_GT(open_share(rows, GetParam()), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(EveryTerm, Ledger,
                         ::testing::Values(Column::drive_work, Column::kinetic_energy, Column::spring_energy,
                                           Column::elastic_energy, Column::layer_energy, Column::support_energy,
                                           Column::friction_work, Column::damping_work, Column::algorithmic_work),
                         [](const auto &chosen) { return column_info(chosen.param).name; });

TEST(EnergyLedger, ReportsTheLargestResidualAndWhereItOpenedMost)
{
  EnergyLedger ledger(StoredEnergy{});
  StepWork work;
  work.drive = 3.;
  StoredEnergy stored;
  stored.spring = 3.;
  ledger.add(0.1, stored, work);
  EXPECT_EQ(ledger.report().residual, 0.);
  EXPECT_EQ(ledger.report().share(), 0.);
  work             = {};
  work.friction    = 0.25;
  work.damping     = 0.125;
  work.algorithmic = 0.125;
  ledger.add(0.2, stored, work);
  EXPECT_DOUBLE_EQ(ledger.residual(), -0.5);
  EXPECT_DOUBLE_EQ(ledger.report().residual, 0.5);
  EXPECT_DOUBLE_EQ(ledger.report().share(), 0.5 / 3.);
  EXPECT_DOUBLE_EQ(ledger.report().time, 0.2);
  EXPECT_EQ(ledger.report().term, "friction");
}

TEST(RejectedStep, LeavesTheRunWhereTheAcceptedStepsAloneLead)
{
  for (const bool sprung : { false, true })
  {
    const Scene scene = with_fixed_step(around_the_reversal(6., sprung), 5e-5);
    Failing failing(scene);
    std::vector<Motion> motions;
    std::vector<double> durations;
    double rejected      = 0.;
    const auto reference = contact_reference(scene);
    const auto keep      = [&](const Motion &motion, const Row &row)
    {
      motions.push_back(motion);
      durations.push_back(row[Column::time_step]);
      rejected += std::fmax(0., row[Column::rejected_steps]); // NaN at the start
    };
    run_transient(failing, scene.drive, { scene.time, reference.P, reference.stiffness }, keep);
    EXPECT_GT(rejected, 50.);

    const auto model = make_reduced_lever(scene);
    Motion motion    = motions.front();
    ForceHistory forces;
    forces.begin(motion.forces);
    for (std::size_t i = 1; i < motions.size(); ++i)
    {
      const auto &expected = motions[i];
      motion.forces        = forces.guess(durations[i]);
      auto outcome         = model->step(motion, expected.drive, generalised_alpha(scene.time.spectral_radius, durations[i]));
      ASSERT_TRUE(outcome.motion);
      motion = std::move(*outcome.motion);
      forces.accept(motion.forces, durations[i]);
      ASSERT_EQ(motion.coordinates.position, expected.coordinates.position) << i;
      ASSERT_EQ(motion.coordinates.velocity, expected.coordinates.velocity) << i;
      ASSERT_EQ(motion.coordinates.acceleration, expected.coordinates.acceleration) << i;
      // History is that of accepted steps.
      const auto &history = expected.contact.front();
      ASSERT_EQ(motion.contact.front().traction, history.traction) << i;
      ASSERT_EQ(motion.contact.front().slip_speed, history.slip_speed) << i;
      ASSERT_EQ(motion.contact.front().damping, history.damping) << i;
      ASSERT_TRUE(history.step == 0. || history.step == durations[i]) << i;
    }
  }
}

TEST(Transient, GivesUpWhereHalvingDoesNotHelpAndTellsWhere)
{
  class Stuck : public Wrapped
  {
  public:
    using Wrapped::Wrapped;
    StepOutcome step(const Motion &accepted, const DrivePoint &to, const StepWeights &weights) override
    {
      return to.time > 0.01 ? StepOutcome{} : Wrapped::step(accepted, to, weights);
    }
  };
  const Scene scene = around_the_reversal(20., false);
  Stuck stuck(scene);
  const auto reference = contact_reference(scene);
  double last          = 0.;
  const auto text      = thrown_text<AnalysisError>(
      [&]
      {
        run_transient(stuck, scene.drive, { scene.time, reference.P, reference.stiffness },
                           [&](const Motion &motion, const Row &) { last = motion.drive.time; });
      });
  EXPECT_NE(text.find("no step beyond t = 0.0"), std::string::npos) << text;
  // Halved twelve times: the last step ends within 5e-5 / 4096 s of where it fails.
  EXPECT_NEAR(last, 0.01, 5e-8);
}

// Central differences and the trapezoidal rule (spectral radius 1): tan(w dt/2) = angle/2 of the undamped oscillator.
TEST(AlgorithmicFrequencyError, IsThatOfTheTrapezoidalRule)
{
  for (const double angle : { 0.01, 0.1, 0.5 })
    EXPECT_NEAR(algorithmic_frequency_error(1., angle), 1. - 2. * std::atan(0.5 * angle) / angle, 1e-9);
  EXPECT_DOUBLE_EQ(algorithmic_frequency_error(0.8, 0.), 0.);
  EXPECT_GT(algorithmic_frequency_error(0.8, 0.1), algorithmic_frequency_error(1., 0.1));
}

TEST(GrowingModes, AlgorithmicDampingIsThatOfTheStep)
{
  EXPECT_NEAR(algorithmic_damping(1., 0.3), 0., 1e-12);
  for (const double radius : { 0., 0.5, 0.8 })
    for (const double angle : { 0.1, 0.4, 1. })
      EXPECT_NEAR(algorithmic_damping(radius, angle), damping_in_time(radius, angle),
                  0.01 * damping_in_time(radius, angle) + 2e-4)
          << radius << ' ' << angle;
  EXPECT_NEAR(algorithmic_damping(0.8, 0.1) / algorithmic_damping(0.8, 0.05), 8., 0.1);
}

TEST(GrowingModes, LongestStepLeavesNineTenthsOfTheGrowth)
{
  const GrowingMode mode{ 60., 112., 200., 1e4 };
  const double omega = 2. * M_PI * mode.frequency;
  const double step  = longest_step({ mode }, 0.8);
  EXPECT_NEAR(algorithmic_damping(0.8, omega * step) * omega, 0.1 * mode.growth_rate, 1e-3);
  EXPECT_NEAR(longest_step({ { 60., 112., 6e4, 1e4 } }, 0.8), 1. / omega, 1e-12);
  EXPECT_EQ(longest_step({ mode, { 60., 112., 200., 1e3 } }, 0.8), step);
  EXPECT_TRUE(std::isinf(longest_step({}, 0.8)));
}

TEST(GrowingModes, OfALightLeverTheContactsForward)
{
  const Scene light = light_rigid_lever();
  const auto found  = growing_modes(*make_reduced_lever(light), light.drive);
  ASSERT_GE(found.size(), 2u);
  for (const auto &mode : found)
  {
    EXPECT_GT(mode.v, 0.);
    EXPECT_NEAR(mode.frequency, 10900., 1000.);
    EXPECT_NEAR(mode.growth_rate, 650., 250.);
  }
  Scene heavy                   = light;
  heavy.lever.moment_of_inertia = 6.45;
  EXPECT_TRUE(growing_modes(*make_reduced_lever(heavy), heavy.drive).empty());
}

TEST(GrowingModes, AFixedStepThatHidesOneIsToldWithNumbers)
{
  const std::vector<GrowingMode> modes = { { 55., 112., 100., 2e3 }, { 60., 112., 700., 1e4 } };
  const auto found                     = hidden_vibration_warnings(modes, { 5e-5, 0., 0.8 });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "hidden_vibration");
  for (const std::string part : { "60 mm", "10000 Hz", "700 1/s", "5e-05 s" })
    EXPECT_NE(found[0].found.find(part), std::string::npos) << found[0].found;
  EXPECT_NE(found[0].effect.find("3183.1 Hz"), std::string::npos) << found[0].effect;
  EXPECT_TRUE(hidden_vibration_warnings(modes, { 5e-5, 5e-3, 0.8 }).empty());
  EXPECT_TRUE(hidden_vibration_warnings(modes, { longest_step(modes, 0.8), 0., 0.8 }).empty());
  EXPECT_TRUE(hidden_vibration_warnings({}, { 5e-5, 0., 0.8 }).empty());
}
