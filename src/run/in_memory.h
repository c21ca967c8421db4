// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "levers/dynamics.h"
#include "levers/static_meshes.h"
#include "program/in_memory.h"
#include "program/run_options.h"

#include <memory>

namespace sprag
{
  /// Returns what the runs of one process share, with nothing in it yet.
  InMemory run_in_memory();

  /// Returns the options of a run in memory, which prints nothing.
  RunOptions options_of(InMemory &in_memory);

  /// Returns whether a run estimates the errors of its results by others, which cost more than the run: not in memory, where runs
  /// stand beside finer ones.
  bool estimates_errors(const RunOptions &options);

  /// Returns what makes the models of a run in time: all runs in memory share one.
  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options);

  /// Returns what makes the mesh of a run without inertia, likewise.
  std::shared_ptr<StaticMeshes> static_meshes(const RunOptions &options);
} // namespace sprag
