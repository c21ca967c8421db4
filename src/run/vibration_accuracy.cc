// SPDX-License-Identifier: GPL-3.0-only
#include "run/vibration_accuracy.h"

#include "base/errors.h"
#include "run/coarser_scene.h"
#include "run/slide_probes.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    std::vector<ErrorEstimate> unknown_growth(const std::string &reason)
    {
      return { { "growth_rate", "", {}, reason }, { "frequency", "", {}, reason } };
    }
  } // namespace

  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker)
  {
    if (!is_meshed(scene.analysis.model))
      return {};
    if (!scene.mesh.file.empty())
      return unknown_growth(no_coarser_mesh);
    if (!(found.frequency() > 0.))
      return unknown_growth("No estimate: the mode that grows most does not oscillate.");
    try
    {
      const auto probes = probe_slide(scene, dynamics.penalties, maker);
      if (!(probes.coarse.frequency() > 0.) || !(probes.soft.frequency() > 0.))
        return unknown_growth(
            "No estimate: on a coarser mesh or with a softer penalty the mode that grows most does not oscillate.");
      const auto parts = [&](const auto &value) { return parts_of_slide(scene, found, probes, value); };
      return { { "growth_rate",
                 "it, and beyond 100 % the verdict may flip",
                 parts([](const SlideStability &slide) { return slide.growth_rate(); }),
                 {} },
               { "frequency", "it", parts([](const SlideStability &slide) { return slide.frequency(); }), {} } };
    }
    catch (const AnalysisError &error)
    {
      return unknown_growth("No estimate: in the comparison " + std::string(error.what()) + ".");
    }
    catch (const InputError &error)
    {
      return unknown_growth("No estimate: the coarser mesh cannot serve: " + std::string(error.what()) + ".");
    }
  }
} // namespace sprag
