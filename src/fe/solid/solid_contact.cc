// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_contact.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Vector;

  SolidContact::SolidContact(FrictionFace<3> face_, SurfaceContactProperties properties, FrictionLaw friction_,
                             const double layer_thickness_, const bool half)
      : face(std::move(face_))
      , friction(std::move(friction_))
      , layer_thickness(layer_thickness_)
      , contact(face, std::move(properties))
      , view(face, contact, half)
  {
  }

  void SolidContact::evaluate(const PortStep &step, SurfaceEvaluation &found)
  {
    contact.evaluate(step, friction, found);
  }

  void SolidContact::complete(SurfaceEvaluation &found)
  {
    contact.complete(found);
  }

  void SolidContact::evaluate_sliding(const SlidingState &state, SurfaceEvaluation &found)
  {
    contact.slide(state, friction, found);
  }

  PortPerturbation SolidContact::linearise(const SlidingState &state, SurfaceEvaluation &found)
  {
    return contact.linearise(state, friction, found);
  }

  std::vector<SurfaceMemory> SolidContact::touch(const Vector<double> &ports, const DrivePoint &drive, SurfaceEvaluation &found)
  {
    contact.touch({ ports, drive.x }, found);
    return {};
  }

  const PortSelection &SolidContact::reachable_ports(const double x, const OfLevers &theta)
  {
    return contact.reachable_ports(x, theta);
  }

  double SolidContact::gap_change(const SurfaceEvaluation &found, const Vector<double> &change_of_ports, unsigned int) const
  {
    const auto deepest =
        std::min_element(found.points.begin(), found.points.end(), [](const auto &a, const auto &b) { return a.gap < b.gap; });
    return contact.change_at(*deepest, found, change_of_ports)[0];
  }

  double SolidContact::mean_slip(const SurfaceEvaluation &found, const Vector<double> &from, const double from_x,
                                 const Vector<double> &to, const double to_x) const
  {
    double weighted = 0., weights = 0.;
    for (const auto &point : found.points)
      if (point.pressure > 0.)
      {
        const double weight = face.points[point.index].weight * point.pressure;
        weighted += weight * (contact.slip_at(point, { to, to_x }) - contact.slip_at(point, { from, from_x }));
        weights += weight;
      }
    return weights > 0. ? weighted / weights : 0.;
  }

  void SolidContact::observe(const SurfaceEvaluation &found, Row &row, unsigned int) const
  {
    view.observe(found, row);
    row[Column::Q]           = drive_force(found);
    row[Column::indentation] = indentation(found, row);
  }

  double SolidContact::drive_force(const SurfaceEvaluation &found) const
  {
    double sum = 0.;
    for (const auto &point : found.points)
      sum -= face.points[point.index].weight * point.end_force[4];
    return sum;
  }

  std::vector<unsigned int> SolidContact::line_at(const double zeta) const
  {
    double closest = std::numeric_limits<double>::max();
    for (const auto &node : face.nodes)
      closest = std::min(closest, std::abs(node.position[2] - zeta));
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < face.nodes.size(); ++i)
      if (std::abs(face.nodes[i].position[2] - zeta) < closest + 1e-6)
        result.push_back(i);
    return result;
  }

  /// Deflection under the contact beyond that on both sides of it, between the nodes closest to these places.
  double SolidContact::indentation(const SurfaceEvaluation &found, const Row &row) const
  {
    if (layer_thickness == 0. || !(row[Column::normal_resultant] > 0.))
      return 0.;
    const auto line       = line_at(row.across[4]);
    const double s        = row[Column::s];
    const double aside    = 0.5 * row[Column::contact_width] + 4. * layer_thickness;
    const auto deflection = [&](const double xi)
    {
      const auto is_closer = [&](const unsigned int a, const unsigned int b)
      { return std::abs(face.nodes[a].position[0] - xi) < std::abs(face.nodes[b].position[0] - xi); };
      return found.displacement[3 * *std::min_element(line.begin(), line.end(), is_closer) + 1];
    };
    return deflection(s) - 0.5 * (deflection(s - aside) + deflection(s + aside));
  }

  SurfaceShape SolidContact::surface_shape(const Vector<double> &displacements, unsigned int) const
  {
    SurfaceShape shape;
    for (const unsigned int node : line_at(0.))
    {
      shape.xi.push_back(face.nodes[node].position[0]);
      shape.along.push_back(displacements[3 * node]);
      shape.across.push_back(displacements[3 * node + 1]);
    }
    return shape;
  }
} // namespace sprag
