// SPDX-License-Identifier: GPL-3.0-only
#include "results/warning.h"

#include <gtest/gtest.h>
#include <sstream>

using namespace sprag;

namespace
{
  const Warning soft = { "soft", "found", "effect", "remedy" };
}

TEST(WarningText, CountsAndNames)
{
  EXPECT_EQ(count_text({}), "no warnings");
  EXPECT_EQ(count_text({ soft }), "1 warning: soft");
  EXPECT_EQ(count_text({ soft, { "narrow", "", "", "" } }), "2 warnings: soft, narrow");
}

TEST(WarningText, NothingWithoutWarnings)
{
  EXPECT_EQ(to_text({}), "");
}

TEST(WarningText, HoldsAllPartsWithTheirLabels)
{
  EXPECT_EQ(to_text({ soft }), "\nWarning: soft\n  found:  found\n  effect: effect\n  remedy: remedy\n\n");
}

TEST(WarningText, LongSentencesAreWrappedWithoutLosingAWord)
{
  std::string sentence;
  for (int i = 0; i < 100; ++i)
    sentence += (i == 0 ? "" : " ") + std::string("word") + std::to_string(i);
  const std::string text = to_text({ { "long", sentence, "effect", "remedy" } });
  std::string joined;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    EXPECT_LE(line.size(), 100u);
    std::istringstream words(line);
    for (std::string word; words >> word;)
      joined += word + ' ';
  }
  EXPECT_NE(joined.find("found: " + sentence + ' '), std::string::npos);
}
