// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "base/unknown.h"

#include <algorithm>
#include <cmath>
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

  /// The estimated error of one result of a run.
  struct ErrorEstimate
  {
    std::string quantity;              ///< name in /accuracy: P, Q, loop_area
    std::string relative_to;           ///< name of the quantity by which the error is divided
    std::vector<ErrorPart> parts;      ///< empty where no estimate holds
    std::string unknown;               ///< why no estimate holds, a sentence
    std::vector<ErrorPart> left_out{}; ///< errors of the model itself, which no setting reduces; not in the sum of the parts
  };

  /// Returns the sum of the parts, an upper estimate as parts may cancel; NaN without parts.
  inline double total_error(const ErrorEstimate &estimate)
  {
    return estimate.parts.empty() ? unknown : sum_over(estimate.parts, [](const ErrorPart &part) { return part.value; });
  }

  /// Returns the largest part; there must be one.
  inline const ErrorPart &largest_part(const ErrorEstimate &estimate)
  {
    return *std::max_element(estimate.parts.begin(), estimate.parts.end(),
                             [](const ErrorPart &a, const ErrorPart &b) { return a.value < b.value; });
  }

  /// Returns (error of the finer result)/(coarse - fine) = 1/(ratio^order - 1), for an error proportional to size^order, order
  /// > 0, and sizes `ratio` > 1 apart (Richardson).
  inline double finer_share(const double ratio, const double order)
  {
    return 1. / (std::pow(ratio, order) - 1.);
  }
} // namespace sprag
