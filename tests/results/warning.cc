// SPDX-License-Identifier: GPL-3.0-only
#include "results/warning.h"

#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>

using namespace sprag;

namespace
{
  const Warning soft = { "soft", "found", "effect", "remedy" };
}

TEST(WarningsPage, HoldsTextsThatTakeTheValuesInTurn)
{
  const auto vibration = make_warning("hidden_vibration", { "5 mm", "4*", "2", "0.2", "0.1", "3", "0.1" });
  EXPECT_EQ(vibration.name, "hidden_vibration");
  EXPECT_EQ(vibration.found,
            "The slide at x = 5 mm vibrates by itself at 4* Hz, growing by 2 1/s, and Time/Step = 0.2 s damps that by "
            "more than a tenth of its growth: steps of up to 0.1 s do not.");
  EXPECT_EQ(vibration.effect, "P, Q and their peaks lack that vibration: the run models none above 3 Hz.");
  EXPECT_EQ(vibration.remedy, "Leave Time/Step out, so that steps adapt, or give one of 0.1 s or less.");
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
