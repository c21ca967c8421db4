// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/journal.h"

#include "analysis/map/map_farm.h"

#include "base/errors.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  class JournalTest : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;
    const std::string path = folder.path / "map.journal";

    void write(const MapCells &cells, const std::string &scene = "a scene") const
    {
      const Journal journal(path, "map", scene);
      append(journal, cells);
    }

    static void append(const Journal &journal, const MapCells &cells)
    {
      const auto [file, header] = journal.address();
      JournalPen(file, header).append(to_lines(cells));
    }

    static std::vector<std::string> to_lines(const MapCells &cells)
    {
      std::vector<std::string> lines;
      for (const auto &[site, cell] : cells)
        lines.push_back(to_line(site, cell));
      return lines;
    }
  };

  MapCells cells_in(const Journal &journal)
  {
    MapCells cells;
    for (const auto &line : journal.lines())
      cells.insert(parse_cell(line));
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

TEST_F(JournalTest, GivesBackEveryBit)
{
  const auto cells = some_cells();
  write(cells);
  const Journal again(path, "map", "a scene");
  expect_same_bits(cells_in(again), cells);
  EXPECT_FALSE(again.dropped());
}

TEST_F(JournalTest, DropsATornLineWhereverItIsTornAndGoesOn)
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
      Journal torn(path, "map", "a scene");
      expect_same_bits(cells_in(torn), fewer);
      append(torn, { *std::prev(cells.end()) });
    }
    expect_same_bits(cells_in(Journal(path, "map", "a scene")), cells);
  }
}

// Any character of a line changed or taken away: as a rule it would still read as numbers.
TEST_F(JournalTest, DropsAGarbledLineAndKeepsTheOthers)
{
  const auto cells = some_cells();
  write(cells);
  const auto lines = read_lines(path);
  ASSERT_EQ(lines.size(), cells.size() + 1);
  auto fewer = cells;
  fewer.erase(std::next(fewer.begin()));
  for (std::size_t i = 0; i < lines[2].size(); ++i)
    for (const bool taken_away : { true, false })
    {
      auto garbled = lines;
      if (taken_away)
        garbled[2].erase(i, 1);
      else
        garbled[2][i] = garbled[2][i] == '1' ? '2' : '1';
      std::ofstream output(path);
      for (const auto &line : garbled)
        output << line << '\n';
      output.close();
      {
        Journal journal(path, "map", "a scene");
        expect_same_bits(cells_in(journal), fewer);
        EXPECT_EQ(journal.damaged_lines(), 1u);
        append(journal, { *std::next(cells.begin()) });
      }
      expect_same_bits(cells_in(Journal(path, "map", "a scene")), cells);
    }
}

TEST_F(JournalTest, DropsALineOfAnotherScenesJournal)
{
  write(some_cells(), "another scene");
  const auto line = read_lines(path).at(1);
  std::filesystem::remove(path);
  {
    const Journal begun(path, "map", "a scene");
  }
  std::ofstream(path, std::ios::app) << line << '\n';
  const Journal journal(path, "map", "a scene");
  EXPECT_TRUE(cells_in(journal).empty());
  EXPECT_EQ(journal.damaged_lines(), 1u);
}

TEST_F(JournalTest, BeginsAnewForAnotherScene)
{
  write(some_cells());
  {
    const Journal other(path, "map", "another scene");
    EXPECT_TRUE(other.dropped());
    EXPECT_TRUE(cells_in(other).empty());
  }
  const Journal again(path, "map", "another scene");
  EXPECT_FALSE(again.dropped());
  EXPECT_TRUE(cells_in(again).empty());
}

TEST_F(JournalTest, SurvivesATornHeader)
{
  std::ofstream(path) << "sprag";
  write(some_cells());
  expect_same_bits(cells_in(Journal(path, "map", "a scene")), some_cells());
}

TEST_F(JournalTest, BelongsToOneRun)
{
  const Journal held(path, "map", "a scene");
  EXPECT_THROW(Journal(path, "map", "a scene"), InputError);
}

TEST_F(JournalTest, RefusesAFolderThatIsNotThere)
{
  EXPECT_THROW(Journal(folder.path / "none" / "map.journal", "map", "a scene"), InputError);
}
