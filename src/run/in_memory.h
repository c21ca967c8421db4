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

  /// Makes meshes of levers without inertia and keeps the last one for scenes that have the same.
  class StaticMeshes
  {
  public:
    /// Returns the scene's mesh, which lives until the next call. Throws InputError for an invalid one.
    const Mesh &cached_mesh(const Scene &scene);

    /// Returns the CPU time saved by reusing meshes [s].
    double seconds_saved() const
    {
      return saved;
    }

  private:
    std::string key;
    std::unique_ptr<Mesh> mesh;
    double cpu_seconds = 0.; ///< for the last mesh
    double saved       = 0.;
  };

  /// Returns the empty storage that the runs of one process share.
  InMemory run_in_memory();

  /// Returns the options of a run in memory, which prints nothing.
  RunOptions make_options(InMemory &in_memory);

  /// Returns whether a run along a drive or of a limit cycle estimates its errors.
  bool estimates_errors(const Scene &scene, const RunOptions &options);

  /// Returns the maker of models in time; all runs in memory share one.
  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options);
} // namespace sprag
