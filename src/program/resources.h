// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/system/memory.h"

#include <iosfwd>
#include <optional>
#include <string>

namespace sprag
{
  struct Scene;

  /// Expected cost of a run.
  struct ExpectedCost
  {
    double cpu_seconds = 0.; ///< of all processes; NaN if unknown
    double bytes       = 0.; ///< largest resident memory of all processes
    std::string unknown;     ///< why the time is unknown, a sentence; else empty
  };

  constexpr double formula_start_seconds = 0.03; ///< CPU time of a start without models where slowness() is 1 [s]

  /// Estimates the cost of what follows_formulas().
  ExpectedCost formula_cost(const Scene &scene);

  /// Returns how much longer than on the machine that the constants of estimates were measured on a short calculation takes here,
  /// as found at the first call.
  double slowness();

  /// Prints the estimate in a line.
  void print_cost(std::ostream &stream, const ExpectedCost &cost);

  /// The size of a scene's finite-element model, estimated before there is a mesh.
  struct ExpectedSize
  {
    double displacements = 0.; ///< degrees of freedom
    double n_interface   = 0.; ///< the degrees of freedom on the friction face, which the contact acts on
  };

  /// Estimates the size of one lever, bar or frame, with an elastic cylinder, as meshes/ makes them. Both numbers are 0 where
  /// nothing is meshed, or the mesh is the user's.
  ExpectedSize expected_size(const Scene &scene);

  /// Estimates the number of rows of the table; of adaptive steps the fewest that there can be.
  double expected_rows(const Scene &scene);

  /// Estimates the largest resident memory of a run on `processes` processes [bytes], within 1.3 times what was measured:
  /// libraries, matrices of the meshed parts and rows kept for the summary.
  double expected_memory(const Scene &scene, unsigned int processes = 1);

  /// Factors of a body in three dimensions that are kept in files, as memory does not suffice.
  struct FactorFiles
  {
    std::string folder;
    double memory;             ///< that the run would need without them [bytes]
    AvailableMemory available; ///< less than that
    double memory_with_files;  ///< that it needs with them [bytes]
    double bytes;              ///< of the files
  };

  /// Returns what a run on `processes` processes with results in `folder` keeps in files: nothing where its memory suffices, or
  /// where memory or disk do not even so.
  std::optional<FactorFiles> factor_files(const Scene &scene, unsigned int processes, const std::string &folder);

  /// Returns a clause with all numbers.
  std::string to_text(const FactorFiles &files);

  /// Throws InputError where expected_memory() exceeds what the system has left and there are no factor_files(), as without a
  /// folder; the message tells both and what to change. It throws too where the run would have more than 1e7 rows, which no
  /// picture shows.
  void require_memory(const Scene &scene, unsigned int processes = 1, const std::string &folder = "");
} // namespace sprag
