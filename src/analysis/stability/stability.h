// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/unknown.h"
#include "levers/dynamics.h"
#include "scene/lever_inertia.h"

#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Classifies a steady slide: stable, a growing vibration (flutter, sprag-slip), a real eigenvalue > 0 (divergence), or no
  /// unique equilibrium, as none is found or its tangent has passed a singular one (jammed).
  SPRAG_ENUMERATION(SlideKind, stable, flutter, divergence, jammed)

  /// Returns "stable", "flutter" ...
  std::string kind_name(SlideKind kind);

  /// Returns Im lambda / 2 pi [Hz].
  double mode_frequency(const Eigenmode &mode);

  /// The vibrations that a verdict rests on.
  struct CheckedModes
  {
    unsigned int lowest;                                               ///< at least so many are found
    double up_to            = std::numeric_limits<double>::infinity(); ///< [Hz]; the model cannot have faster ones
    bool explained          = false; ///< with shapes and shares, which take as long again as their eigenvalues
    double length_frequency = std::numeric_limits<double>::infinity(); ///< [Hz] of waves as long as a beam

    /// Makes a beam of so many elements, with which a slide that fewer leave undecided is checked; none: it is not.
    std::function<std::unique_ptr<DynamicModel>(unsigned int elements)> finer_beam = {};
    unsigned int elements = beam_elements; ///< of the beam that these are of

    /// Returns the error of a growth rate that a beam's elements make [1/s], 0 of other models: 9e-4 |lambda| of waves longer
    /// than the beam, growing with the frequency of shorter ones; an eighth of that with elements half as long. 386 modes of 60
    /// random devices with waves of two and a half elements or more differ from 64 elements by less, with 16 elements by 6.2e-5.
    double growth_error(std::complex<double> lambda) const;
  };

  /// Returns those of the scene's model, explained for a pair, whose motion() they say; see highest_beam_frequency(). `refined`:
  /// with finer beams.
  CheckedModes checked_modes(const Scene &scene, bool refined = false);

  /// Returns the same, explained.
  inline CheckedModes with_shapes(CheckedModes modes)
  {
    modes.explained = true;
    return modes;
  }

  /// A steady slide and its vibrations.
  struct SlideStability
  {
    SlideKind kind = SlideKind::jammed;
    std::optional<HeldSlide> slide;  ///< none where there is no equilibrium
    std::vector<Eigenmode> modes;    ///< by increasing |lambda|; empty without equilibrium
    std::size_t worst = 0;           ///< of the modes, the one with the largest growth rate, the first of those that tie; one
                                     ///< that grows by more than its error comes first
    double error          = 0.;      ///< of the largest growth rate, by CheckedModes::growth_error() of all modes [1/s]
    unsigned int elements = 0;       ///< of a beam, whose slide and modes these are
    std::optional<Eigenmode> beyond; ///< the fastest growing mode beyond CheckedModes::up_to, if one grows

    /// Returns the highest frequency of the modes that vibrate, which take more than a radian to decay by 1/e [Hz]; NaN if none
    /// does.
    double highest_frequency() const;

    /// Returns whether the growth rate is known in spite of its error, see the function of that name.
    bool is_decided() const;

    const Eigenmode &worst_mode() const
    {
      return modes.at(worst);
    }

    /// Returns the largest Re lambda [1/s]; NaN without equilibrium.
    double growth_rate() const
    {
      return modes.empty() ? unknown : worst_mode().mode.eigenvalue.real();
    }

    /// Returns the frequency of that mode [Hz]; NaN without equilibrium.
    double frequency() const
    {
      return modes.empty() ? unknown : mode_frequency(worst_mode());
    }

    /// Returns the uniqueness of the HeldSlide; NaN without equilibrium.
    double uniqueness() const
    {
      return slide ? slide->uniqueness : unknown;
    }

    /// Returns how a pair's levers move in that mode: "mirroring" (symmetric), "swinging" (antisymmetric), "either" if both have
    /// the eigenvalue, "mixed" if the levers differ; empty for one lever or without equilibrium.
    std::string motion() const;
  };

  /// Returns the eigenvalue of a slide's mode that is nearest to a frequency [Hz]; NaN without equilibrium.
  std::complex<double> eigenvalue_near(const SlideStability &slide, double frequency);

  /// Growth above this share of |lambda| counts as growth. No structure has so little damping.
  constexpr double smallest_growth = 1e-6;

  /// Returns whether an eigenvalue grows or dies out by more than its error [1/s], or does neither within round-off.
  bool is_decided(std::complex<double> eigenvalue, double error);

  /// Checks the slide at `drive`.
  SlideStability check_slide(DynamicModel &model, const DrivePoint &drive, const CheckedModes &modes);

  /// Checks a slide that this model holds, or one that differs from it in damping alone; none: it jams.
  SlideStability check_slide(DynamicModel &model, const std::optional<HeldSlide> &slide, const CheckedModes &modes);

  /// Checks the slide at the scene's held_drive(), with its model in held_scene(), which `maker` makes.
  SlideStability check_slide(const Scene &scene, DynamicsMaker &maker);

  /// A slide with one of its ingredients left out.
  struct Role
  {
    std::string name;                         ///< "without_flexure" ...
    std::string meaning;                      ///< what was done
    std::optional<SlideStability> found = {}; ///< none where the analysis failed; without inertia its kind alone
  };

  /// Checks the slide again without flexure, inertia, mu'(v), damping and a sprung support, each left out alone.
  std::vector<Role> roles(const Scene &scene, const SlideStability &present, DynamicsMaker &maker);
} // namespace sprag
