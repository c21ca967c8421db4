// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/critical.h"
#include "analysis/stability/roles.h"
#include "run/vibration_report.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// Prints frequencies and where the energy of each mode is, leaving out parts that have none in any.
  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints growth rates and what they are made of.
  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes);

  /// Prints the verdict on a steady slide, the slide, and the modes that grow most or decay least, with what feeds and damps each
  /// of them most.
  void print_slide(std::ostream &stream, const SlideStability &found);

  /// Prints over which damping of the contact the verdict holds.
  void print_damping(std::ostream &stream, const DampingRange &range);

  /// Prints the verdicts on the slide as it is and without one effect or another.
  void print_roles(std::ostream &stream, const SlideStability &present, const std::vector<Role> &roles);

  /// Prints where the verdict changes along each parameter; `with_spacing`: and how closely was tried.
  void print_critical(std::ostream &stream, const std::vector<CriticalSearch> &searches, bool with_spacing);
} // namespace sprag
