#include "run/slide_probes.h"

#include "run/coarser_scene.h"

#include <cmath>

namespace sprag
{
  SlideProbes probe_slide(const Scene &scene, const ContactPenalties &penalties, DynamicsMaker &maker)
  {
    SlideProbes result;
    result.soft = judge(with_penalties(scene, penalties, 1. / softer), maker);
    DynamicsMaker of_coarse;
    Scene coarse  = with_coarser_mesh(with_penalties(scene, penalties, 1.));
    result.coarse = judge(coarse, of_coarse);
    if (scene.analysis.model == ModelType::condensed && scene.condensed.modes > 1)
    {
      coarse.condensed.modes /= 2;
      result.coarse_of_fewer_modes = judge(coarse, of_coarse);
    }
    return result;
  }

  std::vector<ErrorPart> parts_of_slide(const Scene &scene, const SlideStability &found, const SlideProbes &probes,
                                        const std::function<double(const SlideStability &)> &value)
  {
    const auto difference = [&](const SlideStability &a, const SlideStability &b)
    { return std::abs((value(a) - value(b)) / value(found)); };
    std::vector<ErrorPart> parts = { mesh_part(scene, difference(probes.coarse, found), order_of_forces(scene)),
                                     penalty_part(difference(probes.soft, found)) };
    if (probes.coarse_of_fewer_modes)
      parts.push_back({ "modes", difference(*probes.coarse_of_fewer_modes, probes.coarse), "Try twice the Condensed/Modes." });
    return parts;
  }
} // namespace sprag
