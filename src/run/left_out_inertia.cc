// SPDX-License-Identifier: GPL-3.0-only
#include "run/left_out_inertia.h"

#include "results/row_statistics.h"
#include "scene/closed_form.h"
#include "scene/contact_reference.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double way_of_difference = 1e-3; ///< to both sides, over the cylinder's radius

    /// Angular acceleration of the ideal lever [rad/s^2]; 0 where the drive turns near by, or begins or ends.
    double angular_acceleration(const Scene &scene, const double time)
    {
      const auto &drive = scene.drive;
      const auto at     = drive.at(time);
      const double span = way_of_difference * scene.geometry.cylinder_radius / std::abs(at.v);
      if (time < span || time + span > drive.duration())
        return 0.;
      const auto before = drive.at(time - span), after = drive.at(time + span);
      const bool turns = direction_of(before.v) != direction_of(at.v) || direction_of(after.v) != direction_of(at.v);
      if (turns || std::max({ before.x, at.x, after.x }) >= pivot_contact(scene.geometry))
        return 0.;
      const auto theta = [&](const DrivePoint &point) { return kinematics(scene.geometry, point.x).theta; };
      return (theta(before) - 2. * theta(at) + theta(after)) / (span * span);
    }
  } // namespace

  double left_out_inertia(const Scene &scene, const std::vector<Row> &rows)
  {
    const double J = moment_of_inertia(scene);
    double change  = 0.;
    for (const Row &row : rows)
      if (row[Column::v] != 0. && row[Column::P] > 0.)
      {
        const auto ideal = closed_form(scene, row[Column::x], row[Column::v]);
        const double moment =
            ideal.P * (ideal.contact.s + direction_of(row[Column::v]) * ideal.mu * scene.geometry.interface_offset);
        change = std::max(change, std::abs(J * angular_acceleration(scene, row[Column::time]) / moment) * row[Column::P]);
      }
    return change / largest(rows, Column::P);
  }
} // namespace sprag
