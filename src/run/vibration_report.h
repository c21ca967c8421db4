// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analysis/stability/sweep.h"
#include "levers/dynamics.h"
#include "results/result_file.h"

#include <iosfwd>
#include <limits>
#include <vector>

namespace sprag
{
  /// Prints frequencies and where the energy of each mode is, leaving out parts that have none in any.
  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints growth rates and what they are made of.
  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints the modes that grow most or decay least, with what feeds and damps each of them most.
  void print_growing(std::ostream &stream, std::vector<Eigenmode> modes);

  /// Prints where the verdict changes along each parameter; `with_spacing`: and how closely was tried.
  void print_critical(std::ostream &stream, const Scene &scene, const std::vector<CriticalSearch> &searches, bool with_spacing);

  /// Returns Im lambda / 2 pi [Hz].
  double mode_frequency(const Eigenmode &mode);

  /// Returns true if a mode grows by more than round-off.
  bool grows(const Eigenmode &mode);

  /// Checks a mode: stable, flutter or divergence.
  SlideKind classify(const Eigenmode &mode);

  /// Returns whether they are of a lever in three dimensions.
  bool is_solid(const std::vector<Eigenmode> &modes);

  /// Returns true if these are the modes of two levers.
  bool is_pair(const std::vector<Eigenmode> &modes);

  /// Selects the modes to report: the `number` lowest that oscillate, and every one that grows.
  std::vector<Eigenmode> reported(const std::vector<Eigenmode> &modes, unsigned int number);

  /// Returns the group /modes: eigenvalues, shares of energy and growth, and shapes of modes.
  Group mode_group(const std::vector<Eigenmode> &modes, const Dynamics &dynamics);

  // Entries of /summary.
  /// `is_decided`: the slide does not grow by less than the error of that.
  std::vector<Entry> slide_entries(const SlideStability &found, bool is_decided);

  /// The range of Contact/Damping about that of the scene over which the kind of a slide stays the same.
  struct DampingRange
  {
    double low, high;           ///< shares of critical
    double growth_rate_at_none; ///< without damping of the contact [1/s]
    double loss_factor;         ///< omega times damping over stiffness, at `high` and the frequency of the slide
  };

  /// Growth at the limits of the contact's stiffness in stick, through which friction lags behind the pressure, and of the memory
  /// of a mu that falls with speed.
  struct UnmeasuredLimits
  {
    double soft  = std::numeric_limits<double>::quiet_NaN(); ///< a tenth of it [1/s]; NaN where a mesh has the layer's shear
    double rigid = std::numeric_limits<double>::quiet_NaN(); ///< no lag [1/s]

    // With a tenth of Friction/Memory length and with ten times that [1/s]; NaN where mu does not fall.
    double short_memory = std::numeric_limits<double>::quiet_NaN();
    double long_memory  = std::numeric_limits<double>::quiet_NaN();
  };

  /// Tells where the slides that were looked at are unstable, and their worst growth, each way.
  std::vector<Entry> sweep_entries(const SweptSlides &swept);

  std::vector<Entry> damping_entries(const DampingRange &range);
  std::vector<Entry> unmeasured_entries(const UnmeasuredLimits &limits);
  std::vector<Entry> role_entries(const std::vector<Role> &roles);

  std::vector<Entry> critical_entries(const std::vector<CriticalSearch> &searches);
} // namespace sprag
