#include "fe/leaf_frames.h"

#include "base/errors.h"
#include "scene/closed_form.h"

#include <cmath>

namespace sprag
{
  LeafFrames::LeafFrames(const Scene &scene, const std::string &folder)
      : rest_inclination(kinematics(scene.geometry, 0.).theta)
      , leaf(scene.spring.leaf, scene.analysis.plane)
      , frames(leaf.body(), folder, "leaf")
  {
  }

  void LeafFrames::write(const double theta, const double time)
  {
    const double turn  = theta - rest_inclination;
    const double least = 1e-9; // moves no point by more than a picture could show
    try
    {
      const auto rest = leaf.rest();
      frames.write(std::abs(turn) < least ? rest.displacement : leaf.steps(rest, turn).back().displacement, time);
    }
    catch (const AnalysisError &)
    {
    }
  }
} // namespace sprag
