// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <ctime>
#include <optional>
#include <string>

namespace sprag
{
  /// The attribute `format` of our result files.
  inline constexpr char result_format[] = "sprag result";

  /// Behind the name of a result file that cannot be read yet.
  inline constexpr char result_begun_ending[] = ".new";

  /// Facts of an earlier run, as its result file holds them.
  struct EarlierResult
  {
    std::string parameters; ///< of the scene, in .prm form
    std::string status;     ///< how the run ended; empty where it did not
  };

  /// Reads the result file at `path`; returns none where there is no such file, or one that is
  /// damaged or another program's.
  std::optional<EarlierResult> earlier_result(const std::string &path);

  /// Gives the result file that a run left unfinished a /summary with the status, so that it is no longer marked as being
  /// written; makes a file without rows where there is none. Leaves alone what is finished and what was there before `since`.
  /// Returns whether there was something to do and it could be done.
  bool finish_abandoned(const std::string &path, const std::string &parameters, const std::string &status, std::timespec since);
} // namespace sprag
