// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/meshed_in_time.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sprag;

namespace
{
  // Contact laws as fitted to these levers: ./run params/reversal-a.prm --set "Analysis/Type=contact law" and so on.
  Scene thick_a(const ModelType model)
  {
    return with_lever(in_time(model_a(), model), 20., 9541.32, 1.45485);
  }
  Scene thick_b(const ModelType model)
  {
    return with_lever(in_time(model_b(), model), 20., 5659.81, 1.43114);
  }
  Scene thin_a(const ModelType model)
  {
    return with_lever(in_time(model_a(), model), 6., 13068.5, 1.50185);
  }

  /// From x to the reversal at 65 mm and back.
  Scene around_the_reversal(const Scene &scene, const double x)
  {
    return with_drive(scene, Drive(DriveProfile::triangle, x, 65., 112., 1., 5e-3));
  }

  Oscillation oscillation(const Scene &scene)
  {
    return compute_oscillation(scene, run_any_in_time(scene));
  }
} // namespace

// The reduced models lump layer, shear and the spreading of the load into a law fitted to 0.3 %, that is 0.15 % of the frequency;
// 2 % is what the levels were to agree to.
TEST(Ladder, BeamAndCondensedLeverRingAtTheSameFrequency)
{
  for (const auto &scene : { thick_a, thick_b })
  {
    const auto beam      = oscillation(around_the_reversal(scene(ModelType::beam), 60.));
    const auto condensed = oscillation(around_the_reversal(scene(ModelType::condensed), 60.));
    EXPECT_NEAR(beam.frequency, condensed.frequency, 0.02 * condensed.frequency);
    EXPECT_NEAR(beam.frequency_Q, condensed.frequency_Q, 0.02 * condensed.frequency_Q);
    RecordProperty("beam", std::to_string(beam.frequency));
    RecordProperty("condensed", std::to_string(condensed.frequency));
  }
}

TEST(Ladder, SlowFiniteElementsAgreeInFrequencyAndVerdict)
{
  const auto meshed = oscillation(around_the_reversal(thick_a(ModelType::finite_element), 53.));
  const auto beam   = oscillation(around_the_reversal(thick_a(ModelType::beam), 53.));
  EXPECT_EQ(meshed.verdict, Verdict::decays);
  EXPECT_NEAR(beam.frequency, meshed.frequency, 0.02 * meshed.frequency);
  EXPECT_EQ(oscillation(around_the_reversal(thin_a(ModelType::finite_element), 53.)).verdict, Verdict::vibrates);
}

// Face size 1 mm: what is compared is how modes stand for the mesh, whatever it is. Truncated modes answer statically: their
// share of P errs by (omega / omega_n)^2 of what they contribute. The meshed lever's face starts out of balance, by as much as
// the penalty is stiff: its nodes, which the modes leave without mass, ring far above the steps' frequency, so that P turns its
// error of 9e-4 with every step and shrinks it by the spectral radius of 0.8. After 20 steps 1 % of it are left.
TEST(Ladder, CondensedLeverApproachesTheFiniteElementsWithItsModesSlow)
{
  auto scene       = with_fixed_step(with_face_size(around_the_reversal(thick_a(ModelType::finite_element), 63.5), 1.), 5e-5);
  const auto exact = run_meshed_in_time(scene);
  constexpr std::size_t start = 20;
  double peak = 0., last = std::numeric_limits<double>::infinity();
  for (const auto &row : exact.rows)
    peak = std::max(peak, row[Column::P]);
  scene.analysis.model = ModelType::condensed;
  for (const unsigned int modes : { 1u, 3u, 8u, 20u })
  {
    scene.condensed.modes = modes;
    const auto condensed  = run_meshed_in_time(scene);
    ASSERT_EQ(condensed.rows.size(), exact.rows.size());
    double error = 0.;
    for (std::size_t i = start; i < exact.rows.size(); ++i)
      error = std::max(error, std::abs(condensed.rows[i][Column::P] - exact.rows[i][Column::P]) / peak);
    EXPECT_LT(error, last) << modes;
    std::cout << modes << " modes: error of P " << error << " of its peak\n";
    last = error;
  }
  EXPECT_LT(last, 3e-4);
}

// With everything switched on.
TEST(Ladder, MeshedLeversKeepTheLedgerOfAReversal)
{
  for (const bool sprung : { false, true })
  {
    auto scene = around_the_reversal(thin_a(ModelType::condensed), 62.);
    if (sprung)
      scene = on_sprung_support(scene);
    EXPECT_LT(run_meshed_in_time(scene).report.ledger.share(), 1e-3) << sprung;
  }
}
