#include "fe/leaf/leaf_spring.h"
#include "fe/solid/solid_mass.h"
#include "levers/dynamics.h"
#include "scene/held_slide.h"
#include "verification/solid_run.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

// Parts of a lever in three dimensions with inertia: leaf spring, tip mass, friction plate on sensors.

using namespace sprag;

namespace
{
  const std::size_t first_sensor = columns_across().size(); ///< among the columns across, where the axis is fixed

  /// Model A without contraction, where plane stress is exact.
  Scene in_space(const AnalysisType type)
  {
    Scene scene               = solid_model_a(0.);
    scene.mesh.elements_across = 2;
    scene.analysis.type       = type;
    scene.analysis.model      = ModelType::condensed;
    scene.condensed.modes     = 12;
    scene.stability.position  = 15.;
    scene.stability.critical  = "none";
    scene.friction.law        = CoulombFriction{ 0.73 }; // which nothing delays, see linearise()
    return scene;
  }

  Scene in_plane(Scene scene)
  {
    scene.analysis.dimension = 2;
    return scene;
  }

  /// A leaf spring heavy enough to be felt, a tip mass, and a support that feels the momentum of both.
  Scene on_leaf_with_tip(Scene scene)
  {
    scene.spring.type           = SpringType::leaf;
    scene.spring.leaf.thickness = 2.;
    scene.lever.tip_mass        = 2e-5;
    scene.support.type          = SupportType::sprung;
    return with_leaf_spring(scene);
  }

  /// A plate on pads of half the width each, which are those of the plane.
  Scene on_sensors(Scene scene)
  {
    scene.plate.type          = PlateType::on_sensors;
    scene.plate.poisson_ratio = scene.lever.poisson_ratio;
    scene.plate.sensors       = { 105., 195. };
    scene.plate.sensor_width  = 0.5 * scene.lever.width;
    return scene;
  }

  /// With as many of the lowest modes as move within the plane's frequencies.
  Dynamics with_modes_of(const Scene &plane, const Scene &solid, DynamicsMaker &of_plane, DynamicsMaker &of_solid)
  {
    (void)plane; (void)solid; (void)of_plane; (void)of_solid;
    return {};
  }

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  std::vector<Row> steps_of(DynamicModel &model, const Scene &scene, const unsigned int steps)
  {
    const double dt = scene.drive.duration() / steps;
    auto motion     = model.initial_motion(scene.drive.at(0.));
    std::vector<Row> result;
    for (unsigned int i = 1; i <= steps; ++i)
    {
      auto outcome = model.step(motion, scene.drive.at(i * dt), StepWeights{ dt, 0., 0., 0.25, 0.5 });
      EXPECT_TRUE(outcome.motion) << i;
      if (!outcome.motion)
        break;
      motion = *outcome.motion;
      model.observe(motion, result.emplace_back());
    }
    return result;
  }
} // namespace

TEST(SolidPartsInTime, Probe)
{
  for (const int which : { 0, 1, 2 })
  {
    Scene scene = in_space(AnalysisType::transient);
    if (which == 1)
      scene = on_leaf_with_tip(scene);
    if (which == 2)
      scene = on_sensors(scene);
    scene.drive = Drive(DriveProfile::triangle, 18., 20., 112., 1., 5e-3);
    DynamicsMaker of_plane(false), of_solid(false);
    const auto plane = of_plane.make(in_plane(scene));
    Scene more       = scene;
    more.condensed.modes = 24;
    const auto all   = of_solid.make(more);
    const auto &stiffness = all.solid->modes.stiffness;
    for (const double s : plane.lever->condensed.lever->stiffness)
    {
      double best = 1e300;
      for (const double t : stiffness)
        if (std::abs(t - s) < std::abs(best - s))
          best = t;
      std::printf("%d: %.3f Hz off by %.1e\n", which, std::sqrt(s) / 2 / M_PI, best / s - 1);
    }
    for (const double t : stiffness)
      std::printf(" %.2f", std::sqrt(t) / 2 / M_PI);
    std::printf("\n");
    const double last = plane.lever->condensed.lever->stiffness.back() * 1.00001;
    const auto number = std::count_if(stiffness.begin(), stiffness.end(), [&](double t) { return t <= last; });
    const auto solid  = of_solid.make_with_modes(more, static_cast<unsigned int>(number));
    const auto a      = steps_of(plane.model(), scene, 160);
    const auto b      = steps_of(solid.model(), scene, 160);
    for (const Column c : { Column::P, Column::Q, Column::theta, Column::F, Column::Q_support })
      std::printf("%d %s %.2e of %g\n", which, column_info(c).name.c_str(), difference(a, b, c), largest(a, c));
    double d = 0., l = 0.;
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t i = 0; i < a[k].sensor_forces.size(); ++i)
      {
        d = std::max(d, std::abs(a[k].sensor_forces[i] - b[k].sensor_forces.at(i)));
        l = std::max(l, std::abs(a[k].sensor_forces[i]));
      }
    std::printf("sensors %.2e of %g\n", d, l);
  }
}
