// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/roles.h"
#include "analysis/stability/sweep.h"
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
  void print_slide(std::ostream &stream, const SlideStability &found, bool is_decided);

  /// Prints which slides the verdict looked at, and which of them are not stable.
  void print_sweep(std::ostream &stream, const Scene &scene, const SweptSlides &swept);

  /// Prints over which damping of the contact the verdict holds, and the growth at the limits of its stiffness in stick.
  void print_constants(std::ostream &stream, const DampingRange &damping, const StickLimits &stick);

  /// Prints the verdicts on the slide as it is and without one effect or another.
  void print_roles(std::ostream &stream, const SlideStability &present, const std::vector<Role> &roles);

  /// Prints where the verdict changes along each parameter; `with_spacing`: and how closely was tried.
  void print_critical(std::ostream &stream, const Scene &scene, const std::vector<CriticalSearch> &searches, bool with_spacing);
} // namespace sprag
