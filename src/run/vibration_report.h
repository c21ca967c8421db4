// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analysis/stability/sweep.h"
#include "levers/dynamics.h"
#include "results/result_file.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// Prints frequencies and where the energy of each mode is, leaving out parts that have none in any.
  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints growth rates and what they are made of.
  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints the modes that grow most or decay least, with what feeds and damps each of them most.
  void print_growing(std::ostream &stream, std::vector<Eigenmode> modes);

  /// Returns true if a mode grows by more than round-off.
  bool grows(const Eigenmode &mode);

  /// Checks a mode: stable, flutter or divergence.
  SlideKind classify(const Eigenmode &mode);

  /// Selects the modes to report: the `number` lowest that oscillate, and every one that grows.
  std::vector<Eigenmode> reported(const std::vector<Eigenmode> &modes, unsigned int number);

  /// Returns the group /modes: eigenvalues, shares of energy and growth, and shapes of modes.
  Group mode_group(const std::vector<Eigenmode> &modes, const Dynamics &dynamics);

  // Entries of /summary.
  /// `is_decided`: the slide does not grow by less than the error of that.
  std::vector<Entry> slide_entries(const SlideStability &found, bool is_decided);

  /// Tells where the slides that were looked at are unstable, and their worst growth, each way.
  std::vector<Entry> sweep_entries(const SweptSlides &swept);

  std::vector<Entry> role_entries(const std::vector<Role> &roles);

  std::vector<Entry> critical_entries(const Scene &scene, const std::vector<CriticalSearch> &searches);

  /// Returns the growth rates over each parameter.
  std::vector<Group> critical_groups(const std::vector<CriticalSearch> &searches);
} // namespace sprag
