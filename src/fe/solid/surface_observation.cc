// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/surface_observation.h"

#include "fe/contact/pressure_recovery.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  SurfaceView::SurfaceView(const FrictionFace<3> &face_, const SurfaceContact &contact_, const bool half)
      : face(face_)
      , contact(contact_)
      , is_half(half)
      , parts(parts_of(face))
      , line_of_point(face.points.size())
  {
    const auto &lines = contact.lines();
    for (unsigned int i = 0; i < lines.size(); ++i)
      for (const unsigned int point : lines[i])
        line_of_point[point] = i;
  }

  FacePoints SurfaceView::points() const
  {
    return parts.points;
  }

  FaceState SurfaceView::state(const SurfaceEvaluation &found, const DrivePoint &drive) const
  {
    const std::vector<double> nothing(parts.points.xi.size(), 0.);
    FaceState result{ drive.time, drive.x, nothing, nothing, nothing, {}, {} };
    for (const auto &point : found.points)
    {
      const unsigned int part = parts.part_of_point[point.index];
      const double share      = face.points[point.index].weight / parts.points.weight[part];
      result.pressure[part] += share * point.pressure;
      result.traction[part] += share * point.traction[0];
      result.traction_across[part] += share * point.end_force[2];
    }
    return result;
  }

  void SurfaceView::observe(const SurfaceEvaluation &found, Row &row) const
  {
    observe_resultants(found, row);
    observe_pressure(found, row);
  }

  void SurfaceView::observe_resultants(const SurfaceEvaluation &found, Row &row) const
  {
    row.across.assign(columns_across().size(), 0.);
    if (contact.cylinder().has_free_axis())
    {
      const auto slopes = contact.slopes_in(found);
      row.across.insert(row.across.end(), slopes.begin(), slopes.end());
    }
    double normal = 0., position = 0., zeta = 0., speed = 0., mu = 0., power = 0., energy = 0., active = 0.;
    double elastic_slip = 0., penetration = 0., excess = 0., cone = 0., twisting = 0., turning = 0.;
    dealii::Tensor<1, 3> force;
    dealii::Tensor<1, 2> friction;
    for (const auto &point : found.points)
    {
      penetration = std::max(penetration, -point.gap);
      if (!(point.pressure > 0.))
        continue;
      const auto &of_face = face.points[point.index];
      const double area   = of_face.weight;
      double free         = 0.; // share of a force here that nodes take which the hub does not hold
      dealii::Tensor<1, 3> moved;
      for (const auto &[node, shape] : of_face.nodes)
      {
        free += shape;
        for (unsigned int d = 0; d < 3; ++d)
          moved[d] += shape * found.displacement[3 * node + d];
      }
      for (unsigned int d = 0; d < 3; ++d)
      {
        force[d] += area * free * point.end_force[d];
        energy += 0.5 * area * point.end_force[d] * moved[d];
      }
      const auto rate = found.duration > 0. ? point.slip_change / found.duration : dealii::Tensor<1, 2>();
      normal += area * point.pressure;
      friction += area * point.traction;
      position += area * point.pressure * point.position[0];
      zeta += area * point.pressure * point.position[2];
      twisting += area * point.end_force[1] * point.position[2];
      turning -= area * point.end_force[0] * point.position[2];
      speed += area * point.pressure * rate[0];
      mu += area * point.pressure * point.mu;
      power += area * (point.traction * rate);
      active += 1.;
      elastic_slip = std::max(elastic_slip, point.elastic_slip);
      excess       = std::max(excess, point.traction.norm() - point.mu * point.pressure);
      cone         = std::max(cone, point.mu * point.pressure);
    }
    row[Column::P]                  = force[1];
    row[Column::F]                  = -force[0];
    row[Column::normal_resultant]   = normal;
    row[Column::friction_resultant] = friction[0];
    row[Column::friction_power]     = power;
    row[Column::elastic_energy]     = energy;
    row[Column::active_points]      = active;
    row[Column::elastic_slip]       = elastic_slip;
    row[Column::penetration]        = penetration;
    row[Column::cone_violation]     = cone > 0. ? excess / cone : 0.;
    if (normal > 0.)
    {
      row[Column::s]  = position / normal;
      row[Column::mu] = mu / normal;
      if (found.duration > 0.)
        row[Column::v_rel] = speed / normal;
    }
    if (is_half)
      return;
    row.across[0] = force[2];
    row.across[2] = twisting;
    row.across[3] = turning;
    row.across[1] = normal > 0. ? zeta / normal : 0.;
  }

  /// Where it is largest the pressure is recovered as in a plane, along the points with that zeta.
  void SurfaceView::observe_pressure(const SurfaceEvaluation &found, Row &row) const
  {
    row[Column::contact_width] = row[Column::largest_pressure] = 0.;
    const auto by_pressure = [](const auto &a, const auto &b) { return a.pressure < b.pressure; };
    const auto largest     = std::max_element(found.points.begin(), found.points.end(), by_pressure);
    if (largest == found.points.end() || largest->pressure == 0.)
      return;
    const unsigned int line = line_of_point[largest->index];
    PressureSamples samples;
    for (const auto &point : found.points)
      if (line_of_point[point.index] == line)
      {
        samples.xi.push_back(point.position[0]);
        samples.weight.push_back(face.points[point.index].weight);
        samples.pressure.push_back(point.pressure);
        samples.trial.push_back(point.trial_pressure);
        samples.cell.push_back(point.patch);
      }
    const auto &of_line              = contact.lines()[line];
    samples.begin                    = face.points[of_line.front()].position[0];
    samples.end                      = face.points[of_line.back()].position[0];
    const auto recovered             = recover(samples);
    row[Column::contact_width]       = contact_width(samples, recovered);
    row[Column::largest_pressure]    = recovered.largest;
    row[Column::largest_pressure_xi] = recovered.place;
    row.across[4]                    = largest->position[2];
  }
} // namespace sprag
