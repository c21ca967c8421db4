#pragma once

#include "model/contact_point.h"

#include <array>
#include <vector>

namespace sprag
{
  // Contact memories of both levers of a pair in one list: entries of the second lever are numbered after all of the first's,
  // which has `points` contact points.

  /// Returns the entries of one lever, with the numbers that its points have alone.
  inline std::vector<ContactMemory> memory_of_lever(const unsigned int lever, const unsigned int points,
                                                    const std::vector<ContactMemory> &of_pair)
  {
    std::vector<ContactMemory> result;
    for (auto entry : of_pair)
      if (entry.point / points == lever)
      {
        entry.point -= lever * points;
        result.push_back(entry);
      }
    return result;
  }

  /// Joins the entries of both levers.
  inline std::vector<ContactMemory> joined_memory(const unsigned int points,
                                                  const std::array<std::vector<ContactMemory>, 2> &of_levers)
  {
    std::vector<ContactMemory> result = of_levers[0];
    for (auto entry : of_levers[1])
    {
      entry.point += points;
      result.push_back(entry);
    }
    return result;
  }
} // namespace sprag
