#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace sprag
{
  // One table for all fidelities. A model that cannot supply a quantity leaves NaN.

  enum class Column : std::size_t
  {
    time,
    x,
    v,
    theta,
    s,
    P,
    F,
    Q,
    normal_resultant,
    friction_resultant,
    v_rel,
    mu,
    centre_offset,
    contact_width,
    penetration,
    indentation,
    cone_violation,
    elastic_slip,
    friction_power,
    friction_work,
    drive_work,
    spring_energy,
    elastic_energy,
    P_closed_form,
    Q_closed_form,
    theta_closed_form,
    step,
    active_points,
    iterations,
    augmentations,
    count
  };

  inline constexpr std::size_t n_columns = static_cast<std::size_t>(Column::count);

  struct ColumnInfo
  {
    std::string name;
    std::string unit; ///< "1" where dimensionless
    std::string description;
  };

  const ColumnInfo &column_info(Column column);

  /// Every Column in the order of the enumeration.
  const std::vector<ColumnInfo> &all_columns();

  /// One accepted step.
  class Row
  {
  public:
    Row()
    {
      values.fill(std::numeric_limits<double>::quiet_NaN());
    }

    double &operator[](Column column)
    {
      return values[static_cast<std::size_t>(column)];
    }

    double operator[](Column column) const
    {
      return values[static_cast<std::size_t>(column)];
    }

  private:
    std::array<double, n_columns> values;
  };
} // namespace sprag
