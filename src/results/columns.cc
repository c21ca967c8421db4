// SPDX-License-Identifier: GPL-3.0-only
#include "results/columns.h"

#include "base/append.h"
#include "results/page_tables.h"
#include "scene/drive.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  const std::vector<ColumnInfo> &all_columns()
  {
    static const auto columns =
        columns_of_pages("", "time x v theta s P F Q normal_resultant friction_resultant v_rel mu centre_offset contact_width "
                             "largest_pressure largest_pressure_xi penetration indentation cone_violation elastic_slip "
                             "friction_power friction_work drive_work spring_energy elastic_energy layer_energy kinetic_energy "
                             "support_energy contact_energy damping_work algorithmic_work energy_residual theta_rate "
                             "support_displacement Q_support P_quasi_static Q_quasi_static creep P_closed_form Q_closed_form "
                             "theta_closed_form step time_step rejected_steps active_points iterations augmentations");
    return columns;
  }

  namespace
  {
    void add_sensors(const FrictionPlate &plate, std::vector<ColumnInfo> &columns)
    {
      if (plate.type == PlateType::none)
        return;
      for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
        append(columns, columns_of_pages("", "sensor_" + std::to_string(i)));
      append(columns, columns_of_pages("", "sensor_sum"));
    }

    void add_as_second(const std::vector<ColumnInfo> &of_a_lever, std::vector<ColumnInfo> &columns)
    {
      for (const auto &[name, unit, description] : of_a_lever)
        columns.push_back({ name + "_2", unit, "of the pair's second lever, in its mirrored axes: " + description });
    }

    void add_pair(const FrictionPlate &plate, std::vector<ColumnInfo> &columns)
    {
      std::vector<ColumnInfo> of_second;
      for (const Column column : columns_of_a_lever())
        of_second.push_back(column_info(column));
      add_sensors(plate, of_second);
      add_as_second(of_second, columns);
      append(columns, columns_of_pages("", "swing Q_pair lateral_force"));
    }

    /// Columns of each lever in three dimensions.
    std::vector<ColumnInfo> across_a_lever(const FrictionPlate &plate, const Cylinder &cylinder)
    {
      std::vector<ColumnInfo> columns = columns_across();
      if (cylinder.has_free_axis())
        append(columns, columns_of_pages("", "tilt skew"));
      if (plate.type != PlateType::none)
        for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
          for (const std::string side : { "_left", "_right" })
            append(columns, columns_of_pages("", "sensor_" + std::to_string(i) + side));
      return columns;
    }
  } // namespace

  const std::vector<Column> &columns_of_a_lever()
  {
    static const std::vector<Column> columns = { Column::theta,
                                                 Column::theta_rate,
                                                 Column::s,
                                                 Column::P,
                                                 Column::F,
                                                 Column::Q,
                                                 Column::v_rel,
                                                 Column::mu,
                                                 Column::centre_offset,
                                                 Column::contact_width,
                                                 Column::largest_pressure,
                                                 Column::largest_pressure_xi };
    return columns;
  }

  const std::vector<ColumnInfo> &columns_across()
  {
    static const auto columns =
        columns_of_pages("", "F_across centre_across twisting_moment turning_moment largest_pressure_zeta");
    return columns;
  }

  std::vector<ColumnInfo> table_columns(const FrictionPlate &plate, const MirroredPair &pair, const unsigned int dimension,
                                        const Cylinder &cylinder)
  {
    std::vector<ColumnInfo> result = all_columns();
    add_sensors(plate, result);
    if (pair.type == PairType::full)
      add_pair(plate, result);
    if (dimension == 3)
    {
      const auto of_lever = across_a_lever(plate, cylinder);
      result.insert(result.end(), of_lever.begin(), of_lever.end());
      if (pair.type == PairType::full)
        add_as_second(of_lever, result);
    }
    return result;
  }

  Row::Row(const DrivePoint &at)
      : Row()
  {
    (*this)[Column::time] = at.time;
    (*this)[Column::x]    = at.x;
    (*this)[Column::v]    = at.v;
  }

  void Row::add_second_lever(const Row &second)
  {
    of_second.clear();
    for (const Column column : columns_of_a_lever())
      of_second.push_back(second[column]);
    sensor_forces.insert(sensor_forces.end(), second.sensor_forces.begin(), second.sensor_forces.end());
    across.insert(across.end(), second.across.begin(), second.across.end());
    for (const Column column :
         { Column::friction_power, Column::friction_work, Column::drive_work, Column::spring_energy, Column::elastic_energy,
           Column::layer_energy, Column::support_energy, Column::contact_energy, Column::active_points })
      (*this)[column] += second[column];
    for (const Column column : { Column::penetration, Column::indentation, Column::cone_violation, Column::elastic_slip })
      (*this)[column] = std::max((*this)[column], second[column]);
  }

  double Row::of_second_lever(const Column column) const
  {
    const auto &of_a_lever = columns_of_a_lever();
    const auto place       = std::find(of_a_lever.begin(), of_a_lever.end(), column) - of_a_lever.begin();
    return of_second.at(static_cast<std::size_t>(place));
  }

  double Row::lateral_force() const
  {
    const auto upward = [](const double P, const double F, const double theta)
    { return P * std::cos(theta) - F * std::sin(theta); };
    return upward(of_second_lever(Column::P), of_second_lever(Column::F), of_second_lever(Column::theta)) -
           upward((*this)[Column::P], (*this)[Column::F], (*this)[Column::theta]);
  }

  const ColumnInfo &column_info(const Column column)
  {
    return all_columns().at(static_cast<std::size_t>(column));
  }
} // namespace sprag
