#include "run/slide_probes.h"

#include "run/coarser_scene.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  SlideProbes probe_slide(const Scene &scene, const ContactPenalties &penalties, DynamicsMaker &maker)
  {
    SlideProbes result;
    result.soft  = judge(with_penalties(scene, penalties, 1. / softer), maker);
    Scene coarse = with_coarser_mesh(with_penalties(scene, penalties, 1.));
    if (scene.analysis.model == ModelType::condensed && scene.condensed.modes > 1)
    {
      coarse.condensed.modes = scene.condensed.modes / 2;
      const auto dynamics    = maker.make_with_modes(scene, coarse.condensed.modes);
      result.fewer_modes     = judge(dynamics.model(), held_drive(scene), scene.stability.modes);
    }
    DynamicsMaker of_coarse;
    result.coarse = judge(coarse, of_coarse);
    return result;
  }

  std::vector<ErrorPart> parts_of_slide(const Scene &scene, const SlideStability &found, const SlideProbes &probes,
                                        const std::function<double(const SlideStability &)> &value)
  {
    const auto difference = [&](const SlideStability &a, const SlideStability &b)
    { return std::abs((value(a) - value(b)) / value(found)); };
    const auto &on_mesh          = probes.fewer_modes ? *probes.fewer_modes : found;
    std::vector<ErrorPart> parts = { mesh_part(scene, difference(probes.coarse, on_mesh), order_of_forces(scene)),
                                     penalty_part(difference(probes.soft, found)) };
    if (probes.fewer_modes)
      parts.push_back({ "modes", difference(*probes.fewer_modes, found), "Try twice the Condensed/Modes." });
    return parts;
  }
} // namespace sprag
