// SPDX-License-Identifier: GPL-3.0-only
#include "base/choices.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  enum class Colour
  {
    red,
    green,
    blue
  };

  const Choices<Colour> colours = { { "red", Colour::red }, { "green", Colour::green } };
} // namespace

TEST(Choices, WordsAndValuesStandForEachOther)
{
  EXPECT_EQ(word_for(colours, Colour::green), "green");
  EXPECT_EQ(value_for(colours, "red"), Colour::red);
}

TEST(Choices, WhatIsNoneOfThemIsRefused)
{
  EXPECT_THROW(word_for(colours, Colour::blue), std::out_of_range);
  EXPECT_THROW(value_for(colours, "blue"), std::out_of_range);
}

namespace
{
  SPRAG_ENUMERATION(Shade, dark_red, blue)
}

TEST(Choices, AnEnumerationNamesItsValues)
{
  EXPECT_EQ(enumerators<Shade>(), (Choices<Shade>{ { "dark_red", Shade::dark_red }, { "blue", Shade::blue } }));
  EXPECT_EQ(words_in(enumerator_words<Shade>()), (std::vector<std::string>{ "dark red", "blue" }));
}
