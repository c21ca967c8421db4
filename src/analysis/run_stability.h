#pragma once

#include "analysis/run.h"

namespace sprag
{
  /// Vibrations of the slide at one x, undamped (modal) or judged (stability), and writes and prints what they are.
  void run_vibrations(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
