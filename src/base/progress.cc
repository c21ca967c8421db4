// SPDX-License-Identifier: GPL-3.0-only
#include "base/progress.h"

#include "base/system/terminal.h"
#include "base/text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr double redraw_interval = 0.1; // [s]
    constexpr int longest_bar        = 20;

    /// At most `room` characters with its frame.
    std::string bar(const double share, const int room)
    {
      const int length = std::min(room - 3, longest_bar);
      const int filled = static_cast<int>(std::floor(length * share));
      return length < 1 ? "" : "[" + std::string(filled, '#') + std::string(length - filled, '.') + "] ";
    }

    /// h:mm:ss, or m:ss below an hour.
    std::string duration_text(const double duration)
    {
      const long seconds = std::lround(duration);
      if (seconds < 3600)
        return formatted("%ld:%02ld", seconds / 60, seconds % 60);
      return formatted("%ld:%02ld:%02ld", seconds / 3600, seconds / 60 % 60, seconds % 60);
    }

    std::string field(const char *symbol, const double value, const char *unit)
    {
      return std::isnan(value) ? "" : formatted("  %s %8.3f %s", symbol, value, unit);
    }
  } // namespace

  ProgressStyle progress_style(const bool quiet)
  {
    if (quiet)
      return ProgressStyle::quiet;
    return is_terminal(STDERR_FILENO) ? ProgressStyle::terminal : ProgressStyle::log;
  }

  double monotonic_seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  Progress::Progress(std::ostream &output, const ProgressStyle chosen_style, const double whole, Clock time_source,
                     const std::size_t terminal_columns)
      : stream(output)
      , style(chosen_style)
      , total(whole)
      , clock(std::move(time_source))
      , columns(terminal_columns > 0 ? static_cast<int>(terminal_columns) : std::numeric_limits<int>::max())
  {
  }

  void Progress::begin_at(const double done)
  {
    first         = std::clamp(done / total, 0., 1.);
    logged_tenths = static_cast<int>(std::floor(10. * first + 1e-9));
  }

  void Progress::update(const double done, const ProgressFields &fields)
  {
    const double share = std::clamp(done / total, 0., 1.);
    if (style == ProgressStyle::log)
      log(share, fields);
    else if (style == ProgressStyle::terminal)
    {
      // The last column stays free.
      const auto room = [&] { return columns - 1 - static_cast<int>(latest.size()); };
      latest          = line(share, fields);
      if (room() < 0)
        latest = line(share, {});
      latest = bar(share, room()) + latest;
      if (clock() - last_drawn >= redraw_interval)
        redraw();
    }
  }

  void Progress::finish()
  {
    if (!finished && style == ProgressStyle::terminal && !latest.empty())
    {
      redraw();
      stream << '\n' << std::flush;
    }
    finished = true;
  }

  std::string Progress::line(const double share, const ProgressFields &fields) const
  {
    std::string text = formatted("%3.0f %%", std::floor(100. * share + 1e-9)) + field("x", fields.x, "mm") +
                       field("z", fields.z, "mm") + field("P", fields.P, "N") + field("Q", fields.Q, "N");
    if (fields.iterations > 0)
      text += formatted("  %2u it", fields.iterations);
    const double elapsed = clock() - start;
    if (share >= 1.)
      text += "  " + duration_text(elapsed) + " in all";
    else if (share > first)
      text += "  " + duration_text(elapsed * (1. - share) / (share - first)) + " left";
    return text;
  }

  void Progress::redraw()
  {
    // Blanks wipe what a longer line left behind.
    stream << '\r' << latest << std::string(width - std::min(width, latest.size()), ' ') << std::flush;
    width      = latest.size();
    last_drawn = clock();
  }

  void Progress::log(const double share, const ProgressFields &fields)
  {
    const int tenths = static_cast<int>(std::floor(10. * share + 1e-9));
    if (tenths > logged_tenths)
    {
      stream << line(share, fields) << std::endl;
      logged_tenths = tenths;
    }
  }
} // namespace sprag
