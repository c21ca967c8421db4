// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"
#include "analytic/step_clock.h"
#include "base/errors.h"
#include "model/step/state_archive.h"
#include "model/step/stored_jacobian.h"
#include "results/result_file.h"
#include "scene/scene.h"
#include "toy_model.h"
#include "verification/run_transient.h"

#include <cstring>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  template <class Thing>
  Thing restored(Thing thing)
  {
    Archive archive;
    archive(thing);
    Thing result;
    Archive back(archive.bytes());
    back(result);
    EXPECT_TRUE(back.at_end());
    return result;
  }

  using Vector = dealii::Vector<double>;

  Vector make_vector(const std::vector<double> &values)
  {
    return Vector(values.begin(), values.end());
  }

  DrivePoint make_drive_point(const double first)
  {
    return { first, first + 1., first + 2., first + 3., first + 4. };
  }

  template <class Plain>
  bool same_bytes(const Plain &a, const Plain &b)
  {
    static_assert(std::is_trivially_copyable_v<Plain>);
    return std::memcmp(&a, &b, sizeof(Plain)) == 0;
  }

  template <class Plain>
  bool same_bytes(const std::vector<Plain> &a, const std::vector<Plain> &b)
  {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Plain)) == 0);
  }

  std::vector<ContactHistory> make_history(const double first)
  {
    std::vector<ContactHistory> result(2);
    std::memset(static_cast<void *>(result.data()), 0, 2 * sizeof(ContactHistory)); // padding is compared as well
    for (unsigned int i = 0; i < 2; ++i)
    {
      auto &[multiplier, traction, damping, slip_speed, speed, step, point] = result[i];
      multiplier                                                            = first + i;
      traction                                                              = Slip({ first + 10. + i, first + 15. + i });
      damping                                                               = first + 20. + i;
      slip_speed                                                            = Slip({ first + 30. + i, first + 33. + i });
      speed                                                                 = first + 35. + i;
      step                                                                  = first + 40. + i;
      point                                                                 = 50 + i;
    }
    return result;
  }

  DofLoads make_loads(const double first)
  {
    return { { 3, 7 }, make_vector({ first, -first }) };
  }

  Row make_row(const double first)
  {
    Row row, second;
    for (std::size_t i = 0; i < n_columns; ++i)
    {
      row[static_cast<Column>(i)]    = first + static_cast<double>(i);
      second[static_cast<Column>(i)] = first - static_cast<double>(i);
    }
    row[Column::layer_energy] = std::numeric_limits<double>::quiet_NaN();
    row.sensor_forces         = { first, 2. * first };
    row.add_second_lever(second);
    return row;
  }

  bool same_rows(const Row &a, const Row &b)
  {
    for (std::size_t i = 0; i < n_columns; ++i)
    {
      const double one = a[static_cast<Column>(i)], other = b[static_cast<Column>(i)];
      if (!same_bytes(one, other))
        return false;
    }
    return same_bytes(a.sensor_forces, b.sensor_forces) && same_bytes(a.second_lever(), b.second_lever());
  }

  bool same_rows(const std::vector<Row> &a, const std::vector<Row> &b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Row &one, const Row &other) { return same_rows(one, other); });
  }

  struct Killed
  {
  };

  /// Keeps the progress of each step and ends the run after some.
  class Keeper : public ProgressKeeper
  {
  public:
    std::string kept;
    unsigned int steps_left = 0;

    bool take_up(const ProgressSerialiser &progress) override
    {
      if (kept.empty())
        return false;
      Archive archive(kept);
      progress(archive);
      EXPECT_TRUE(archive.at_end());
      return true;
    }

    void accept_step(const ProgressSerialiser &progress) override
    {
      Archive archive;
      progress(archive);
      kept = archive.bytes();
      if (steps_left-- == 0)
        throw Killed();
    }

    void end_steps(const ProgressSerialiser &progress) override
    {
      Archive archive;
      progress(archive);
      EXPECT_EQ(archive.bytes(), kept);
    }
  };

  /// The rows of a run that is killed every `steps` steps, each part by a model of its own, and the number of parts.
  template <class Run>
  std::pair<std::vector<Row>, unsigned int> killed_rows(const unsigned int steps, const Run &run)
  {
    Keeper keeper;
    std::vector<Row> rows;
    for (unsigned int parts = 1;; ++parts)
      try
      {
        keeper.steps_left = steps;
        run([&](const auto &, const Row &row, const auto &...) { rows.push_back(row); }, &keeper);
        return { rows, parts };
      }
      catch (const Killed &)
      {
      }
  }
} // namespace

TEST(Archive, KeepsEveryField)
{
  const auto loads   = make_loads(2.);
  const auto history = make_history(100.);
  const dealii::FullMatrix<double> matrix(1, 1, std::array<double, 1>{ { -3. } }.data());
  const Motion motion{ make_drive_point(1.),
                       { make_vector({ 1., 2. }), make_vector({ 3. }), make_vector({ 4., 5., 6. }) },
                       make_vector({ 7., 8. }),
                       history,
                       loads,
                       std::make_shared<const StoredJacobian>(StoredJacobian{ { 5 }, matrix }) };
  {
    const auto &[drive, coordinates, face_force, contact, forces, tangent] = restored(motion);
    ASSERT_NE(tangent, nullptr);
    EXPECT_EQ(tangent->dofs, std::vector<unsigned int>{ 5 });
    EXPECT_EQ(tangent->matrix, matrix);
    EXPECT_EQ(restored(Motion()).tangent, nullptr);
    EXPECT_TRUE(same_bytes(drive, motion.drive));
    EXPECT_EQ(coordinates.position, motion.coordinates.position);
    EXPECT_EQ(coordinates.velocity, motion.coordinates.velocity);
    EXPECT_EQ(coordinates.acceleration, motion.coordinates.acceleration);
    EXPECT_EQ(face_force, motion.face_force);
    EXPECT_TRUE(same_bytes(contact, history));
    EXPECT_EQ(forces.dofs, loads.dofs);
    EXPECT_EQ(forces.values, loads.values);
  }
  const State state{ make_drive_point(3.), make_vector({ 9., -0. }), history, loads };
  {
    const auto &[drive, coordinates, contact, forces] = restored(state);
    EXPECT_TRUE(same_bytes(drive, state.drive));
    EXPECT_EQ(coordinates, state.coordinates);
    EXPECT_TRUE(std::signbit(coordinates[1]));
    EXPECT_TRUE(same_bytes(contact, history));
    EXPECT_EQ(forces.values, loads.values);
  }
  const FaceState face{ 1., 2., { 3., 4. }, { 5. }, { 10., 0. }, { 6., 7., 8. }, { 9. }, { 0., 11. } };
  {
    const auto &[time, x, pressure, traction, traction_across, pressure_2, traction_2, traction_across_2] = restored(face);
    EXPECT_EQ(traction_across, face.traction_across);
    EXPECT_EQ(time, 1.);
    EXPECT_EQ(x, 2.);
    EXPECT_EQ(pressure, face.pressure);
    EXPECT_EQ(traction, face.traction);
    EXPECT_EQ(pressure_2, face.pressure_2);
    EXPECT_EQ(traction_2, face.traction_2);
    EXPECT_EQ(traction_across_2, face.traction_across_2);
  }
  InterfaceForces forces{ { 1, 4 }, make_vector({ 2., 3. }), dealii::FullMatrix<double>(2, 2) };
  forces.tangent(0, 1) = 5.;
  forces.tangent(1, 0) = -6.;
  {
    const auto &[dofs, values, tangent, has_tangent] = restored(forces);
    EXPECT_TRUE(has_tangent);
    EXPECT_EQ(dofs, forces.dofs);
    EXPECT_EQ(values, forces.values);
    EXPECT_TRUE(tangent == forces.tangent);
  }
  EXPECT_TRUE(same_rows(restored(make_row(1000.)), make_row(1000.)));
  {
    const LedgerReport report{ 1., 2., 3., "friction" };
    const auto &[residual, largest_work, time, term] = restored(report);
    EXPECT_EQ(residual, 1.);
    EXPECT_EQ(largest_work, 2.);
    EXPECT_EQ(time, 3.);
    EXPECT_EQ(term, "friction");
  }
}

TEST(Archive, LedgerAndClockGoOn)
{
  EnergyLedger ledger({ 1., 2., 3., 4., 5., 6. });
  StepClock clock(Drive(DriveProfile::triangle, 0., 65., 112., 1., 5e-3), 1e-2, 4);
  for (unsigned int i = 0; !clock.finished(); ++i)
  {
    Archive archive;
    archive(ledger, clock);
    EnergyLedger ledger_again;
    StepClock clock_again(Drive(), 1., 0);
    Archive back(archive.bytes());
    back(ledger_again, clock_again);
    const auto step = [&](EnergyLedger &energies, StepClock &by)
    {
      if (i % 5 == 1)
        by.halve();
      if (i % 3 == 2)
        by.grow();
      const double t = by.step_end();
      energies.add(t, { t, std::sin(40. * t), t * t, 1. - t, 0.2, 0.1 * t }, { std::cos(30. * t), t, 0.1, 0.2, 0.3 });
      by.advance();
      Row row;
      energies.fill(row);
      row[Column::x] = energies.report().residual;
      row[Column::P] = energies.report().largest_work;
      row[Column::Q] = energies.report().time;
      row[Column::v] = static_cast<double>(energies.report().term.size());
      row[Column::s] = by.finished() ? 0. : by.duration();
      return row;
    };
    EXPECT_TRUE(same_rows(step(ledger_again, clock_again), step(ledger, clock))) << i;
  }
}

TEST(Archive, BytesThatAreNotAsTheyWereAreNoBytes)
{
  std::string text = "some text", other;
  Archive archive;
  archive(text);
  const auto bytes = archive.bytes();
  EXPECT_EQ(unsealed(sealed(bytes)), bytes);
  EXPECT_EQ(unsealed(sealed({})), std::string());
  for (std::size_t i = 0; i < sealed(bytes).size(); ++i)
  {
    auto damaged = sealed(bytes);
    damaged[i]   = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(unsealed(damaged)) << i;
    EXPECT_FALSE(unsealed(sealed(bytes).substr(0, i))) << i;
  }
  for (std::size_t length = 0; length < bytes.size(); ++length)
  {
    Archive cut(bytes.substr(0, length));
    EXPECT_THROW(cut(other), AnalysisError) << length;
  }
}

TEST(Progress, RunInTimeThatIsKilledGoesOn)
{
  for (const ModelType model : { ModelType::rigid, ModelType::beam })
  {
    Scene scene         = in_time(model_a(), model);
    scene.drive         = Drive(DriveProfile::triangle, 60., 65., 112., 1., 5e-3);
    scene.time.step     = 1e-4;
    const auto expected = run_in_time(scene);
    const auto lever    = contact_reference(scene);
    TransientReport report;
    const auto run = [&](const MotionSink &sink, ProgressKeeper *const keeper)
    {
      const auto anew = make_reduced_lever(scene);
      report          = run_transient(*anew, scene.drive, { scene.time, lever.P, lever.stiffness }, sink, keeper);
    };
    const auto [rows, parts] = killed_rows(7, run);
    EXPECT_GT(parts, 20u);
    EXPECT_TRUE(same_rows(rows, expected.rows));
    EXPECT_EQ(report.steps, expected.report.steps);
    EXPECT_EQ(report.ledger.residual, expected.report.ledger.residual);
    EXPECT_EQ(report.ledger.term, expected.report.ledger.term);
  }
}

TEST(Progress, RunWithoutInertiaThatIsKilledGoesOn)
{
  const Drive drive(DriveProfile::triangle, 0., 20., 100., 2.);
  QuasiStaticSettings settings;
  settings.step         = 0.5;
  settings.minimum_step = 1e-4;
  double stiffness      = -1.;
  const auto run        = [&](const StepSink &sink, ProgressKeeper *const keeper)
  {
    ToyModel model;
    model.fails    = [](const double from, const double to) { return to > 10. && from < 11. && to - from > 0.1; };
    model.friction = [](const double x) { return 10. * (x - 19.5); }; // passes through stick in 1 mm behind x = 20
    stiffness      = run_quasi_static(model, drive, settings, sink, keeper);
  };
  std::vector<Row> expected;
  run([&](const State &, const Row &row, const Evaluation &) { expected.push_back(row); }, nullptr);
  const double expected_stiffness = stiffness;
  const auto [rows, parts]        = killed_rows(3, run);
  EXPECT_GT(parts, 10u);
  EXPECT_TRUE(same_rows(rows, expected));
  EXPECT_EQ(stiffness, expected_stiffness);
}
