// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/process_time.h"

#include "base/unknown.h"

#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <unistd.h>

namespace sprag
{
  double wall_seconds()
  {
    std::ifstream stat("/proc/self/stat");
    stat.ignore(std::numeric_limits<std::streamsize>::max(), ')'); // the name of the program
    std::string field;
    for (int i = 3; i < 22; ++i) // the start is field 22 of proc(5), in clock ticks since the system's
      stat >> field;
    double start = 0.;
    timespec now{};
    if (!(stat >> start) || ::clock_gettime(CLOCK_BOOTTIME, &now) != 0)
      return unknown;
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
           start / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
} // namespace sprag
