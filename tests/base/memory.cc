// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/memory.h"

#include "support/temporary_folder.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// A /proc and /sys of our own.
  class AvailableMemoryTest : public ::testing::Test
  {
  protected:
    AvailableMemoryTest()
    {
      write("proc/meminfo", "MemTotal:       8000 kB\nMemFree:        10 kB\nMemAvailable:   4000 kB\n");
    }

    void write(const std::string &name, const std::string &text) const
    {
      folder.write(name, text);
    }

    double bytes() const
    {
      return available_memory(root).bytes;
    }

    const TemporaryFolder folder;
    const std::string root = folder.path;
  };

  TEST_F(AvailableMemoryTest, MachineWithoutGroups)
  {
    EXPECT_EQ(bytes(), 4000. * 1024.);
    EXPECT_EQ(available_memory(root).reason, "free on this machine");
  }

  TEST_F(AvailableMemoryTest, GroupsOfVersion2CountWithThoseAbove)
  {
    write("proc/self/cgroup", "0::/user/run\n");
    write("sys/fs/cgroup/user/run/memory.max", "max\n");
    write("sys/fs/cgroup/user/run/memory.current", "5\n");
    EXPECT_EQ(bytes(), 4000. * 1024.);
    write("sys/fs/cgroup/user/memory.max", "3000000\n");
    write("sys/fs/cgroup/user/memory.current", "1000000\n");
    write("sys/fs/cgroup/user/memory.stat", "anon 600000\ninactive_file 400000\n");
    EXPECT_EQ(bytes(), 2400000.);
    EXPECT_NE(available_memory(root).reason.find("control group"), std::string::npos);
    write("sys/fs/cgroup/user/run/memory.max", "1000\n");
    EXPECT_EQ(bytes(), 995.);
  }

  TEST_F(AvailableMemoryTest, GroupOfAContainer)
  {
    write("proc/self/cgroup", "0::/\n");
    write("sys/fs/cgroup/memory.max", "2000000\n");
    write("sys/fs/cgroup/memory.current", "500000\n");
    EXPECT_EQ(bytes(), 1500000.);
  }

  TEST_F(AvailableMemoryTest, GroupsOfVersion1)
  {
    write("proc/self/cgroup", "3:cpu:/jobs\n5:memory:/jobs\n");
    write("sys/fs/cgroup/memory/jobs/memory.limit_in_bytes", "2000000\n");
    write("sys/fs/cgroup/memory/jobs/memory.usage_in_bytes", "1500000\n");
    write("sys/fs/cgroup/memory/jobs/memory.stat", "total_inactive_file 100000\n");
    EXPECT_EQ(bytes(), 600000.);
  }
} // namespace
