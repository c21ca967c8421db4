// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <optional>
#include <string>

namespace sprag
{
  /// A single slide of both directions is the one backward.
  SPRAG_ENUMERATION(Direction, forward, backward, both)

  /// Contact between cylinder and lever in undamped modes.
  SPRAG_ENUMERATION(HeldContact, open, frictionless, stuck)

  /// Linearised vibration about a steady slide held at one x.
  struct StabilitySettings
  {
    std::optional<double> position; ///< x [mm]; none: the whole stroke for a verdict, the drive's largest for a single slide
    Direction direction  = Direction::both;
    unsigned int modes   = 10;                        ///< reported, lowest first, > 0
    bool damping         = true;                      ///< false: no damping of lever, support and contact
    HeldContact contact  = HeldContact::frictionless; ///< of modal analyses
    std::string critical = "auto";                    ///< parameters searched for critical values, see critical_searches()
    bool roles           = true;                      ///< whether flexure, inertia ... are left out in turn
    std::string ranges   = "none";                    ///< parameters over which a verdict is the worst, see uncertain_ranges()
  };

  /// A parameter by its --set name, over a range.
  struct ParameterRange
  {
    std::string name;
    double from         = 0.;
    double to           = 0.;
    unsigned int points = 2; ///< ends included
  };

  struct MapSettings
  {
    ParameterRange first{ "Friction/Factor", 0.5, 2., 33 };
    ParameterRange second{ "Lever/Depth", 3., 25., 33 };
    unsigned int coarsest   = 4; ///< intervals of the grid between points of the first level, a power of 2
    unsigned int bisections = 3; ///< of each edge that a boundary crosses
  };

  /// Perturbation of a held slide in time, and its limit cycles up and down the stroke.
  struct SpragSlipSettings
  {
    double initial                = 1e-6; ///< amplitude over the mean penetration, > 0
    double final                  = 1e-3; ///< up to which growth is fitted; a stable slide begins there
    unsigned int steps_per_period = 128;
    double longest_growth         = 2.;  ///< [s]
    double settling               = 0.3; ///< at each x, before the cycle is told [s]
    unsigned int continuation     = 14;  ///< intervals up and down the stroke; 0: none
    std::optional<double> turn;          ///< x at which the continuation turns; none: the drive's smallest
  };
} // namespace sprag
