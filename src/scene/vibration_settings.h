// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <optional>
#include <string>

namespace sprag
{
  /// Selects the directions of steady sliding. Analyses of a single slide take `both` as backward.
  SPRAG_ENUMERATION(Direction, forward, backward, both)

  /// Selects the contact between cylinder and lever for undamped modes.
  SPRAG_ENUMERATION(HeldContact, open, frictionless, stuck)

  /// Holds the section Stability: vibration linearised about steady sliding frozen at one x (a held slide).
  struct StabilitySettings
  {
    std::optional<double>
        position; ///< x [mm]; none: the whole stroke for a verdict, the largest x of the drive for a single slide
    Direction direction  = Direction::both;
    unsigned int modes   = 10;                        ///< reported, lowest first, > 0
    bool damping         = true;                      ///< false: no damping of lever, support and contact
    HeldContact contact  = HeldContact::frictionless; ///< of modal analyses
    std::string critical = "auto";                    ///< parameters searched for critical values, see critical_searches()
    bool roles           = true;                      ///< whether the slide is repeated without flexure, without inertia ...
    std::string ranges   = "none";                    ///< parameters over which a verdict is the worst, see uncertain_ranges()
  };

  /// Names a parameter as in --set, and its range.
  struct ParameterRange
  {
    std::string name;
    double from         = 0.;
    double to           = 0.;
    unsigned int points = 2; ///< ends included
  };

  /// Selects the two parameters of a stability map and the refinement of its boundaries.
  struct MapSettings
  {
    ParameterRange first{ "Friction/Factor", 0.5, 2., 33 };
    ParameterRange second{ "Lever/Depth", 3., 25., 33 };
    unsigned int coarsest   = 4; ///< intervals of the grid between points of the first level, a power of 2
    unsigned int bisections = 3; ///< of each edge that a boundary crosses
  };

  /// Holds the section Sprag-slip: growth of a perturbation in time, and limit cycles along the stroke.
  struct SpragSlipSettings
  {
    double initial                = 1e-6; ///< amplitude over the mean penetration, > 0
    double final                  = 1e-3; ///< up to which growth is fitted; the perturbation of a stable slide begins there
    unsigned int steps_per_period = 128;
    double longest_growth         = 2.;  ///< time limit of the growth [s]
    double settling               = 0.3; ///< time at each x before the cycle is measured [s]
    unsigned int continuation     = 14;  ///< intervals up and down the stroke; 0: none
    std::optional<double> turn;          ///< x at which the continuation turns; none: the drive's smallest
  };
} // namespace sprag
