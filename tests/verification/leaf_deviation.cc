// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"
#include "input/read.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/params_folder.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

// Models A and B on a leaf spring of finite elements calibrated to k, against the closed form of a constant k. P and Q are
// proportional to the moment, so that the leaf's excess over k phi moves both by
//   e = excess / (k phi),
// beside the d by which lever and layer move them on a torsional spring of that k too. To second order they meet: the sum's
// product e d; what bends grows with the force, e d; a turn that differs by d changes e by phi e' d. On the way back steps lie
// where the passage through stick has left them, the longer the larger the force at the turn is, and with them what they leave of
// the layer's share: d times e there.

namespace
{
  Scene calibration(const std::string &model, std::vector<std::string> changes)
  {
    changes.insert(changes.end(), { "Analysis/Type=quasi-static", "Drive/Reversal duration=0" });
    const auto file = params_folder() / ("calibration-" + model + ".prm");
    return with_coulomb(read_scene(file.string(), changes), 0.73);
  }

  Scene on_torsional_spring(Scene scene, const double stiffness)
  {
    scene.spring           = {};
    scene.spring.stiffness = stiffness;
    return scene;
  }

  /// From x to 65 and back to exactly x: rows after a reversal lie where the passage through stick leaves them.
  std::vector<Row> there_and_back(const Scene &scene, const double x)
  {
    return run_scene(with_step(with_drive(scene, Drive(DriveProfile::triangle, x, 65., 112., 1.)), 5.));
  }

  /// The leaf's share of the relative deviation of P and Q from the closed form.
  struct Share
  {
    double e;        ///< excess / (k phi) at the ideal turn
    double slope;    ///< phi e'
    double P, Q;     ///< found: deviation on the leaf less that on the torsional spring
    double d_P, d_Q; ///< deviation on the torsional spring
  };

  Share share_at(const Scene &plain, const MomentLaw &law, const Row &on_leaf, const Row &on_plain)
  {
    EXPECT_NEAR(on_leaf[Column::x], on_plain[Column::x], 1e-9);
    const auto ideal   = closed_form(plain, on_plain[Column::x], on_plain[Column::v]);
    const double turn  = ideal.contact.theta - kinematics(plain.geometry, 0.).theta;
    const double k     = plain.spring.stiffness;
    const double e     = (law.moment(turn) - k * turn) / (k * turn);
    const double slope = law.stiffness(turn) / k - 1. - e;
    return { e,
             slope,
             (on_leaf[Column::P] - on_plain[Column::P]) / ideal.P,
             (on_leaf[Column::Q] - on_plain[Column::Q]) / ideal.Q,
             on_plain[Column::P] / ideal.P - 1.,
             on_plain[Column::Q] / ideal.Q - 1. };
  }

  /// Both strokes; at 5 mm and further on.
  std::array<std::vector<Share>, 2> shares(const Scene &scene, const double k)
  {
    const Scene plain = on_torsional_spring(scene, k);
    const auto &law   = scene.spring.behaviour.law;
    std::array<std::vector<Share>, 2> result;
    for (const double x : { 5., 35., 60. })
    {
      const auto on_leaf = there_and_back(scene, x), on_plain = there_and_back(plain, x);
      for (std::size_t i = 0; x == 5. && on_leaf[i][Column::v] > 0.; ++i)
        result[0].push_back(share_at(plain, law, on_leaf[i], on_plain[i]));
      result[1].push_back(share_at(plain, law, on_leaf.back(), on_plain.back()));
    }
    EXPECT_EQ(result[0].size(), 13u);
    return result;
  }

  struct Largest
  {
    double deviation = 0., explained = 0., unexplained = 0.;
  };

  /// Tolerance: half as much again as the terms of second order, and what Newton's method leaves.
  Largest expect_explained(const std::vector<Share> &shares, const double e_at_turn, double Share::*const found,
                           double Share::*const flexure)
  {
    double d = 0.;
    for (const auto &share : shares)
      d = std::max(d, std::abs(share.*flexure));
    Largest largest;
    for (const auto &share : shares)
    {
      const double left = share.*found - share.e;
      EXPECT_LT(std::abs(left), 1.5 * (2. * std::abs(share.e) + std::abs(share.slope) + e_at_turn) * d + 1e-7);
      largest.deviation   = std::max(largest.deviation, std::abs(share.*found + share.*flexure));
      largest.explained   = std::max(largest.explained, std::abs(share.e));
      largest.unexplained = std::max(largest.unexplained, std::abs(left));
    }
    return largest;
  }

  void expect_explained(const std::string &model, const std::string &name, const std::vector<std::string> &changes)
  {
    const Scene calibrated = calibration(model, changes);
    const double k         = *calibrated.calibration.stiffness;
    const auto parts       = calibrate_parts(calibrated);
    const auto found       = shares(parts.scene, k);
    for (const unsigned int stroke : { 0u, 1u })
    {
      const double e_at_turn = stroke == 0 ? 0. : std::abs(found[0].back().e);
      const auto P           = expect_explained(found[stroke], e_at_turn, &Share::P, &Share::d_P);
      const auto Q           = expect_explained(found[stroke], e_at_turn, &Share::Q, &Share::d_Q);
      std::printf("| %s, %s, %.4f mm | %s | %.2e | %.2e | %.1e | %.2e | %.1e |\n", model.c_str(), name.c_str(), *parts.thickness,
                  stroke == 0 ? "forward" : "backward", P.explained, P.deviation, P.unexplained, Q.deviation, Q.unexplained);
    }
  }
} // namespace

TEST(LeafDeviationSlow, IsThatOfItsMomentLawBesideFlexure)
{
  for (const std::string model : { "a", "b" })
  {
    expect_explained(model, "free along", {});
    expect_explained(model, "held along", { "Leaf spring/Axial=held" });
    expect_explained(model, "arc of 2 mm held along", { "Leaf spring/Axial=held", "Leaf spring/Sagitta=2" });
  }
}

// The sum is computed by hand: bar and layer are rectangles from the pivot on, at their distance from it. The leaf is a beam
// that its clamp turns, x (1 - x/L)^2, which is 7e-4 of J.
TEST(LeafDeviation, CalibratedPartsHaveTheMomentOfInertiaOfTable1)
{
  for (const auto &[model, J] : { std::pair<std::string, double>{ "a", 6.45 }, { "b", 6.86 } })
  {
    const auto scene     = calibrate_parts(calibration(model, {})).scene;
    const auto &lever    = scene.lever;
    const auto &layer    = scene.layer;
    const auto &leaf     = scene.spring.leaf;
    const double e       = scene.geometry.interface_offset;
    const double L       = lever.length;
    const auto rectangle = [&](const double density, const double from, const double depth)
    {
      const double to = from + depth;
      return density * lever.width * (depth * L * L * L / 3. + L * (to * to * to - from * from * from) / 3.);
    };
    const double leaf_inertia = leaf.density * leaf.width * leaf.thickness * std::pow(leaf.length, 3) / 105.;
    const double sum = rectangle(layer.density, e, layer.thickness) + rectangle(lever.density, e + layer.thickness, lever.depth) +
                       lever.hub_inertia + leaf_inertia;
    std::printf("model %s: %.4f t mm2 at the hub, J by hand off by %.1e\n", model.c_str(), lever.hub_inertia, sum / J - 1.);
    EXPECT_NEAR(sum, J, 1e-4 * J);
  }
}
