#include "model/lever_frame.h"

#include "scene/closed_form.h"

#include <cmath>

namespace sprag
{
  LeverFrame lever_frame(const Scene &scene, const PortLayout &ports, const double lever_mass)
  {
    LeverFrame frame{ scene.geometry,
                      ports,
                      kinematics(scene.geometry, 0.).theta,
                      moment_law(scene.spring),
                      scene.support.stiffness,
                      support_damping(scene.support, lever_mass),
                      dealii::Vector<double>(ports.size()),
                      scene.plate.sensor_stiffness };
    frame.lengths                   = 1.;
    frame.lengths[ports.rotation()] = scene.geometry.pivot_distance;
    return frame;
  }

  double support_damping(const Support &support, const double lever_mass)
  {
    return 2. * support.damping * std::sqrt(support.stiffness * (support.mass + lever_mass));
  }
} // namespace sprag
