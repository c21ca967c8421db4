// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A rule between parameters that a scene breaks.
  struct Violation
  {
    std::string parameter;           ///< "Section/Name" of the one to be changed
    std::vector<std::string> others; ///< that the rule also depends on
    std::string rule;                ///< "must be ..."
  };

  /// Finds everything wrong with a scene that no single parameter shows: the cylinder must fit the lever and not reach the pivot,
  /// the contact must stay on the lever, the closed form must not lock, settings must not exclude each other. Each parameter
  /// alone is assumed to be in range.
  std::vector<Violation> violations(const Scene &scene);
} // namespace sprag
