// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <iosfwd>

namespace sprag
{
  struct Scene;

  /// Throws InputError where an analysis gains nothing from as many processes of MPI: one that shares nothing, or a body in three
  /// dimensions that is too small for them.
  void require_useful_processes(const Scene &scene, unsigned int processes);

  /// Prints what each of several processes does in a run whose body they share.
  void print_processes(std::ostream &stream, const Scene &scene, unsigned int processes);
} // namespace sprag
