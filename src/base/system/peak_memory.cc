// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/peak_memory.h"

#include <fstream>
#include <string>

namespace sprag
{
  void reset_peak_memory()
  {
    std::ofstream("/proc/self/clear_refs") << "5";
  }

  double peak_memory()
  {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (word == "VmHWM:")
      {
        double kilobytes = 0.;
        status >> kilobytes;
        return 1024. * kilobytes;
      }
    return 0.;
  }
} // namespace sprag
