#pragma once

#include "analysis/stability/critical.h"
#include "analysis/stability/roles.h"
#include "results/result_file.h"

#include <iosfwd>

namespace sprag
{
  /// Selects the modes to report: the `number` lowest that oscillate, and every one that grows.
  std::vector<Eigenmode> reported(const std::vector<Eigenmode> &modes, unsigned int number);

  /// Returns the group /modes: eigenvalues, shares of energy and growth, and shapes of modes.
  Group mode_group(const std::vector<Eigenmode> &modes, const DynamicModel &model);

  /// Prints frequencies and where the energy of each mode is.
  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints growth rates and what they are made of.
  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes);

  // Entries of /summary.
  std::vector<Entry> slide_entries(const SlideStability &found);
  std::vector<Entry> role_entries(const std::vector<Role> &roles);
  std::vector<Entry> critical_entries(const std::vector<CriticalSearch> &searches);

  void print_roles(std::ostream &stream, const SlideStability &present, const std::vector<Role> &roles);
  void print_critical(std::ostream &stream, const std::vector<CriticalSearch> &searches);
} // namespace sprag
