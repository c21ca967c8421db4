#include "scene/check_parts.h"

#include "base/text.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    /// Of the part that carries the friction face [MPa].
    double young_modulus_of_face(const Scene &scene)
    {
      if (scene.layer.thickness > 0.)
        return scene.layer.young_modulus;
      return scene.plate.type == PlateType::on_sensors ? scene.plate.young_modulus : scene.lever.young_modulus;
    }

    /// Some 20 times the automatic penalty without inertia, ten times that in time. Beyond that single points between the nodes
    /// carry the pressure on more and more of the way, then Newton's method fails, and a slide that is there is not found.
    double largest_penalty(const Scene &scene)
    {
      constexpr double over_cells = 250., over_layer = 1200., over_cells_without_layer = 100.;
      const double E = young_modulus_of_face(scene);
      const double t = scene.layer.thickness;
      const double h = scene.mesh.face_size;
      return t > 0. ? std::max(over_cells * E / h, over_layer * E / t) : over_cells_without_layer * E / h;
    }
  } // namespace

  void check_penalty(const Scene &scene, Rules &rules)
  {
    const auto add =
        [&](const std::string &parameter, const std::optional<double> &value, const double largest, const std::string &effect)
    {
      rules.need(!value || *value <= largest, parameter,
                 { "Mesh/Face size", "Friction layer/Thickness", "Friction layer/Young's modulus", "Lever/Young's modulus",
                   "Friction plate/Young's modulus" },
                 "must be <= " + rounded_text(largest) + " N/mm3 for this layer and mesh: a stiffer one " + effect +
                     " lets Newton's method fail; leave it at auto");
    };
    const double largest = largest_penalty(scene);
    add("Contact/Penalty", scene.contact.penalty, largest,
        "moves P by less than 1e-4, lets single points carry the pressure and");
    add("Contact/Tangential penalty", scene.contact.tangential_penalty, 10. * largest, "moves Q by less than 1e-4 and");
  }
} // namespace sprag
