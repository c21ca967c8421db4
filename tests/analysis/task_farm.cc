// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/task_farm.h"

#include "analysis/map/map.h"

#include "base/errors.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  class ResultsLogTest : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;
    const std::string path = folder.path / "map.journal";

    void write(const MapCells &cells, const std::string &scene = "a scene") const
    {
      const ResultsLog results_log(path, "map", scene);
      append(results_log, cells);
    }

    static void append(const ResultsLog &results_log, const MapCells &cells)
    {
      const auto [file, header] = results_log.address();
      append_lines(file, header, to_lines(cells));
    }

    static std::vector<std::string> to_lines(const MapCells &cells)
    {
      std::vector<std::string> lines;
      for (const auto &[site, cell] : cells)
        lines.push_back(to_line(site, cell));
      return lines;
    }
  };

  MapCells cells_in(const ResultsLog &results_log)
  {
    MapCells cells;
    for (const auto &line : results_log.lines())
    {
      std::pair<MapSite, MapCell> site_and_cell;
      read_line(line, site_and_cell);
      cells.insert(site_and_cell);
    }
    return cells;
  }

  std::vector<std::string> read_lines(const std::string &path)
  {
    std::ifstream input(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(input, line);)
      lines.push_back(line);
    return lines;
  }

  MapCells some_cells()
  {
    MapCells cells;
    for (unsigned int i = 0; i < 5; ++i)
    {
      MapCell cell;
      for (std::size_t k = 0; k < n_cell_values; ++k)
        cell.values[k] = std::ldexp(1. / 3. + static_cast<double>(k), 200 * static_cast<int>(i) - 500);
      cell.values[3] = std::numeric_limits<double>::quiet_NaN();
      cell.values[4] = -0.;
      cell.values[5] = std::numeric_limits<double>::denorm_min();
      cell.values[6] = -std::numeric_limits<double>::infinity();
      cells.insert({ { i + 0.125, 3. - i }, cell });
    }
    return cells;
  }

  void expect_same_bits(const MapCells &found, const MapCells &expected)
  {
    ASSERT_EQ(found.size(), expected.size());
    for (auto a = found.begin(), b = expected.begin(); a != found.end(); ++a, ++b)
    {
      EXPECT_EQ(a->first.first, b->first.first);
      EXPECT_EQ(a->first.second, b->first.second);
      EXPECT_EQ(std::memcmp(&a->second.values, &b->second.values, sizeof a->second.values), 0);
    }
  }
} // namespace

TEST_F(ResultsLogTest, DropsATornLineWhereverItIsTornAndGoesOn)
{
  const auto cells = some_cells();
  write(cells);
  const auto whole     = std::filesystem::file_size(path);
  const auto last_line = read_lines(path).back().size();
  auto fewer           = cells;
  fewer.erase(std::prev(fewer.end()));
  for (std::size_t missing = 1; missing <= last_line; ++missing)
  {
    std::filesystem::resize_file(path, whole - missing);
    {
      ResultsLog torn(path, "map", "a scene");
      expect_same_bits(cells_in(torn), fewer);
      append(torn, { *std::prev(cells.end()) });
    }
    expect_same_bits(cells_in(ResultsLog(path, "map", "a scene")), cells);
  }
}

TEST_F(ResultsLogTest, DropsALineOfAnotherScenesLog)
{
  write(some_cells(), "another scene");
  const auto line = read_lines(path).at(1);
  std::filesystem::remove(path);
  {
    const ResultsLog begun(path, "map", "a scene");
  }
  std::ofstream(path, std::ios::app) << line << '\n';
  const ResultsLog results_log(path, "map", "a scene");
  EXPECT_TRUE(cells_in(results_log).empty());
  EXPECT_EQ(results_log.damaged_lines(), 1u);
}

TEST(TaskFarm, NodesShareAllGroupsByTheirRanks)
{
  PieceGroups groups;
  for (std::size_t i = 0; i < 9; ++i)
    groups.push_back({ i });
  const std::vector<unsigned int> nodes = { 0, 0, 2 }; // of three ranks
  EXPECT_EQ(groups_on_node(groups, nodes, 0), (PieceGroups{ { 0 }, { 1 }, { 3 }, { 4 }, { 6 }, { 7 } }));
  EXPECT_EQ(groups_on_node(groups, nodes, 2), (PieceGroups{ { 2 }, { 5 }, { 8 } }));
}
