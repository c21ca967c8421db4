#pragma once

#include "scene/check.h"

namespace sprag
{
  /// Rules between the dimensions of a leaf spring, of an elastic cylinder and of what is calibrated.
  void check_spring(const Scene &scene, Rules &rules);
  void check_cylinder(const Scene &scene, Rules &rules);
  void check_calibration(const Scene &scene, Rules &rules);
} // namespace sprag
