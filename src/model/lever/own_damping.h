// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// A vibration with the dashpot that has the loss factor at its own frequency.
  struct OwnDamped
  {
    std::complex<double> eigenvalue; ///< [1/s]
    double relaxation;               ///< damping over stiffness, loss factor / Im lambda [s]
  };

  /// Returns the `number` vibrations of lowest frequency with damping of their own, and what does not vibrate without damping, by
  /// increasing |lambda|. `find` gives the eigenvalues with a damping over stiffness. The k-th frequency of those changes
  /// continuously and little with the damping, also where two vibrations meet: its fixed point is the k-th vibration. Static
  /// shapes that creep back do not count, though round-off gives them frequencies. Throws AnalysisError where no fixed point is
  /// found.
  inline std::vector<OwnDamped> own_damped_vibrations(const double loss_factor, const unsigned int number,
                                                      const std::function<std::vector<std::complex<double>>(double)> &find)
  {
    constexpr double accuracy         = 1e-6; ///< of a frequency
    constexpr unsigned int most_steps = 30;
    auto found                        = find(0.);
    const auto vibrates               = [](const auto &lambda) { return lambda.imag() > -lambda.real() && lambda.imag() > 0.; };
    const auto sort_vibrations        = [&]
    {
      const auto end = std::partition(found.begin(), found.end(), vibrates);
      std::sort(found.begin(), end, [](const auto &a, const auto &b) { return a.imag() < b.imag(); });
      return static_cast<std::size_t>(end - found.begin());
    };
    std::size_t vibrations = sort_vibrations();
    const auto undamped    = found;
    std::vector<OwnDamped> result;
    for (std::size_t k = vibrations; k < found.size(); ++k)
      result.push_back({ found[k], 0. });
    const std::size_t n_results = std::min<std::size_t>(number, vibrations);
    for (std::size_t k = 0; k < n_results; ++k)
    {
      // The dashpot of a lower vibration may suppress this one: each search begins where nothing is damped.
      double frequency = undamped[k].imag();
      for (unsigned int step = 0;; ++step)
      {
        const double relaxation = loss_factor / frequency;
        found                   = find(relaxation);
        vibrations              = sort_vibrations();
        if (k >= vibrations || step == most_steps)
          throw AnalysisError("no vibration number " + std::to_string(k + 1) +
                              " has the loss factor of the contact. Try Contact/Damping law = dashpot.");
        const double before = std::exchange(frequency, found[k].imag());
        if (std::abs(frequency - before) > accuracy * before)
          continue;
        result.push_back({ found[k], relaxation });
        break;
      }
    }
    std::sort(result.begin(), result.end(),
              [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
    return result;
  }
} // namespace sprag
