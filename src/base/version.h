// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns the version and, where it was built from a clone, the commit: "0.1.0 (1a2b3c4)". "+" behind the commit stands for
  /// changes that were not committed when the build was configured.
  std::string version();
} // namespace sprag
