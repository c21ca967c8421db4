// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  /// Takes rights from this process for good, so that a library can run a stranger's script in it: to start programs, to reach
  /// other machines or processes, to open files for writing and to make, change or remove any (seccomp, Landlock), and to read
  /// anything but `readable`, files and folders with all below them (Landlock alone). Returns false where the system lacks one of
  /// the two; the other is taken even so.
  bool confine(const std::vector<std::string> &readable);
} // namespace sprag
