// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"
#include "levers/dynamics.h"
#include "program/run_options.h"

#include <memory>
#include <string>

namespace sprag
{
  struct Scene;

  /// Makes meshes of levers without inertia, one after another; one that is as the last is not made again.
  class StaticMeshes
  {
  public:
    /// Returns the scene's mesh, which lives until the next one is asked for. Throws InputError for one that cannot serve.
    const Mesh &cached_mesh(const Scene &scene);

    /// Returns the CPU time that meshes which were used again did not take again [s].
    double seconds_saved() const
    {
      return saved;
    }

  private:
    std::string key;
    std::unique_ptr<Mesh> mesh;
    double cpu_seconds = 0.; ///< that it took
    double saved       = 0.;
  };

  /// Returns what the runs of one process share, with nothing in it yet.
  InMemory run_in_memory();

  /// Returns the options of a run in memory, which prints nothing.
  RunOptions make_options(InMemory &in_memory);

  /// Returns whether a run estimates the errors of its results by others, which cost more than the run: not in memory, where runs
  /// stand beside finer ones.
  bool estimates_errors(const RunOptions &options);

  /// Returns what makes the models of a run in time: all runs in memory share one.
  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options);

  /// Returns what makes the mesh of a run without inertia, likewise.
  std::shared_ptr<StaticMeshes> static_meshes(const RunOptions &options);
} // namespace sprag
