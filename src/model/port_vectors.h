#pragma once

#include "model/port_forces.h"

namespace sprag
{
  /// From entries of some ports to entries of more, which hold them all; those of the others are 0.
  inline dealii::Vector<double> spread(const dealii::Vector<double> &values, const std::vector<unsigned int> &of,
                                       const std::vector<unsigned int> &ports)
  {
    dealii::Vector<double> result(static_cast<unsigned int>(ports.size()));
    for (unsigned int a = 0; a < values.size(); ++a)
      result[place_of(of[a], ports)] = values[a];
    return result;
  }
} // namespace sprag
