// SPDX-License-Identifier: GPL-3.0-only
#include "base/progress.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <sstream>

using namespace sprag;

namespace
{
  struct TimedRun
  {
    explicit TimedRun(const ProgressStyle style)
        : progress(stream, style, 130., [this] { return now; })
    {
    }

    void step(const double done)
    {
      now += 0.01;
      progress.update(done, { done, 14.6389, -11.8884, 4 });
    }

    double now = 100.;
    std::ostringstream stream;
    Progress progress;
  };

  std::size_t count(const std::string &text, const char character)
  {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), character));
  }
} // namespace

TEST(Progress, LogHasALineEveryTenth)
{
  TimedRun run(ProgressStyle::log);
  for (int i = 1; i <= 130; ++i)
    run.step(i);
  run.progress.finish();
  const std::string text = run.stream.str();
  EXPECT_EQ(count(text, '\n'), 10u) << text;
  EXPECT_EQ(count(text, '\r'), 0u);
  EXPECT_EQ(text.find(" 10 %  x   13.000 mm  P   14.639 N  Q  -11.888 N   4 it  0:01 left\n"), 0u) << text;
  EXPECT_NE(text.find("100 %"), std::string::npos);
}

TEST(Progress, TerminalRedrawsOneLineTenTimesASecond)
{
  TimedRun run(ProgressStyle::terminal);
  for (int i = 1; i <= 130; ++i)
    run.step(i);
  run.progress.finish();
  run.progress.finish();
  const std::string text = run.stream.str();
  EXPECT_EQ(count(text, '\n'), 1u);
  EXPECT_LE(count(text, '\r'), 15u);
  EXPECT_GE(count(text, '\r'), 12u);
  EXPECT_NE(text.find("[####################] 100 %  x  130.000 mm"), std::string::npos) << text;
}
