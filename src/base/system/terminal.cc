// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/terminal.h"

#include "base/system/open_mpi.h"

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    const char *columns_outside(const int descriptor)
    {
      return std::getenv(descriptor == STDERR_FILENO ? terminal_variable : output_terminal_variable);
    }
  } // namespace

  bool is_terminal(const int descriptor)
  {
    return under_mpi() ? columns_outside(descriptor) != nullptr : ::isatty(descriptor) != 0;
  }

  std::size_t terminal_width(const int descriptor)
  {
    winsize size = {};
    if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
      return size.ws_col;
    const char *const columns = columns_outside(descriptor);
    return columns == nullptr ? 0 : std::strtoul(columns, nullptr, 10);
  }

  std::string coloured(const std::string &text, const int descriptor, const char *const colour)
  {
    const char *const refused = std::getenv("NO_COLOR");
    const bool has_colours    = is_terminal(descriptor) && (refused == nullptr || *refused == '\0');
    return has_colours ? std::string("\033[") + colour + 'm' + text + "\033[0m" : text;
  }

  std::string wrapped(std::string line, const std::size_t width)
  {
    const auto first  = line.find_first_not_of(' ');
    const auto gap    = line.find("  ", first);
    const auto behind = line.find_first_not_of(' ', gap);
    const auto indent = gap == std::string::npos || behind == std::string::npos || 2 * behind > width ? first : behind;
    std::string text;
    while (line.size() > width)
    {
      auto cut = line.rfind(' ', width);
      if (cut == std::string::npos || cut <= indent)
        cut = line.find(' ', std::max(width, indent));
      const auto next = line.find_first_not_of(' ', cut);
      if (next == std::string::npos)
        break;
      text += line.substr(0, cut) + '\n';
      line = std::string(indent, ' ') + line.substr(next);
    }
    return text + line;
  }

  TerminalLines::TerminalLines(std::ostream &stream_, const int descriptor)
      : stream(stream_)
      , width(terminal_width(descriptor))
  {
    // A terminal of a few columns would hold a word a line.
    constexpr std::size_t least_width = 20;
    if (width < least_width)
      return;
    stream.rdbuf(this);
    stream << std::nounitbuf; // each line is sent when it ends
  }

  TerminalLines::~TerminalLines()
  {
    sync();
    stream.rdbuf(terminal);
  }

  TerminalLines::int_type TerminalLines::overflow(const int_type c)
  {
    if (traits_type::eq_int_type(c, traits_type::eof()))
      return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    if (character == '\r')
    {
      put_line();
      terminal->sputc(character);
      drawn_over = true;
      column     = 0;
    }
    else if (character == '\n')
    {
      put_line();
      terminal->sputc(character);
      terminal->pubsync();
      drawn_over = false;
    }
    else if (!drawn_over)
      line += character;
    else if (++column < width)
      terminal->sputc(character);
    return c;
  }

  int TerminalLines::sync()
  {
    put_line();
    return terminal->pubsync();
  }

  void TerminalLines::put_line()
  {
    const auto text = wrapped(line, width);
    terminal->sputn(text.data(), static_cast<std::streamsize>(text.size()));
    line.clear();
  }
} // namespace sprag
