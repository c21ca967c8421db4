// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <exception>
#include <string>

namespace sprag
{
  /// Returns a library's message in one line, without what it says about its sources.
  std::string error_message(const std::exception &error);
} // namespace sprag
