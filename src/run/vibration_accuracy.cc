#include "run/vibration_accuracy.h"

#include "base/errors.h"
#include "run/coarser_scene.h"

#include <cmath>
#include <optional>

namespace sprag
{
  namespace
  {
    using Value = double (SlideStability::*)() const;

    /// The same slide by other models.
    struct Probes
    {
      SlideStability coarse;
      SlideStability soft;
      std::optional<SlideStability> coarse_of_fewer_modes;
    };

    Probes probe(const Scene &scene, const MeshedDynamics &dynamics, DynamicsMaker &maker)
    {
      Probes result;
      result.soft = judge(with_penalties(scene, dynamics.penalties, 1. / softer), maker);
      // The run's own mesh stays in the maker.
      DynamicsMaker of_coarse;
      Scene coarse  = with_coarser_mesh(with_penalties(scene, dynamics.penalties, 1.));
      result.coarse = judge(coarse, of_coarse);
      if (scene.analysis.model == ModelType::condensed && scene.condensed.modes > 1)
      {
        coarse.condensed.modes /= 2;
        result.coarse_of_fewer_modes = judge(coarse, of_coarse);
      }
      return result;
    }

    ErrorEstimate estimate(const Scene &scene, const SlideStability &found, const Probes &probes, const std::string &quantity,
                           const std::string &relative_to, const Value value)
    {
      const auto difference = [&](const SlideStability &a, const SlideStability &b)
      { return std::abs(((a.*value)() - (b.*value)()) / (found.*value)()); };
      ErrorEstimate result{ quantity, relative_to, {}, {} };
      result.parts = { mesh_part(scene, difference(probes.coarse, found), order_of_forces(scene)),
                       penalty_part(difference(probes.soft, found)) };
      if (probes.coarse_of_fewer_modes)
        result.parts.push_back(
            { "modes", difference(*probes.coarse_of_fewer_modes, probes.coarse), "Try twice the Condensed/Modes." });
      return result;
    }

    std::vector<ErrorEstimate> unknown(const std::string &reason)
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
      return unknown(no_coarser_mesh);
    if (!(found.frequency() > 0.))
      return unknown("No estimate: the mode that grows most does not oscillate.");
    try
    {
      const auto probes = probe(scene, dynamics, maker);
      if (!(probes.coarse.frequency() > 0.) || !(probes.soft.frequency() > 0.))
        return unknown("No estimate: on a coarser mesh or with a softer penalty the mode that grows most does not oscillate.");
      return { estimate(scene, found, probes, "growth_rate", "it, and beyond 100 % the verdict may flip",
                        &SlideStability::growth_rate),
               estimate(scene, found, probes, "frequency", "it", &SlideStability::frequency) };
    }
    catch (const AnalysisError &error)
    {
      return unknown("No estimate: in the comparison " + std::string(error.what()) + ".");
    }
  }
} // namespace sprag
