// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/stroke_fit.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  struct FoundNumber
  {
    UnknownNumber number;
    double value;
    double deviation; ///< standard deviation
    double low, high; ///< ends of the interval
  };

  /// An unknown that was not sought and by which the lever would follow the data.
  struct OneMoreUnknown
  {
    std::string name; ///< "Geometry/Cylinder radius"
    std::string unit;
    double change; ///< from the scene's value
    double share;  ///< of the squares of the residuals beyond noise that it explains
  };

  /// Result of identifying a lever from a measured stroke.
  struct Identification
  {
    std::vector<FoundNumber> found;
    std::vector<ChannelNoise> noise; ///< of the channels of the measurement
    Knowledge knowledge;
    IdentifiedLever lever;
    ModelCorrection correction;
    std::vector<UsedValue> used;
    double window       = 0.;    ///< left out behind each turn [mm]
    bool window_is_full = false; ///< whether one from the data ends where no more may be left out
    unsigned int rounds = 0;     ///< of fits, with new noise, window and correction
    bool converged      = false;
    std::vector<OneMoreUnknown> more; ///< that would explain the residuals, see more_unknowns()
  };

  /// Finds the unknowns of the scene's stroke. Throws AnalysisError where too few values are left.
  Identification identify(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);
} // namespace sprag
