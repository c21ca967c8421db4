// SPDX-License-Identifier: GPL-3.0-only
#include "base/version.h"

namespace sprag
{
  std::string version()
  {
    const std::string commit = SPRAG_COMMIT;
    return commit.empty() ? SPRAG_VERSION : SPRAG_VERSION " (" + commit + ")";
  }
} // namespace sprag
