#pragma once

#include "analysis/run.h"

namespace sprag
{
  /// Judges the scene's slides both ways over a grid of two parameters and finds the boundaries between kinds. All ranks of MPI
  /// call it. Until the map is complete its cells are in `map.journal`, from which the same scene goes on when started again;
  /// result.h5 is written at the end. Throws on all ranks what run() throws.
  void run_map(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
