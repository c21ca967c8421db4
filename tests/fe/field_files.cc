// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/field_files.h"

#include "program/output_folder.h"

#include "mpi_environment.h"
#include "support/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <set>

using namespace sprag;

namespace
{
  class FieldFilesTest : public testing::Test
  {
  protected:
    std::set<std::string> names() const
    {
      std::set<std::string> result;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        result.insert(entry.path().filename());
      return result;
    }

    std::string text(const std::string &name) const
    {
      std::ifstream stream(folder / name);
      return { std::istreambuf_iterator<char>(stream), {} };
    }

    const TemporaryFolder temporary;
    const std::filesystem::path &folder = temporary.path;
  };

  FieldMesh square()
  {
    return {
      "bodies", { 0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0. }, { 0, 1, 2, 3 }, 4, { { "part", "1", "", 1, { 1, 1, 1, 1 } } }
    };
  }

  FieldMesh line()
  {
    return { "edge", { 0., 0., 0., 1., 0., 0. }, { 0, 1 }, 2, {} };
  }

  std::vector<std::vector<Field>> values()
  {
    return { { { "heat", "K", "", 1, { 1, 2, 3, 4 } } }, { { "flow", "W", "", 3, { 0, 0, 0, 1, 1, 0 } } } };
  }
} // namespace

TEST_F(FieldFilesTest, IndexListsFramesInTheOrderOfTimeWhateverThatOfWriting)
{
  FieldFiles files(folder, "run", { square(), line() });
  files.write(0.5, values());
  files.write(2., values());
  files.write(0.25, values());
  files.write(1., values());
  files.write(4., values());
  EXPECT_EQ(names(), (std::set<std::string>{ "bodies.xdmf", "edge.xdmf", "run-mesh.h5", "run-0000.h5", "run-0001.h5",
                                             "run-0002.h5", "run-0003.h5", "run-0004.h5" }));
  for (const std::string name : { "bodies", "edge" })
  {
    const auto index = text(name + ".xdmf");
    std::size_t last = 0;
    for (const auto &[time, file] :
         { std::pair("0.25", "0002"), { "0.5", "0000" }, { "1", "0003" }, { "2", "0001" }, { "4", "0004" } })
    {
      const auto begin = index.find("<Time Value=\"" + std::string(time) + "\"/>");
      const auto end   = index.find("</Grid>", begin);
      ASSERT_NE(begin, std::string::npos) << time;
      EXPECT_GT(begin, last);
      EXPECT_LT(index.find("run-" + std::string(file) + ".h5:/" + name, begin), end);
      last = begin;
    }
    EXPECT_EQ(index.substr(index.size() - 8), "</Xdmf>\n");
    EXPECT_EQ(index.find("</Xdmf>"), index.size() - 8);
  }
}

TEST_F(FieldFilesTest, OnlyFieldsAreRemoved)
{
  for (const std::string name : { "fields-0012.h5", "fields-mesh.h5", "fields.xdmf", "face.xdmf", "leaf-0000.h5", "mode-01.h5",
                                  "mode-01.xdmf", "fields.png", "result.h5", "fields-of-mine.h5", "modes.png" })
    std::ofstream(folder / name) << "something";
  remove_files(folder, is_field_file);
  EXPECT_EQ(names(), (std::set<std::string>{ "fields.png", "result.h5", "fields-of-mine.h5", "modes.png" }));
}
