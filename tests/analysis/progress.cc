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
  using Vector = dealii::Vector<double>;

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
