// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_evaluation.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>

namespace sprag
{
  std::string FaceEvaluation::objection() const
  {
    return sums.beyond_face ? "the contact reaches the end of the cylinder's face" : std::string();
  }

  std::vector<ContactMemory> FaceEvaluation::memory() const
  {
    if (sums.beyond_face)
      throw AnalysisError("the contact reaches the end of the part of the elastic cylinder's surface that is meshed to touch " +
                          ("the lever, at x = " + rounded_text(x)) +
                          " mm: the cylinder yields or the lever bends too much. Try a larger Cylinder/Young modulus or a " +
                          "rigid cylinder.");
    std::vector<ContactMemory> result;
    for (const auto &point : points)
      if (point.pressure > 0.)
        result.push_back(point.memory);
    return result;
  }

  double FaceEvaluation::penetration() const
  {
    double largest = 0.;
    for (const auto &point : points)
      largest = std::max(largest, -point.gap);
    return largest;
  }
} // namespace sprag
