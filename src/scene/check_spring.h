#pragma once

#include "scene/check.h"

namespace sprag
{
  /// Rules between the dimensions of a leaf spring, of an elastic cylinder and of what is calibrated.
  std::vector<Violation> spring_violations(const Scene &scene);
  std::vector<Violation> cylinder_violations(const Scene &scene);
  std::vector<Violation> calibration_violations(const Scene &scene);
} // namespace sprag
