// SPDX-License-Identifier: GPL-3.0-only
#include "run/processes.h"

#include "base/errors.h"
#include "base/text.h"
#include "program/memory.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <ostream>

namespace sprag
{
  namespace
  {
    /// For each process. Two are as fast as one at three times as many, see tests/benchmarks/solid-cost.md.
    constexpr double least_displacements = 1e4;
  } // namespace

  void require_useful_processes(const Scene &scene, const unsigned int processes)
  {
    if (processes == 1 || works_in_parallel(scene.analysis.type))
      return;
    if (!shares_body(scene))
      throw InputError("only Analysis/Type = map and study, and Analysis/Dimension = 3 or auto, run in several processes: leave "
                       "out mpirun");
    const double displacements = expected_size(scene).displacements;
    if (scene.analysis.dimension == 3 && displacements > 0. && displacements < least_displacements * processes)
      throw InputError("about " + rounded_text(displacements) + " displacements are too few for " + std::to_string(processes) +
                       " processes, which need " + rounded_text(least_displacements) +
                       " each to be of any help: start fewer, or leave out mpirun");
  }

  void print_processes(std::ostream &stream, const Scene &scene, const unsigned int processes)
  {
    if (processes == 1 || works_in_parallel(scene.analysis.type))
      return;
    stream << "Processes:    " << processes
           << (scene.analysis.dimension == 3
                   ? ", which share stiffness, factors, solves and fields of the lever; the first alone follows the contact\n"
                   : ", of which a lever in a plane needs the first alone\n");
  }
} // namespace sprag
