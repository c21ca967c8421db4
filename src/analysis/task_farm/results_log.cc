// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/results_log.h"

#include "base/errors.h"
#include "base/fingerprint.h"
#include "program/run_files.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr std::chrono::milliseconds lock_patience(5000);

    void write(const OpenFile &file, const std::string &path, const std::string &text)
    {
      if (!file.write(text))
        throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
    }

    /// Checksum of a line's content, in the results log of a scene.
    std::string checksum(const std::string &header, const std::string &content)
    {
      Fingerprint sum;
      sum.add(header);
      sum.add(content);
      return sum.text() + '\n';
    }

    /// With their ends; the last one may lack it.
    std::vector<std::string> read_lines(const std::string &path)
    {
      std::ifstream input(path);
      std::vector<std::string> lines;
      for (std::string line; std::getline(input, line);)
        lines.push_back(input.eof() ? line : line + '\n');
      return lines;
    }

    /// None where the line is not as it was written.
    std::optional<std::string> parse_content(const std::string &header, const std::string &line)
    {
      const std::size_t behind  = line.rfind(' ') + 1; // 0 without a blank
      const std::string content = line.substr(0, behind);
      if (behind == 0 || line.substr(behind) != checksum(header, content))
        return {};
      return content.substr(0, content.size() - 1);
    }
  } // namespace

  ResultsLogWriter::ResultsLogWriter(const std::string &results_log, const std::string &first_line)
      : path(results_log)
      , header(first_line)
      , file(path, O_WRONLY | O_APPEND)
  {
    if (!file.is_open())
      throw AnalysisError(path + " cannot be written: " + std::strerror(errno));
  }

  void ResultsLogWriter::append(const std::vector<std::string> &lines)
  {
    std::string text;
    for (const auto &line : lines)
      text += line + ' ' + checksum(header, line + ' ');
    write(file, path, text);
  }

  ResultsLog::ResultsLog(const std::string &file_path, const std::string &what, const std::string &scene)
      : path(file_path)
      , file(path, O_RDWR | O_CREAT | O_APPEND)
      , header(results_log_header(what, scene))
  {
    if (!file.is_open())
      throw InputError(path + " cannot be written: " + std::strerror(errno));
    if (!file.lock(lock_patience) && errno == EWOULDBLOCK)
      throw InputError(path + " is in use by another run. Choose another --output, or end that run.");
    read();
  }

  void ResultsLog::read()
  {
    const auto lines  = read_lines(path);
    const bool usable = !lines.empty() && lines.front() == header;
    other_scene       = !lines.empty() && !usable;
    if (!usable)
    {
      if (!file.truncate(0))
        throw InputError(path + " cannot be written: " + std::strerror(errno));
      return write(file, path, header);
    }
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (const auto content = parse_content(header, lines[i]))
        found.push_back(*content);
      else
        ++damaged;
    if (lines.back().back() != '\n')
      write(file, path, "\n");
  }

  void ResultsLog::remove()
  {
    ::unlink(path.c_str());
  }
} // namespace sprag
