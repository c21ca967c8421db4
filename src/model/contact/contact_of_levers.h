// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "model/step/linearisation.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  /// Returns the absolute value of the largest change of a lever's gap by a small change of the displacements [mm].
  template <class Contact>
  double largest_gap_change(const Contact &contact, const typename Contact::Evaluation &found,
                            const dealii::Vector<double> &change)
  {
    double largest = 0.;
    for (unsigned int lever = 0; lever < Contact::levers; ++lever)
      largest = std::max(largest, std::abs(contact.gap_change(found, change, lever)));
    return largest;
  }

  /// Returns the change of the gap that a complex change of the displacements moves most.
  template <class Contact>
  std::complex<double> largest_gap_change(const Contact &contact, const typename Contact::Evaluation &found,
                                          const ComplexVector &change)
  {
    std::complex<double> largest;
    for (unsigned int lever = 0; lever < Contact::levers; ++lever)
    {
      const std::complex<double> gap(contact.gap_change(found, change[0], lever), contact.gap_change(found, change[1], lever));
      if (std::abs(gap) > std::abs(largest))
        largest = gap;
    }
    return largest;
  }
} // namespace sprag
