// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/energy_ledger.h"
#include "model/contact/contact_step.h"
#include "verification/point_at_interface.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

// Verification problem 6: a mass of 1 kg on a spring of 10 N/mm, pressed with 10 N on a floor, mu = 0.1, released at 0.85 mm.
// Friction takes 2 mu N/K = 0.2 mm off every turning point: 0.65, 0.45, 0.25, 0.05 mm; there the spring's 0.5 N hold no longer.

namespace
{
  constexpr double mass    = 1e-3; ///< [t]
  constexpr double spring  = 10.;
  constexpr double normal  = 10.;
  constexpr double mu      = 0.1;
  constexpr double release = 0.85;
  constexpr double holding = 1e5; ///< stiffness in stick [N/mm]
  constexpr double dt      = 1e-4;

  /// Friction under a given normal force on one displacement.
  class Floor : public PointAtInterface
  {
  public:
    explicit Floor(const FrictionLaw &friction_law)
        : law(friction_law)
    {
    }

    void evaluate(const InterfaceStep &step, Evaluation &found) const
    {
      const auto &before = step.history.front();
      using N            = Dual<double, 1>; // of the slip
      const double slip = step.end[0] - step.begin.position[0], was = before.traction[0];
      const auto friction = end_friction(SlipLaw{ law, holding }, slip_history(before), Several<N, 1>{ { variable<N>(slip, 0) } },
                                         N{} + normal, step.weights.dt);
      const double delay  = step.weights.delay();
      const double traction = friction.traction[0].v, change = traction - was;
      found.forces.values[0]           = -(0.5 * (was + traction) + delay * change);
      found.forces.tangent(0, 0)       = -(0.5 + delay) * friction.traction[0].d[0];
      found.last_history.traction[0]   = traction;
      found.last_history.slip_speed[0] = friction.slip_speed[0];
      found.last_history.step          = step.weights.dt;
      found.works                      = { 0., friction.dissipated, 0., delay * change * slip, friction.creep };
      found.stored                     = friction.energy;
      found.depth                      = mu * normal / holding; // of the spring in stick at the cone
    }

  private:
    FrictionLaw law;
  };

  DynamicLever<ModalStructure, Floor> make_oscillator(const FrictionLaw &law)
  {
    ModalData data;
    data.stiffness = { spring / mass };
    data.damping.reinit(1, 1);
    data.shapes.reinit(1, 1);
    data.shapes(0, 0) = 1. / std::sqrt(mass);
    return with_point_at_interface(data, Floor(law));
  }

  double position(const Motion &motion)
  {
    return motion.coordinates.position[0] / std::sqrt(mass);
  }

  struct Trajectory
  {
    std::vector<double> x; ///< at every step
    std::vector<double> traction;
    std::vector<double> peaks; ///< sizes of turning points but the first
    LedgerReport ledger;
    StepWork work;
  };

  Trajectory oscillate(const FrictionLaw &law, const double spectral_radius, const double time)
  {
    auto model                         = make_oscillator(law);
    Motion motion                      = model.initial_motion({ 0., 0., 0., 0. });
    motion.coordinates.position[0]     = release * std::sqrt(mass);
    motion.coordinates.acceleration[0] = -spring / mass * motion.coordinates.position[0];

    Trajectory result;
    EnergyLedger ledger(model.stored_energy(motion));
    double peak = 0.;
    for (unsigned int i = 1; i * dt <= time; ++i)
    {
      auto outcome = model.step(motion, { i * dt, 0., 0., 0. }, generalised_alpha(spectral_radius, dt));
      EXPECT_TRUE(outcome.motion);
      if (!outcome.motion)
        break;
      const double before = position(motion);
      motion              = std::move(*outcome.motion);
      const double x      = position(motion);
      ledger.add(i * dt, model.stored_energy(motion), outcome.work);
      result.work.friction += outcome.work.friction;
      result.work.creep += outcome.work.creep;
      result.x.push_back(x);
      result.traction.push_back(motion.contact.front().traction[0]);
      // Between two crossings of 0.
      if (before * x < 0.)
      {
        if (!result.x.empty() && peak > 0.)
          result.peaks.push_back(peak);
        peak = 0.;
      }
      if (std::any_of(result.x.begin(), result.x.end(), [](const double passed) { return passed < 0.; }))
        peak = std::max(peak, std::abs(x));
    }
    result.peaks.push_back(peak);
    result.ledger = ledger.report();
    return result;
  }

  FrictionLaw coulomb(const double regularisation_speed)
  {
    return { CoulombFriction{ mu }, FrictionSpeed::sliding, regularisation_speed };
  }
} // namespace

// Per turning point: the reversal of friction falls anywhere in a step, 2 mu N/M dt^2 = 2e-5 mm; the spring in stick takes
// 2 mu N/holding = 2e-5 mm; sampling hides (omega dt)^2/8 = 1e-5 of the size.
TEST(FrictionOscillator, LosesTheSameAtEveryTurnAndStops)
{
  const double exact[] = { 0.65, 0.45, 0.25, 0.05 };
  for (const double radius : { 1., 0.8 })
  {
    const auto found = oscillate(coulomb(0.), radius, 0.3);
    ASSERT_EQ(found.peaks.size(), 4u) << radius;
    for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(found.peaks[i], exact[i], (i + 1) * 5e-5) << radius << ", turn " << i;
      RecordProperty("turn_" + std::to_string(i + 1), std::to_string(found.peaks[i]));
    }
    // Arrest in stick, at the fourth turn after four half periods of 31.4 ms: what is left trembles on the stiff spring within
    // the cone.
    for (std::size_t i = static_cast<std::size_t>(0.127 / dt); i < found.x.size(); ++i)
    {
      ASSERT_NEAR(found.x[i], 0.05, 2.5e-4) << "step " << i;
      ASSERT_LE(std::abs(found.traction[i]), mu * normal * (1. + 1e-12));
    }
  }
}

TEST(FrictionOscillator, BalancesItsEnergy)
{
  // Friction's mean traction times slip is its work to round-off; 1/2 K (0.85^2 - 0.05^2) = 3.6 N mm are dissipated.
  for (const double radius : { 1., 0.8 })
  {
    const auto found = oscillate(coulomb(0.), radius, 0.3);
    EXPECT_LT(found.ledger.residual, 1e-11);
    EXPECT_NEAR(found.work.friction, 3.6, 3e-3);
    EXPECT_EQ(found.work.creep, 0.);
  }
}

TEST(FrictionOscillator, CreepsUnderARegularisedLawAndTellsHowFar)
{
  constexpr double v_r = 1.;
  const auto found     = oscillate(coulomb(v_r), 1., 0.6);
  EXPECT_LT(found.ledger.residual, 1e-11);
  // It comes to the same turns but for the share of the time in which it is slower than v_r: v_r/(omega 0.2 mm) = 5 %.
  ASSERT_GE(found.peaks.size(), 3u);
  EXPECT_NEAR(found.peaks[0], 0.65, 0.01);
  EXPECT_NEAR(found.peaks[1], 0.45, 0.01);
  // From then on K x = mu N v/sqrt(v^2 + v_r^2), here by the midpoint rule. It leaves out inertia, M K/(mu N/v_r)^2 = 1 % of the
  // rate, over two of its times.
  const auto from = static_cast<std::size_t>(0.2 / dt);
  double x        = found.x[from];
  EXPECT_GT(std::abs(x), 5e-3);
  const auto rate = [](const double at)
  {
    const double share = spring * at / (mu * normal);
    return -v_r * share / std::sqrt(1. - share * share);
  };
  for (std::size_t i = from; i < from + 2000; ++i)
    x += dt * rate(x + 0.5 * dt * rate(x));
  EXPECT_NEAR(found.x[from + 2000], x, 0.025 * std::abs(x));
  EXPECT_GT(found.work.creep, 0.04);
  RecordProperty("creep", std::to_string(found.work.creep));
}
