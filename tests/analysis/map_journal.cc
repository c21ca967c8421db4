#include "analysis/map/map_journal.h"

#include "base/errors.h"
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
  class MapJournalTest : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;
    const std::string path = folder.path / "map.journal";
  };

  std::vector<std::string> lines_of(const std::string &path)
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

TEST_F(MapJournalTest, GivesBackEveryBit)
{
  const auto cells = some_cells();
  MapJournal(path, "a scene").append(cells);
  const MapJournal again(path, "a scene");
  expect_same_bits(again.cells(), cells);
  EXPECT_FALSE(again.dropped());
}

TEST_F(MapJournalTest, DropsATornLineWhereverItIsTornAndGoesOn)
{
  const auto cells = some_cells();
  MapJournal(path, "a scene").append(cells);
  const auto whole     = std::filesystem::file_size(path);
  const auto last_line = lines_of(path).back().size();
  auto fewer           = cells;
  fewer.erase(std::prev(fewer.end()));
  for (std::size_t missing = 1; missing <= last_line; ++missing)
  {
    std::filesystem::resize_file(path, whole - missing);
    {
      MapJournal torn(path, "a scene");
      expect_same_bits(torn.cells(), fewer);
      torn.append({ *std::prev(cells.end()) });
    }
    expect_same_bits(MapJournal(path, "a scene").cells(), cells);
  }
}

// Any character of a line changed or taken away: as a rule it would still read as numbers.
TEST_F(MapJournalTest, DropsAGarbledLineAndKeepsTheOthers)
{
  const auto cells = some_cells();
  MapJournal(path, "a scene").append(cells);
  const auto lines = lines_of(path);
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
        MapJournal journal(path, "a scene");
        expect_same_bits(journal.cells(), fewer);
        EXPECT_EQ(journal.damaged_lines(), 1u);
        journal.append({ *std::next(cells.begin()) });
      }
      expect_same_bits(MapJournal(path, "a scene").cells(), cells);
    }
}

TEST_F(MapJournalTest, DropsALineOfAnotherScenesJournal)
{
  MapJournal(path, "another scene").append(some_cells());
  const auto line = lines_of(path).at(1);
  std::filesystem::remove(path);
  {
    const MapJournal begun(path, "a scene");
  }
  std::ofstream(path, std::ios::app) << line << '\n';
  const MapJournal journal(path, "a scene");
  EXPECT_TRUE(journal.cells().empty());
  EXPECT_EQ(journal.damaged_lines(), 1u);
}

TEST_F(MapJournalTest, BeginsAnewForAnotherScene)
{
  MapJournal(path, "a scene").append(some_cells());
  {
    const MapJournal other(path, "another scene");
    EXPECT_TRUE(other.dropped());
    EXPECT_TRUE(other.cells().empty());
  }
  const MapJournal again(path, "another scene");
  EXPECT_FALSE(again.dropped());
  EXPECT_TRUE(again.cells().empty());
}

TEST_F(MapJournalTest, SurvivesATornHeader)
{
  std::ofstream(path) << "sprag";
  MapJournal(path, "a scene").append(some_cells());
  expect_same_bits(MapJournal(path, "a scene").cells(), some_cells());
}

TEST_F(MapJournalTest, BelongsToOneRun)
{
  const MapJournal held(path, "a scene");
  EXPECT_THROW(MapJournal(path, "a scene"), InputError);
}

TEST_F(MapJournalTest, RefusesAFolderThatIsNotThere)
{
  EXPECT_THROW(MapJournal(folder.path / "none" / "map.journal", "a scene"), InputError);
}
