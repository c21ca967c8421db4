// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  /// One cause of an error and what to do about it.
  struct ErrorPart
  {
    std::string name;   ///< mesh, penalty, step
    double value;       ///< relative error that it causes, estimated [-], >= 0
    std::string remedy; ///< a sentence: what to change to halve it
  };

  /// The error that a run tells of one of its results.
  struct ErrorEstimate
  {
    std::string quantity;              ///< name in /accuracy: P, Q, loop_area
    std::string relative_to;           ///< what the error is a share of
    std::vector<ErrorPart> parts;      ///< empty where no estimate holds
    std::string unknown;               ///< why no estimate holds, a sentence
    std::vector<ErrorPart> left_out{}; ///< what the model leaves out, which no setting of it mends; not in the sum of the parts
  };

  /// Returns the sum of the parts, which says what is to be feared when none cancels another; NaN without parts.
  double total_error(const ErrorEstimate &estimate);

  /// Returns the largest part; there must be one.
  const ErrorPart &largest_part(const ErrorEstimate &estimate);

  /// Returns the error of the finer of two results over their difference, coarse less fine, where sizes are `ratio` > 1 apart and
  /// the error goes with a power `order` > 0 of the size (Richardson).
  double finer_share(double ratio, double order);
} // namespace sprag
