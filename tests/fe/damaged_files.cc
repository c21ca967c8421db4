// SPDX-License-Identifier: GPL-3.0-only
// Files that were cut short or in which bits were turned over: what reads them refuses or takes them, and comes back.
#include "fe/dynamics/basis_file.h"

#include "support/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  namespace fs = std::filesystem;

  class DamagedFiles : public ::testing::Test
  {
  protected:
    static std::string read_content(const fs::path &path)
    {
      std::ifstream stream(path, std::ios::binary);
      return { std::istreambuf_iterator<char>(stream), {} };
    }

    /// Calls `read` for copies with a byte turned over, and cut short, at places all over the file.
    template <class Read>
    static void for_all_damages(const fs::path &path, const unsigned int places, const Read &read)
    {
      const std::string whole = read_content(path);
      for (unsigned int i = 0; i < places; ++i)
      {
        const std::size_t at = (i * 2654435761u) % whole.size();
        std::string damaged  = whole;
        if (i % 3 == 0)
          damaged.resize(at);
        else
          damaged[at] = static_cast<char>(damaged[at] ^ (1 << i % 8));
        fs::remove(path);
        std::ofstream(path, std::ios::binary) << damaged;
        SCOPED_TRACE("byte " + std::to_string(at) + (i % 3 == 0 ? " cut" : " turned"));
        read();
      }
    }

    const TemporaryFolder temporary;
    const fs::path &folder = temporary.path;
  };

  TEST_F(DamagedFiles, BasesAreTakenWholeOrNotAtAll)
  {
    std::string bytes;
    for (unsigned int i = 0; i < 7200; ++i)
      bytes.push_back(static_cast<char>(i * 37));
    ASSERT_EQ(store_basis(folder, "key", bytes), "");
    ASSERT_EQ(load_basis(folder, "key"), bytes);
    EXPECT_EQ(load_basis(folder, "another key"), std::nullopt);
    unsigned int refused = 0;
    for_all_damages(folder / "basis-key.bin", 120,
                    [&]
                    {
                      const auto found = load_basis(folder, "key");
                      refused += found ? 0 : 1;
                      EXPECT_TRUE(!found || *found == bytes);
                    });
    EXPECT_GT(refused, 60u);
  }
} // namespace
