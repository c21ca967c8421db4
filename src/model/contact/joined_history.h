// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/contact_point.h"

#include <vector>

namespace sprag
{
  // Contact histories of both levers of a pair in one list: entries of the second lever are numbered after all of the first's,
  // which has `points` contact points.

  /// Returns the entries of one lever, with the numbers that its points have alone.
  inline std::vector<ContactHistory> lever_history(const unsigned int lever, const unsigned int points,
                                                   const std::vector<ContactHistory> &pair_history)
  {
    std::vector<ContactHistory> result;
    for (auto entry : pair_history)
      if (entry.point / points == lever)
      {
        entry.point -= lever * points;
        result.push_back(entry);
      }
    return result;
  }

  /// Joins the entries of both levers.
  inline std::vector<ContactHistory> joined_history(const unsigned int points, std::vector<ContactHistory> first,
                                                    const std::vector<ContactHistory> &second)
  {
    for (auto entry : second)
    {
      entry.point += points;
      first.push_back(entry);
    }
    return first;
  }
} // namespace sprag
