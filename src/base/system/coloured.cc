// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/coloured.h"

#include "base/system/terminal.h"

#include <cstdlib>

namespace sprag
{
  std::string coloured(const std::string &text, const int descriptor, const char *const colour)
  {
    const char *const refused = std::getenv("NO_COLOR");
    const bool has_colours    = is_terminal(descriptor) && (refused == nullptr || *refused == '\0');
    return has_colours ? std::string("\033[") + colour + 'm' + text + "\033[0m" : text;
  }
} // namespace sprag
