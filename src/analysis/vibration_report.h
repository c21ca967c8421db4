#pragma once

#include "analysis/critical.h"
#include "analysis/roles.h"
#include "results/result_file.h"

#include <iosfwd>

namespace sprag
{
  /// Those to be told of: the `number` lowest that oscillate, and every one that grows.
  std::vector<Eigenmode> reported(const std::vector<Eigenmode> &modes, unsigned int number);

  /// /modes: eigenvalues, shares of energy and growth, and shapes of modes.
  Group mode_group(const std::vector<Eigenmode> &modes, const DynamicModel &model);

  /// Frequencies and where the energy is.
  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Growth rates and what they are made of.
  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes);

  // For /summary.
  std::vector<Entry> slide_entries(const SlideStability &found);
  std::vector<Entry> role_entries(const std::vector<Role> &roles);
  std::vector<Entry> critical_entries(const std::vector<CriticalSearch> &searches);

  void print_roles(std::ostream &stream, const SlideStability &present, const std::vector<Role> &roles);
  void print_critical(std::ostream &stream, const std::vector<CriticalSearch> &searches);
} // namespace sprag
