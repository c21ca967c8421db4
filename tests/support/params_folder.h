// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <filesystem>

namespace sprag
{
  /// Returns the folder of the shipped scenes, params/ of the sources. Its path is compiled into one file alone, so that a
  /// compiler's cache serves other checkouts.
  std::filesystem::path params_folder();
} // namespace sprag
