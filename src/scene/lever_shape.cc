#include "scene/lever_shape.h"

#include "scene/closed_form.h"

namespace sprag
{
  double lever_front(const Scene &scene)
  {
    const double bare = scene.geometry.interface_offset + scene.layer.thickness;
    return scene.plate.type == PlateType::none ? bare : bare + scene.plate.thickness + scene.plate.spacer;
  }

  double pocket_length(const Scene &scene)
  {
    const auto &frame = scene.frame;
    if (frame.pockets == 0)
      return 0.;
    return (scene.lever.length - frame.root - (frame.pockets + 1) * frame.rib) / frame.pockets;
  }

  std::array<double, 2> swept_contact(const Scene &scene)
  {
    return { { kinematics(scene.geometry, scene.drive.maximum()).s, kinematics(scene.geometry, scene.drive.minimum()).s } };
  }

  std::array<double, 2> friction_face(const Scene &scene)
  {
    if (scene.plate.type == PlateType::on_sensors)
      return { { scene.plate.begin, scene.plate.end } };
    const double begin = scene.lever.outline == LeverOutline::frame ? scene.frame.root + scene.frame.rib : 0.;
    return { { begin, scene.lever.length } };
  }
} // namespace sprag
