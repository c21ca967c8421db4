// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_observation.h"

#include "fe/contact/pressure_recovery.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// An evaluation and the face that it is of.
    struct FoundFace
    {
      const FrictionFace<2> &face;
      const FaceEvaluation &found;
    };

    PressureSamples samples_of(const FoundFace &contact)
    {
      const auto &face = contact.face;
      PressureSamples samples;
      const auto ends_before = [](const FacePatch &patch, const unsigned int point) { return patch.end <= point; };
      auto patch             = face.patches.begin();
      if (!contact.found.points.empty())
        patch = std::lower_bound(patch, face.patches.end(), contact.found.points.front().index, ends_before);
      for (const auto &point : contact.found.points)
      {
        while (ends_before(*patch, point.index))
          ++patch;
        samples.xi.push_back(point.position[0]);
        samples.weight.push_back(face.points[point.index].weight);
        samples.pressure.push_back(point.pressure);
        samples.trial.push_back(point.trial_pressure);
        samples.cell.push_back(static_cast<unsigned int>(patch - face.patches.begin()));
      }
      samples.begin = face.points.front().position[0];
      samples.end   = face.points.back().position[0];
      return samples;
    }

    /// Displacement along xi and eta of an integration point [mm].
    dealii::Tensor<1, 2> displacement(const FoundFace &contact, const unsigned int point)
    {
      dealii::Tensor<1, 2> result;
      for (const auto &[node, shape] : contact.face.points[point].nodes)
        for (unsigned int d = 0; d < 2; ++d)
          result[d] += shape * contact.found.displacement[2 * node + d];
      return result;
    }

    /// Displacement along eta at xi, linear between the points [mm].
    double deflection(const FoundFace &contact, const double xi)
    {
      const auto &points   = contact.face.points;
      const auto is_before = [](const auto &point, const double value) { return point.position[0] < value; };
      const auto after     = std::lower_bound(points.begin() + 1, points.end() - 1, xi, is_before);
      const auto before    = after - 1;
      const double share   = std::clamp((xi - before->position[0]) / (after->position[0] - before->position[0]), 0., 1.);
      const auto index     = static_cast<unsigned int>(before - points.begin());
      return (1. - share) * displacement(contact, index)[1] + share * displacement(contact, index + 1)[1];
    }

    double indentation(const FoundFace &contact, const double centre, const double width, const double layer_thickness)
    {
      if (layer_thickness == 0.)
        return 0.;
      const double aside = 0.5 * width + 4. * layer_thickness;
      return deflection(contact, centre) - 0.5 * (deflection(contact, centre - aside) + deflection(contact, centre + aside));
    }

    double cone_violation(const std::vector<FacePointState<2>> &points)
    {
      double excess = 0.;
      double peak   = 0.;
      for (const auto &point : points)
      {
        excess = std::max(excess, point.traction.norm() - point.mu * point.pressure);
        peak   = std::max(peak, point.mu * point.pressure);
      }
      return peak > 0. ? excess / peak : 0.;
    }

    /// Friction at a point under pressure.
    struct PointFriction
    {
      double ratio = 0.; ///< of friction to pressure
      double mu    = 0.;
    };

    /// Returns the friction of every point; those without pressure take it from one beside them.
    std::vector<PointFriction> frictions(const std::vector<FacePointState<2>> &points)
    {
      const auto is_closed   = [](const FacePointState<2> &point) { return point.pressure > 0.; };
      const auto friction_of = [](const FacePointState<2> &point) {
        return PointFriction{ point.traction[0] / point.pressure, point.mu };
      };
      const auto first = std::find_if(points.begin(), points.end(), is_closed);
      auto friction    = first == points.end() ? PointFriction() : friction_of(*first);
      std::vector<PointFriction> result;
      for (const auto &point : points)
      {
        if (is_closed(point))
          friction = friction_of(point);
        result.push_back(friction);
      }
      return result;
    }

    /// Returns the friction that the recovered pressure takes along: in the ratio of each point, then as far towards mu p, either
    /// way, as the resultant of the points asks, the same share of the way everywhere.
    std::vector<double> recovered_traction(const FoundFace &contact, const std::vector<double> &pressure)
    {
      const auto friction = frictions(contact.found.points);
      const auto area     = [&](const std::size_t i) { return contact.face.points[contact.found.points[i].index].weight; };
      std::vector<double> result;
      double lacking = 0.;
      for (std::size_t i = 0; i < friction.size(); ++i)
      {
        result.push_back(friction[i].ratio * pressure[i]);
        lacking += area(i) * (contact.found.points[i].traction[0] - result.back());
      }
      const auto way = [&](const std::size_t i) { return std::copysign(friction[i].mu * pressure[i], lacking) - result[i]; };
      double whole   = 0.;
      for (std::size_t i = 0; i < friction.size(); ++i)
        whole += area(i) * way(i);
      if (lacking * whole > 0.)
        for (std::size_t i = 0; i < friction.size(); ++i)
          result[i] += std::min(1., lacking / whole) * way(i);
      return result;
    }

    /// Returns the share of a force on a point, by its index, that nodes take which the hub does not hold.
    double share_of_free_nodes(const FoundFace &contact, const unsigned int point)
    {
      double share = 0.;
      for (const auto &node : contact.face.points[point].nodes)
        share += node.second;
      return share;
    }

    /// Sums over the points under pressure.
    struct Sums
    {
      double normal = 0., friction = 0., position = 0., speed = 0., mu = 0., power = 0., energy = 0., active = 0.;
      double elastic_slip = 0.; ///< the largest
      double P = 0., F = 0.;
    };

    Sums sum(const FoundFace &contact)
    {
      Sums sums;
      const double dt = contact.found.duration;
      for (const auto &point : contact.found.points)
      {
        if (!(point.trial_pressure > 0.))
          continue;
        const double area   = contact.face.points[point.index].weight;
        const double normal = area * point.pressure;
        const double share  = share_of_free_nodes(contact, point.index);
        sums.F -= area * share * point.end_force[0];
        sums.P += area * share * point.end_force[1];
        const auto moved  = displacement(contact, point.index);
        const double rate = dt > 0. ? point.slip_change[0] / dt : 0.;
        sums.normal += normal;
        sums.friction += area * point.traction[0];
        sums.position += normal * point.position[0];
        sums.speed += normal * rate;
        sums.mu += normal * point.mu;
        sums.power += area * point.traction[0] * rate;
        sums.energy += 0.5 * area * (point.end_force[0] * moved[0] + point.end_force[1] * moved[1]);
        sums.active += 1.;
        sums.elastic_slip = std::max(sums.elastic_slip, point.elastic_slip);
      }
      return sums;
    }
  } // namespace

  void FaceView::observe(const FaceEvaluation &found, Row &row) const
  {
    const FoundFace contact{ face, found };
    const auto samples            = samples_of(contact);
    const auto recovery           = recover(samples);
    row[Column::contact_width]    = contact_width(samples, recovery);
    row[Column::largest_pressure] = recovery.largest;
    if (recovery.largest > 0.)
      row[Column::largest_pressure_xi] = recovery.place;
    row[Column::indentation] = 0.;
    observe_resultants(found, row);
    if (row[Column::normal_resultant] > 0.)
      row[Column::indentation] = indentation(contact, row[Column::s], row[Column::contact_width], layer_thickness);
  }

  void FaceView::observe_resultants(const FaceEvaluation &found, Row &row) const
  {
    const FoundFace contact{ face, found };
    const Sums sums                 = sum(contact);
    row[Column::normal_resultant]   = sums.normal;
    row[Column::friction_resultant] = sums.friction;
    row[Column::friction_power]     = sums.power;
    row[Column::elastic_energy]     = sums.energy;
    row[Column::active_points]      = sums.active;
    row[Column::elastic_slip]       = sums.elastic_slip;
    row[Column::penetration]        = contact.found.penetration();
    row[Column::cone_violation]     = cone_violation(contact.found.points);
    row[Column::P]                  = sums.P;
    row[Column::F]                  = sums.F;
    if (sums.normal > 0.)
    {
      row[Column::s]  = sums.position / sums.normal;
      row[Column::mu] = sums.mu / sums.normal;
      if (contact.found.duration > 0.)
        row[Column::v_rel] = sums.speed / sums.normal;
    }
  }

  FacePoints FaceView::points() const
  {
    FacePoints result;
    for (const auto &point : face.points)
    {
      result.xi.push_back(point.position[0]);
      result.weight.push_back(point.weight);
    }
    return result;
  }

  FaceState FaceView::state(const FaceEvaluation &found, const DrivePoint &drive) const
  {
    const FoundFace contact{ face, found };
    FaceState result;
    result.time         = drive.time;
    result.x            = drive.x;
    const std::size_t n = contact.face.points.size();
    result.pressure.resize(n);
    result.traction.resize(n);
    const auto recovery = recover(samples_of(contact));
    const auto traction = recovered_traction(contact, recovery.pressure);
    for (std::size_t i = 0; i < contact.found.points.size(); ++i)
    {
      result.pressure[contact.found.points[i].index] = recovery.pressure[i];
      result.traction[contact.found.points[i].index] = traction[i];
    }
    return result;
  }
} // namespace sprag
