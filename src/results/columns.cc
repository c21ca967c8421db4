// SPDX-License-Identifier: GPL-3.0-only
#include "results/columns.h"

#include "base/ranges.h"
#include "results/page_tables.h"
#include "scene/drive.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  const std::vector<ColumnInfo> &all_columns()
  {
    static const auto columns = page_columns("", boost::algorithm::join(words_in(enumerators<Column>()), " "));
    return columns;
  }

  namespace
  {
    void add_sensors(const FrictionPlate &plate, std::vector<ColumnInfo> &columns)
    {
      if (plate.type == PlateType::none)
        return;
      for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
        append(columns, page_columns("", "sensor_" + std::to_string(i)));
      append(columns, page_columns("", "sensor_sum"));
    }

    void add_as_second(const std::vector<ColumnInfo> &per_lever, std::vector<ColumnInfo> &columns)
    {
      for (const auto &[name, unit, description] : per_lever)
        columns.push_back({ name + "_2", unit, "of the pair's second lever, in its mirrored axes: " + description });
    }

    /// Columns of each lever in three dimensions.
    std::vector<ColumnInfo> across_a_lever(const FrictionPlate &plate, const Cylinder &cylinder)
    {
      std::vector<ColumnInfo> columns = columns_across();
      if (cylinder.has_free_axis())
        append(columns, page_columns("", "tilt skew"));
      if (plate.type != PlateType::none)
        for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
          for (const std::string side : { "_left", "_right" })
            append(columns, page_columns("", "sensor_" + std::to_string(i) + side));
      return columns;
    }

    std::size_t find_place(const Column column)
    {
      const auto &per_lever = lever_columns();
      return static_cast<std::size_t>(std::find(per_lever.begin(), per_lever.end(), column) - per_lever.begin());
    }
  } // namespace

  const std::vector<Column> &lever_columns()
  {
    static const std::vector<Column> columns = {
      // Motion and forces of the lever.
      Column::theta, Column::theta_rate, Column::s, Column::P, Column::F, Column::Q, Column::normal_resultant,
      Column::friction_resultant, Column::v_rel, Column::mu,
      // Shape of its contact.
      Column::centre_offset, Column::contact_width, Column::largest_pressure, Column::largest_pressure_xi,
      // References.
      Column::P_quasi_static, Column::Q_quasi_static, Column::P_closed_form, Column::Q_closed_form, Column::theta_closed_form
    };
    return columns;
  }

  const std::vector<ColumnInfo> &columns_across()
  {
    static const auto columns = page_columns("", "F_across centre_across twisting_moment turning_moment largest_pressure_zeta");
    return columns;
  }

  std::vector<ColumnInfo> table_columns(const FrictionPlate &plate, const MirroredPair &pair, const unsigned int dimension,
                                        const Cylinder &cylinder)
  {
    std::vector<ColumnInfo> result = all_columns();
    add_sensors(plate, result);
    if (pair.type == PairType::full)
    {
      auto second_infos = mapped(lever_columns(), column_info);
      add_sensors(plate, second_infos);
      add_as_second(second_infos, result);
      append(result, page_columns("", "swing Q_pair lateral_force"));
    }
    if (dimension == 3)
    {
      const auto across_columns = across_a_lever(plate, cylinder);
      append(result, across_columns);
      if (pair.type == PairType::full)
        add_as_second(across_columns, result);
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
    second_values.clear();
    for (const Column column : lever_columns())
      second_values.push_back(second[column]);
    sensor_forces.insert(sensor_forces.end(), second.sensor_forces.begin(), second.sensor_forces.end());
    across.insert(across.end(), second.across.begin(), second.across.end());
    for (const Column column :
         { Column::friction_power, Column::friction_work, Column::drive_work, Column::spring_energy, Column::elastic_energy,
           Column::layer_energy, Column::support_energy, Column::contact_energy, Column::active_points })
      (*this)[column] += second[column];
    for (const Column column : { Column::penetration, Column::indentation, Column::cone_violation, Column::elastic_slip })
      (*this)[column] = std::max((*this)[column], second[column]);
  }

  double Row::second_value(const Column column) const
  {
    return second_values.at(find_place(column));
  }

  void Row::set_second_value(const Column column, const double value)
  {
    second_values.at(find_place(column)) = value;
  }

  double Row::lever_value(const Column column, const unsigned int lever) const
  {
    return lever == 0 ? (*this)[column] : second_values.empty() ? unknown : second_value(column);
  }

  Row Row::lever_row(const unsigned int lever) const
  {
    Row result = *this;
    result.second_values.clear();
    for (std::size_t i = 0; i < second_values.size() && lever == 1; ++i)
      result[lever_columns()[i]] = second_values[i];
    return result;
  }

  double Row::lateral_force() const
  {
    const auto upward = [](const double P, const double F, const double theta)
    { return P * std::cos(theta) - F * std::sin(theta); };
    return upward(second_value(Column::P), second_value(Column::F), second_value(Column::theta)) -
           upward((*this)[Column::P], (*this)[Column::F], (*this)[Column::theta]);
  }

  const ColumnInfo &column_info(const Column column)
  {
    return all_columns().at(static_cast<std::size_t>(column));
  }
} // namespace sprag
