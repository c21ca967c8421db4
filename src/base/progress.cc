#include "base/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr double redraw_interval = 0.1; // [s]
    constexpr int bar_length         = 20;

    double monotonic_seconds()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    std::string bar(const double share)
    {
      const int filled = static_cast<int>(std::floor(bar_length * share));
      return "[" + std::string(filled, '#') + std::string(bar_length - filled, '.') + "] ";
    }

    /// h:mm:ss, or m:ss below an hour.
    std::string duration_text(const double duration)
    {
      const long seconds = std::lround(duration);
      std::ostringstream text;
      text << std::setfill('0');
      if (seconds >= 3600)
        text << seconds / 3600 << ':' << std::setw(2) << seconds / 60 % 60;
      else
        text << seconds / 60;
      text << ':' << std::setw(2) << seconds % 60;
      return text.str();
    }

    void add_field(std::ostream &text, const char *symbol, const double value, const char *unit)
    {
      if (!std::isnan(value))
        text << "  " << symbol << ' ' << std::setw(8) << std::fixed << std::setprecision(3) << value << ' ' << unit;
    }
  } // namespace

  ProgressStyle progress_style(const bool quiet)
  {
    if (quiet)
      return ProgressStyle::quiet;
    const bool terminal = isatty(STDERR_FILENO) != 0 || std::getenv(terminal_variable) != nullptr;
    return terminal ? ProgressStyle::terminal : ProgressStyle::log;
  }

  Progress::Progress(std::ostream &output, const ProgressStyle chosen_style, const double whole)
      : Progress(output, chosen_style, whole, monotonic_seconds)
  {
  }

  Progress::Progress(std::ostream &output, const ProgressStyle chosen_style, const double whole, Clock time_source)
      : stream(output)
      , style(chosen_style)
      , total(whole)
      , clock(std::move(time_source))
      , start(clock())
  {
  }

  Progress::~Progress()
  {
    finish();
  }

  void Progress::update(const double done, const ProgressFields &fields)
  {
    const double share = std::clamp(done / total, 0., 1.);
    if (style == ProgressStyle::log)
      log(share, fields);
    else if (style == ProgressStyle::terminal)
    {
      latest = bar(share) + line(share, fields);
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
    std::ostringstream text;
    text << std::setw(3) << static_cast<int>(std::floor(100. * share + 1e-9)) << " %";
    add_field(text, "x", fields.x, "mm");
    add_field(text, "P", fields.P, "N");
    add_field(text, "Q", fields.Q, "N");
    if (fields.iterations > 0)
      text << "  " << std::setw(2) << fields.iterations << " it";
    const double elapsed = clock() - start;
    if (share >= 1.)
      text << "  " << duration_text(elapsed) << " in all";
    else if (share > 0.)
      text << "  " << duration_text(elapsed * (1. - share) / share) << " left";
    return text.str();
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
