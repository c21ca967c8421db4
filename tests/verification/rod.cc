// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/energy_ledger.h"
#include "model/contact/contact_step.h"
#include "verification/point_at_interface.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

// Verification problem 7: a rod of L = E = rho = A = 1, held at x = 1, before a rigid wall at x = 0 (u >= 0 there), released from
// rest with u = 1/2 - x/2. The end moves in at speed 1/2, rests on the wall from t = 1 to 2 at stress -1/2 and moves out again,
// to begin anew at t = 3.

namespace
{
  constexpr unsigned int elements = 100;
  constexpr double size           = 1. / elements;
  constexpr double dt             = 0.2 * size;
  constexpr double penalty        = 1e3;

  /// Displacements of the rod's nodes in its modes, mass 1 each.
  struct Rod
  {
    std::vector<double> stiffness;
    dealii::FullMatrix<double> shapes; ///< a row a node
    std::vector<double> mass;          ///< of the nodes
  };

  /// Truss elements with their mass at the nodes.
  Rod make_rod()
  {
    dealii::LAPACKFullMatrix<double> stiffness(elements), mass(elements);
    stiffness = 0.;
    mass      = 0.;
    Rod rod;
    for (unsigned int i = 0; i < elements; ++i)
    {
      rod.mass.push_back(i == 0 ? 0.5 * size : size);
      mass(i, i) += rod.mass.back();
      stiffness(i, i) += (i == 0 ? 1. : 2.) / size;
      if (i + 1 < elements)
        stiffness(i, i + 1) = stiffness(i + 1, i) = -1. / size;
    }
    std::vector<dealii::Vector<double>> modes(elements);
    stiffness.compute_generalized_eigenvalues_symmetric(mass, modes);
    rod.shapes.reinit(elements, elements);
    for (unsigned int i = 0; i < elements; ++i)
    {
      rod.stiffness.push_back(stiffness.eigenvalue(i).real());
      double length = 0.;
      for (unsigned int a = 0; a < elements; ++a)
        length += rod.mass[a] * modes[i][a] * modes[i][a];
      for (unsigned int a = 0; a < elements; ++a)
        rod.shapes(a, i) = modes[i][a] / std::sqrt(length);
    }
    return rod;
  }

  /// A rigid wall without friction: the gap is the displacement.
  class Wall : public PointAtInterface
  {
  public:
    void evaluate(const InterfaceStep &step, Evaluation &found) const
    {
      StepKinematics<1> point{};
      point.gap_begin      = step.begin.position[0];
      point.gap_end        = step.end[0];
      point.gap_row_end[0] = 1.;
      point.gap_row[0]     = 1.;
      StepContactLaw law;
      law.normal                 = { penalty, 1. };
      law.slip.stiffness         = 1.;
      law.slip.friction          = { CoulombFriction{ 0. }, FrictionSpeed::sliding };
      law.weights                = step.weights;
      const auto response        = step_response(point, step.history.front(), law);
      found.forces.values[0]     = response.force[0];
      found.forces.tangent(0, 0) = response.tangent[0][0];
      found.last_history         = response.history;
      found.works                = { 0., response.friction, response.damping, response.algorithmic, 0. };
      found.stored               = response.energy;
      found.depth                = response.pressure / penalty;
    }

    void observe(const Evaluation &found, Row &row, unsigned int) const
    {
      row[Column::P] = found.forces.values[0]; // of the step
    }
  };

  struct Sample
  {
    double time, u, pressure, energy, algorithmic;
  };

  struct Trajectory
  {
    std::vector<Sample> samples;
    dealii::Vector<double> last; ///< displacements of the nodes at the end
    double energy_before = 0.;
    LedgerReport ledger;
  };

  Trajectory bounce(const double spectral_radius, const double end)
  {
    const Rod rod = make_rod();
    ModalData data;
    data.stiffness = rod.stiffness;
    data.damping.reinit(elements, elements);
    data.shapes.reinit(1, elements);
    for (unsigned int i = 0; i < elements; ++i)
      data.shapes(0, i) = rod.shapes(0, i);
    auto model = with_point_at_interface(data, Wall());

    Motion motion = model.initial_motion({ 0., 0., 0., 0. });
    for (unsigned int i = 0; i < elements; ++i)
    {
      double &q = motion.coordinates.position[i];
      for (unsigned int a = 0; a < elements; ++a)
        q += rod.shapes(a, i) * rod.mass[a] * 0.5 * (1. - a * size);
      motion.coordinates.acceleration[i] = -rod.stiffness[i] * q;
    }

    Trajectory result;
    EnergyLedger ledger(model.stored_energy(motion));
    const auto total     = [](const StoredEnergy &energy) { return energy.kinetic + energy.elastic + energy.contact; };
    result.energy_before = total(model.stored_energy(motion));
    double algorithmic   = 0.;
    for (unsigned int i = 1; i * dt <= end + 0.5 * dt; ++i)
    {
      auto outcome = model.step(motion, { i * dt, 0., 0., 0. }, generalised_alpha(spectral_radius, dt));
      EXPECT_TRUE(outcome.motion);
      if (!outcome.motion)
        break;
      motion            = std::move(*outcome.motion);
      const auto stored = model.stored_energy(motion);
      ledger.add(i * dt, stored, outcome.work);
      algorithmic += outcome.work.algorithmic;
      Row row;
      model.observe(motion, row);
      result.samples.push_back({ i * dt, row[Column::theta], row[Column::P], total(stored), algorithmic });
    }
    result.last.reinit(elements);
    rod.shapes.vmult(result.last, motion.coordinates.position);
    result.ledger = ledger.report();
    return result;
  }

  /// Returns the displacement of the end: it moves in, rests and moves out.
  double exact_end(const double time)
  {
    const double phase = std::fmod(time, 3.);
    return phase < 1. ? 0.5 * (1. - phase) : phase < 2. ? 0. : 0.5 * (phase - 2.);
  }
} // namespace

// A front is some elements wide, (24 n^2 t)^(1/3) = 0.06 of the rod's length after t = 1 to 6 with 100 elements: times of
// contact, and displacements at speed 1/2, are off by about that share of it.
TEST(Rod, TouchesTheWallFromOneToTwoAndComesBackAtThree)
{
  for (const double radius : { 1., 0.8 })
  {
    const auto found = bounce(radius, 6.);
    for (unsigned int cycle = 0; cycle < 2; ++cycle)
    {
      const double begin = 3. * cycle;
      double first = 0., last = 0., impulse = 0.;
      for (const auto &sample : found.samples)
        if (sample.time > begin && sample.time <= begin + 3. && sample.pressure > 0.)
        {
          first = first == 0. ? sample.time : first;
          last  = sample.time;
          impulse += sample.pressure * dt;
        }
      EXPECT_NEAR(first, begin + 1., 0.03 + 0.03 * cycle) << radius;
      EXPECT_NEAR(last, begin + 2., 0.03 + 0.03 * cycle) << radius;
      EXPECT_NEAR(impulse, 0.5, 0.01 + 0.01 * cycle) << radius;
    }
    for (const auto &sample : found.samples)
      ASSERT_NEAR(sample.u, exact_end(sample.time), 0.02) << sample.time << ", " << radius;
    for (unsigned int a = 0; a < elements; ++a)
      EXPECT_NEAR(found.last[a], 0.5 * (1. - a * size), 0.02) << a;
  }
}

// The short waves beat the wall at their own periods of some 0.02; their mean over 0.8 is 1/40 of their size of some 0.1.
TEST(Rod, RestsOnTheWallAtTheStressOfTheWave)
{
  for (const double radius : { 1., 0.8 })
  {
    double sum          = 0.;
    unsigned int number = 0;
    for (const auto &sample : bounce(radius, 3.).samples)
      if (sample.time > 1.1 && sample.time < 1.9)
      {
        sum += sample.pressure;
        ++number;
      }
    EXPECT_NEAR(sum / number, 0.5, 0.005) << radius;
  }
}

TEST(Rod, KeepsItsEnergyThroughContacts)
{
  // 1/8; nothing opens or closes for nothing.
  const auto kept = bounce(1., 6.);
  EXPECT_NEAR(kept.energy_before, 0.125, 1e-12);
  ASSERT_FALSE(kept.samples.empty());
  for (const auto &sample : kept.samples)
    ASSERT_NEAR(sample.energy, 0.125, 1e-11) << sample.time;
  EXPECT_LT(kept.ledger.residual, 1e-11);

  // With algorithmic dissipation the ledger closes as well, and it takes the short waves of the fronts only.
  const auto dissipated = bounce(0.8, 6.);
  EXPECT_LT(dissipated.ledger.residual, 1e-11);
  EXPECT_GT(dissipated.samples.back().algorithmic, 0.);
  EXPECT_LT(dissipated.samples.back().algorithmic, 0.02 * 0.125);
}
