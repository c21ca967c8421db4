// SPDX-License-Identifier: GPL-3.0-only
#include "results/columns.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  const std::vector<ColumnInfo> &all_columns()
  {
    // Each text goes into the result file as it stands: it has to be understood there, without this program.
    static const std::vector<ColumnInfo> columns = {
      { "time", "s", "time, starting at 0" },
      { "x", "mm", "position of the cylinder's centre, growing towards the pivot" },
      { "v", "mm/s", "speed of the cylinder dx/dt; at a reversal that of the stroke the row belongs to" },
      { "theta", "rad", "absolute inclination of the lever at its hub" },
      { "s", "mm", "lever coordinate of the centre of pressure, from the pivot; NaN where the contact is open" },
      { "P", "N", "normal force: resultant on the lever along n of the hub's theta; 0 where the contact is open" },
      { "F", "N", "friction force: resultant on the lever along -d of the hub's theta; 0 where the contact is open" },
      { "Q", "N", "x-force of the cylinder on the lever, Q = P sin(theta) + F cos(theta); negative on the return" },
      { "normal_resultant", "N", "sum of the local normal tractions over the friction face" },
      { "friction_resultant", "N",
        "sum of the local friction tractions over the friction face; its ratio to normal_resultant is mu in full sliding" },
      { "v_rel", "mm/s",
        "pressure-weighted material sliding speed of the cylinder along the lever; NaN where the contact is open" },
      { "mu", "1", "friction coefficient at v_rel" },
      { "centre_offset", "mm", "s minus the lever coordinate of the cylinder's centre; by it F/P in lever axes differs from mu" },
      { "contact_width", "mm", "length of the friction face with pressure > 0, its edges interpolated; 0 where open" },
      { "largest_pressure", "MPa",
        "largest pressure on the friction face, of finite elements; 0 where open; NaN of models without a face" },
      { "largest_pressure_xi", "mm",
        "its place: distance from the pivot along the deformed lever's axis; NaN where the contact is open" },
      { "penetration", "mm", "largest numerical overlap of cylinder and friction face" },
      { "indentation", "mm",
        "largest physical compression of the friction layer; of rigid and beam that of the contact law that stands for it" },
      { "cone_violation", "1",
        "largest |t| - mu p over the points of the friction face, relative to mu times the largest pressure" },
      { "elastic_slip", "mm", "largest elastic slip of the tangential penalty; 0 without one" },
      { "friction_power", "N mm/s", "work per time dissipated by friction at the end of the step" },
      { "friction_work", "N mm", "work dissipated by friction since the start" },
      { "drive_work", "N mm", "work of the drive since the start, integral of Q dx" },
      { "spring_energy", "N mm", "energy of the rotational spring: k (theta - theta0)^2 / 2, or that of the leaf spring" },
      { "elastic_energy", "N mm",
        "elastic energy of lever and friction layer, or of the contact law that stands for the layer, and of the cylinder's "
        "shaft" },
      { "layer_energy", "N mm", "the friction layer's part of elastic_energy; NaN where it cannot be told" },
      { "kinetic_energy", "N mm", "kinetic energy of lever and pivot frame" },
      { "support_energy", "N mm", "energy of the spring that holds the pivot frame" },
      { "contact_energy", "N mm", "energy of the contact's penalties, normal and tangential: numerical" },
      { "damping_work", "N mm", "work dissipated by structural, support and contact damping since the start" },
      { "algorithmic_work", "N mm", "work dissipated by the time integration since the start, from the scheme's own formula" },
      { "energy_residual", "N mm",
        "work of the drive less the change of the energies stored and the works dissipated: what the ledger leaves open" },
      { "theta_rate", "rad/s", "rate of theta" },
      { "support_displacement", "mm", "displacement of the pivot frame along x" },
      { "Q_support", "N",
        "force of the pivot frame on its support, k_f u + c_f du/dt; Q where the support is rigid; of a pair half of "
        "both levers' force" },
      { "P_quasi_static", "N", "P of the same model without inertia, in steady sliding at this x and v; NaN where v = 0" },
      { "Q_quasi_static", "N", "Q of the same model without inertia, in steady sliding at this x and v; NaN where v = 0" },
      { "creep", "mm", "slip since the start at speeds below that of the regularised friction law; 0 where stick is resolved" },
      { "P_closed_form", "N", "P of the closed form at this x from the pivot frame and direction" },
      { "Q_closed_form", "N", "Q of the closed form at this x from the pivot frame and direction" },
      { "theta_closed_form", "rad", "theta of the closed form at this x from the pivot frame" },
      { "step", "mm", "change of x in the step" },
      { "time_step", "s", "duration of the step" },
      { "rejected_steps", "1", "attempts discarded before this step was accepted" },
      { "active_points", "1", "points of the friction face in contact" },
      { "iterations", "1", "Newton iterations in the step" },
      { "augmentations", "1", "augmentations of the contact multipliers in the step" }
    };
    return columns;
  }

  namespace
  {
    void add_sensors(const FrictionPlate &plate, std::vector<ColumnInfo> &columns)
    {
      if (plate.type == PlateType::none)
        return;
      const std::string reason = ", positive in compression; finite elements only: other models have no friction plate";
      for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
        columns.push_back({ "sensor_" + std::to_string(i), "N",
                            "force of sensor " + std::to_string(i) + " of the friction plate, counted from the pivot" + reason });
      columns.push_back({ "sensor_sum", "N", "sum of the forces of the friction plate's sensors" + reason });
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
      columns.push_back(
          { "swing", "rad", "(theta - theta_2)/2: what both levers turn together, the first away from the cylinder" });
      columns.push_back({ "Q_pair", "N", "x-force of the cylinder on both levers, Q + Q_2" });
      columns.push_back(
          { "lateral_force", "N",
            "y-force of both levers on the cylinder, towards the first lever where positive; 0 where they mirror" });
    }

    /// What each lever has in three dimensions.
    std::vector<ColumnInfo> across_a_lever(const FrictionPlate &plate, const Cylinder &cylinder)
    {
      std::vector<ColumnInfo> columns = columns_across();
      if (cylinder.has_free_axis())
      {
        columns.push_back({ "tilt", "1", "slope of the cylinder's axis towards the lever, Tilt and what its shaft yields" });
        columns.push_back({ "skew", "1", "slope of the cylinder's axis along x, Skew and what its shaft yields" });
      }
      if (plate.type == PlateType::none)
        return columns;
      for (std::size_t i = 1; i <= plate.sensors.size(); ++i)
        for (const auto &[side, where] : { std::pair("left", "zeta < 0"), std::pair("right", "zeta > 0") })
          columns.push_back(
              { "sensor_" + std::to_string(i) + "_" + side, "N",
                "part of sensor_" + std::to_string(i) + " at the plate's " + side + ", " + where + ", positive in compression" });
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
    static const std::vector<ColumnInfo> columns = {
      { "F_across", "N", "friction on the lever across its width, along zeta" },
      { "centre_across", "mm", "zeta of the centre of pressure, from the middle of the lever's width" },
      { "twisting_moment", "N mm",
        "moment of the forces on the friction face that twists the lever, about the middle of its width: "
        "positive where zeta > 0 is pressed more" },
      { "turning_moment", "N mm",
        "moment of friction on the lever in the plane of the face, about the middle of its width: "
        "positive where zeta > 0 is drawn towards the pivot more" },
      { "largest_pressure_zeta", "mm", "zeta where the pressure is largest" }
    };
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
