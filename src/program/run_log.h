// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

namespace sprag
{
  struct Scene;

  /// Keeps what a process prints on std::cout and std::cerr, from its making on, in the file run.log of the folder of its run:
  /// version, date, command line, the parameters that were given, and all messages. A line that is drawn over another, as a
  /// progress bar is, stands there as it was last. Nothing is written before open(). A file that cannot be written is done
  /// without.
  class RunLog
  {
  public:
    RunLog(int argc, const char *const *argv);
    ~RunLog();
    RunLog(const RunLog &)            = delete;
    RunLog &operator=(const RunLog &) = delete;

    /// Begins the file in a folder, or appends to it where an interrupted run is resumed. Later calls do nothing.
    void open(const std::string &folder, const Scene &scene);

  private:
    class Tee;
    struct Record;

    std::shared_ptr<Record> record;
    std::unique_ptr<Tee> out, error;
  };

  /// Adds a line to the run.log of a folder, if there is one: of a run that can no longer do it itself.
  void add_to_log(const std::string &folder, const std::string &line);
} // namespace sprag
