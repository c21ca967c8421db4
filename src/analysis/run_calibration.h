#pragma once

#include "analysis/run.h"

namespace sprag
{
  /// Analysis/Type = calibration: parts that have the k and J asked for, and the constants of the reduced models for them.
  void run_calibration(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
