// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/system/terminal.h"
#include "base/unknown.h"

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <limits>
#include <string>
#include <unistd.h>

namespace sprag
{
  /// Numbers that a line of progress shows beside the share done; NaN leaves one out.
  struct ProgressFields
  {
    double x                = unknown; ///< [mm]
    double P                = unknown; ///< [N]
    double Q                = unknown; ///< [N]
    unsigned int iterations = 0;       ///< of the last step; 0: left out
    double z                = unknown; ///< of a table [mm]
  };

  /// The kind of output that the lines of progress go to.
  enum class ProgressStyle
  {
    terminal, ///< one line, redrawn in place at most ten times a second
    log,      ///< a line every tenth of the way
    quiet     ///< nothing
  };

  /// Chooses the style for the standard error stream.
  ProgressStyle progress_style(bool quiet);

  /// Returns the seconds since some fixed instant, which no change of the system's time affects.
  double monotonic_seconds();

  /// Shows how far a run has come and how long it will still take, assuming that the rest goes as fast as what is done.
  class Progress
  {
  public:
    /// Returns the seconds since any fixed instant.
    using Clock = std::function<double()>;

    /// Shows progress towards `total` > 0, in the unit of update()'s `done`. The stream must outlive the object. Where the
    /// columns of a terminal are known, the bar is shorter or the fields are left out, so that share and time fit.
    Progress(std::ostream &stream, ProgressStyle style, double total, Clock clock = monotonic_seconds,
             std::size_t columns = terminal_width(STDERR_FILENO));

    /// Ends the line, also after an exception.
    ~Progress()
    {
      finish();
    }

    Progress &operator=(Progress &&) = delete;

    /// Sets how much an earlier run had done.
    void begin_at(double done);

    void update(double done, const ProgressFields &fields);

    /// Shows the last update and ends the line. Nothing may follow.
    void finish();

  private:
    std::string line(double share, const ProgressFields &fields) const;
    void redraw();
    void log(double share, const ProgressFields &fields);

    std::ostream &stream;
    const ProgressStyle style;
    const double total;
    const Clock clock;
    const double start = clock();
    const int columns;
    double first      = 0.; ///< share that was done before
    double last_drawn = -std::numeric_limits<double>::infinity();
    int logged_tenths = 0;
    std::size_t width = 0; ///< of the text in the terminal's line
    std::string latest;    ///< the line to be shown next or last
    bool finished = false;
  };
} // namespace sprag
