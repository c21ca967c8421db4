// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // Measurements along a stroke, and the unknowns to be found from them.

  /// Selects an unknown of an identification. `stiffness`, `interface_offset` and `inclination` are k, e and th0 of the paper.
  enum class Unknown
  {
    friction_constant,   ///< mu, independent of the speed
    friction_polynomial, ///< mu = mu_0 + mu_1 v + mu_2 v^2, the form of the paper's eqs. 13-15
    friction_table,      ///< mu at Identification/Friction speeds, joined as TabulatedFriction does
    friction_factor,     ///< times mu of the scene's law
    stiffness,           ///< k [N mm/rad]
    interface_offset,    ///< e [mm]
    inclination,         ///< th0 = th(x = 0) [rad], by the pivot's height
    force_offsets,       ///< of each measured force [N]
    rest_angle,          ///< of the rotational spring [rad]
    lag                  ///< delay of all forces after x [s]
  };

  /// Names the force that a column of a measurement holds.
  enum class MeasuredForce
  {
    normal, ///< P
    drive,  ///< Q
    sensors ///< sum of the friction plate's force sensors, which is P without inertia
  };

  /// Holds a measured force over the rows of a measurement.
  struct ForceChannel
  {
    MeasuredForce force;
    std::vector<double> values; ///< [N]; NaN: none in this row
  };

  /// Holds the rows of a measurement. Either time or x may be missing.
  struct MeasuredStroke
  {
    std::vector<double> time; ///< [s], never falling; empty: unknown
    std::vector<double> x;    ///< [mm]; empty: by the drive
    std::vector<ForceChannel> channels;

    std::size_t rows() const
    {
      return time.empty() ? x.size() : time.size();
    }
  };

  /// Selects the loss function of the residuals: squares, or squares up to 1.345 standard deviations and lines beyond (Huber).
  SPRAG_ENUMERATION(IdentificationLoss, least_squares, Huber)

  /// Holds the section Identification: the measurement, the unknowns and the method of the fit.
  struct IdentificationSettings
  {
    std::string table;
    std::string forces                  = "auto";
    std::string unknowns                = "mu, k";
    std::vector<double> friction_speeds = { 20., 60., 100., 140. }; ///< of a table of mu [mm/s], increasing, at least 4
    std::optional<double> window; ///< travel left out behind each reversal [mm]; none: from the data
    IdentificationLoss loss = IdentificationLoss::least_squares;
    double confidence       = 0.95; ///< of the intervals, 0 ... 1

    // read_identification() fills these from the texts and the table.
    std::vector<Unknown> sought;
    MeasuredStroke measured;
  };
} // namespace sprag
