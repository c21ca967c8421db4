// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/memory.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <linux/magic.h>
#include <optional>
#include <sstream>
#include <sys/resource.h>
#include <sys/vfs.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr double unlimited = std::numeric_limits<double>::infinity();

    /// A file with one number; none for "max" and where there is no such file.
    std::optional<double> number_in(const fs::path &file)
    {
      std::ifstream stream(file);
      double value = 0.;
      return stream >> value ? std::optional(value) : std::nullopt;
    }

    /// The number behind a name in a file of lines "name value", 0 if it is not there.
    double read_entry(const fs::path &file, const std::string &name)
    {
      std::ifstream stream(file);
      for (std::string line; std::getline(stream, line);)
      {
        std::istringstream words(line);
        std::string word;
        double value = 0.;
        if (words >> word >> value && word == name)
          return value;
      }
      return 0.;
    }

    double free_on_machine(const std::string &root)
    {
      const double kilobytes = read_entry(root + "/proc/meminfo", "MemAvailable:");
      return kilobytes > 0. ? 1024. * kilobytes : unlimited;
    }

    struct GroupFiles
    {
      const char *limit, *usage, *cache;
    };

    /// Least of what a group and those above it leave; files that were read can be forgotten by the system.
    double left_by(fs::path group, const fs::path &top, const GroupFiles &files)
    {
      double left = unlimited;
      for (;; group = group.parent_path())
      {
        const auto limit = number_in(group / files.limit), usage = number_in(group / files.usage);
        if (limit && usage)
          left = std::min(left, *limit - *usage + read_entry(group / "memory.stat", files.cache));
        if (group == top || !group.has_relative_path())
          return left;
      }
    }

    double left_by_groups(const std::string &root)
    {
      double left = unlimited;
      std::ifstream groups(root + "/proc/self/cgroup");
      for (std::string line; std::getline(groups, line);)
      {
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos)
          continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string name        = line.substr(second + 2); // without its leading slash
        const fs::path top            = root + "/sys/fs/cgroup";
        if (controllers.empty())
          left =
              std::min(left, left_by(name.empty() ? top : top / name, top, { "memory.max", "memory.current", "inactive_file" }));
        else if (("," + controllers + ",").find(",memory,") != std::string::npos)
          left = std::min(left, left_by(name.empty() ? top / "memory" : top / "memory" / name, top / "memory",
                                        { "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file" }));
      }
      return left;
    }

    double remaining_address_space()
    {
      rlimit limit = {};
      if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return unlimited;
      const double used = number_in("/proc/self/statm").value_or(0.) * static_cast<double>(::sysconf(_SC_PAGESIZE));
      return static_cast<double>(limit.rlim_cur) - used;
    }
  } // namespace

  AvailableMemory available_memory(const std::string &root)
  {
    AvailableMemory least = { free_on_machine(root), "free on this machine" };
    if (const double bytes = left_by_groups(root); bytes < least.bytes)
      least = { bytes, "left by the memory limit of the control group" };
    if (const double bytes = remaining_address_space(); bytes < least.bytes)
      least = { bytes, "left by the limit of the process (ulimit -v)" };
    return least;
  }

  double bytes_free_on_disk(const std::string &folder)
  {
    struct statfs file_system = {};
    if (::statfs(folder.c_str(), &file_system) != 0 || file_system.f_type == TMPFS_MAGIC)
      return 0.;
    return static_cast<double>(file_system.f_bavail) * static_cast<double>(file_system.f_bsize);
  }

  void reset_peak_memory()
  {
    std::ofstream("/proc/self/clear_refs") << "5";
  }

  double peak_memory()
  {
    return 1024. * read_entry("/proc/self/status", "VmHWM:");
  }
} // namespace sprag
