// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sprag
{
  /// The result of work done in a process of its own.
  struct ChildAnswer
  {
    std::string text;    ///< what the work returned
    std::string failure; ///< empty if it came to its end, else how it ended: "crashes (Segmentation fault)"
  };

  /// Does `work` in a forked process and hands back the bytes that it returns, so that a library which crashes or does not come
  /// back on a damaged file takes nobody along. The child prints nothing, must catch its own exceptions and ends with its parent.
  /// After `seconds` > 0 it is killed. Throws AnalysisError where no process can be made, and when the run is
  /// interrupted meanwhile.
  ChildAnswer in_child_process(const std::function<std::string()> &work, double seconds);

  /// Executes the program of this name in the folder of the running one in place of this process, with the same arguments and its
  /// heap in large pages, unless GLIBC_TUNABLES says otherwise. Throws InputError where that fails.
  [[noreturn]] void execute_beside(const std::string &name, char **arguments);

  /// Keeps this process from growing by more than `bytes` from now on. This has no effect under an address sanitizer, which maps
  /// terabytes.
  void limit_growth(std::size_t bytes);
} // namespace sprag
