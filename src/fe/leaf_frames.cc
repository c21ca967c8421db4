#include "fe/leaf_frames.h"

#include "base/errors.h"
#include "scene/closed_form.h"

namespace sprag
{
  LeafFrames::LeafFrames(const Scene &scene, const std::string &folder)
      : rest_inclination(kinematics(scene.geometry, 0.).theta)
      , leaf(scene.spring.leaf, scene.analysis.plane)
      , last(leaf.rest())
      , frames(leaf.body(), folder, "leaf")
  {
  }

  void LeafFrames::write(const double theta, const double time)
  {
    try
    {
      last = leaf.steps(last, theta - rest_inclination).back();
    }
    catch (const AnalysisError &)
    {
      return;
    }
    frames.write(last.displacement, time);
  }
} // namespace sprag
