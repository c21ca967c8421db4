// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <iosfwd>
#include <streambuf>
#include <string>

namespace sprag
{
  // Environment variables by which mpirun's processes know the terminal of its standard error and output: its width.
  inline constexpr const char *terminal_variable        = "SPRAG_TERMINAL";
  inline constexpr const char *output_terminal_variable = "SPRAG_OUTPUT_TERMINAL";

  /// Returns whether a standard descriptor is a terminal's. Processes of mpirun ask these variables: it gives them a
  /// pseudo-terminal in any case.
  bool is_terminal(int descriptor);

  /// Returns the columns of the terminal behind a standard descriptor; 0 where there is none or they are unknown.
  std::size_t terminal_width(int descriptor);

  // ANSI colours of what a terminal shows.
  inline constexpr const char *warning_colour = "33";
  inline constexpr const char *error_colour   = "31";

  /// Returns the text in a colour if the descriptor of its stream is a terminal's and the environment has no NO_COLOR.
  std::string coloured(const std::string &text, int descriptor, const char *colour);

  /// Breaks a line between its words, at most `width` characters each. What continues stands below the text behind a label.
  std::string wrapped(std::string line, std::size_t width);

  /// Breaks the lines that a stream prints on a terminal; a line that is drawn over another is cut instead.
  class TerminalLines : public std::streambuf
  {
  public:
    TerminalLines(std::ostream &stream, int descriptor);
    ~TerminalLines() override;
    TerminalLines(const TerminalLines &)            = delete;
    TerminalLines &operator=(const TerminalLines &) = delete;

  protected:
    int_type overflow(int_type c) override;
    int sync() override;

  private:
    std::ostream &stream;
    std::streambuf *const terminal = stream.rdbuf();
    const std::size_t width;
    std::string line;           ///< that has not ended
    bool drawn_over    = false; ///< since a carriage return
    std::size_t column = 0;     ///< of a line that is drawn over another

    void put_line();
  };
} // namespace sprag
