#pragma once

namespace sprag
{
  /// Largest von Mises stress in a state of a run, the cells at the hub left out.
  struct StressSample
  {
    double time;  ///< of the state [s]
    double lever; ///< [MPa]
    double layer; ///< [MPa]
  };
} // namespace sprag
