// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/unknown.h"
#include "scene/apparatus.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sprag
{
  class Archive;
  struct DrivePoint;

  // One table for all fidelities. A model that cannot supply a quantity leaves NaN.

  SPRAG_ENUMERATION(Column, time, x, v, theta, s, P, F, Q, normal_resultant, friction_resultant, v_rel, mu, centre_offset,
                    contact_width, largest_pressure, largest_pressure_xi, penetration, indentation, cone_violation, elastic_slip,
                    friction_power, friction_work, drive_work, spring_energy, elastic_energy, layer_energy, kinetic_energy,
                    support_energy, contact_energy, damping_work, algorithmic_work, energy_residual, theta_rate,
                    support_displacement, Q_support, P_quasi_static, Q_quasi_static, creep, P_closed_form, Q_closed_form,
                    theta_closed_form, step, time_step, rejected_steps, active_points, iterations, augmentations)

  inline constexpr std::size_t n_columns = static_cast<std::size_t>(Column::augmentations) + 1;

  /// Describes a column of the result table.
  struct ColumnInfo
  {
    std::string name;
    std::string unit; ///< "1" where dimensionless
    std::string description;
  };

  const ColumnInfo &column_info(Column column);

  /// Lists every Column in the order of the enumeration.
  const std::vector<ColumnInfo> &all_columns();

  /// Lists the columns of the table of a run: with a friction plate on sensors also sensor_1 ... sensor_n and sensor_sum; of a
  /// full pair those of the second lever, named ..._2, and swing, Q_pair and lateral_force.
  /// In three dimensions those of columns_across(), of a cylinder whose axis is free tilt and skew and, of each sensor place,
  /// sensor_1_left, sensor_1_right ..., of a full pair again those of the second lever, named ..._2.
  std::vector<ColumnInfo> table_columns(const FrictionPlate &plate, const MirroredPair &pair, unsigned int dimension = 2,
                                        const Cylinder &cylinder = {});

  /// Lists the columns that a run in three dimensions has beside the others.
  const std::vector<ColumnInfo> &columns_across();

  /// Lists the columns that each lever of a pair has.
  const std::vector<Column> &lever_columns();

  /// One accepted step.
  class Row
  {
  public:
    Row()
    {
      values.fill(unknown);
    }

    /// Sets time, x and v.
    explicit Row(const DrivePoint &at);

    double &operator[](Column column)
    {
      return values[static_cast<std::size_t>(column)];
    }

    double operator[](Column column) const
    {
      return values[static_cast<std::size_t>(column)];
    }

    std::vector<double> sensor_forces; ///< [N], positive in compression; empty where the model has none
    std::vector<double> across;        ///< in the order of table_columns(), from columns_across() on; empty in a plane

    /// Makes this the row of a pair, whose first lever it was: energies, works and powers of both, what each lever has beside it.
    void add_second_lever(const Row &second);

    /// Returns the values of a pair's second lever in the order of lever_columns(); empty for a single lever.
    const std::vector<double> &second_lever() const
    {
      return second_values;
    }

    /// Returns one of lever_columns() of a pair's second lever.
    double second_value(Column column) const;

    void set_second_value(Column column, double value);

    /// Returns one of lever_columns() of the first (0) or second (1) lever; NaN where there is no second.
    double lever_value(Column column, unsigned int lever) const;

    /// Returns the row with the first (0) or second (1) lever's lever_columns() in place of both.
    Row lever_row(unsigned int lever) const;

    /// Returns Q of all levers together [N].
    double drive_force() const
    {
      return (*this)[Column::Q] + (second_values.empty() ? 0. : second_value(Column::Q));
    }

    /// Returns F of all levers together [N].
    double friction_force() const
    {
      return (*this)[Column::F] + (second_values.empty() ? 0. : second_value(Column::F));
    }

    /// Returns (theta - theta_2)/2: what both levers of a pair turn together, the same way in space [rad].
    double swing() const
    {
      return 0.5 * ((*this)[Column::theta] - second_value(Column::theta));
    }

    /// Returns the y-force of both levers of a pair on the cylinder, towards the first where positive [N].
    double lateral_force() const;

  private:
    friend void serialise(Archive &archive, Row &row);

    std::array<double, n_columns> values;
    std::vector<double> second_values;
  };
} // namespace sprag
