// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "fe/contact/face_observation.h"

namespace sprag
{
  double FaceContact::drive_force(const FaceEvaluation &found) const
  {
    double sum = 0.;
    for (const auto &point : found.points)
      sum -= face.points[point.index].weight * point.end_force[3];
    return sum;
  }

  void FaceContact::observe(const FaceEvaluation &found, Row &row, unsigned int) const
  {
    FaceView(body.friction_face(), properties.layer_thickness).observe(found, row);
    row[Column::Q] = drive_force(found);
  }

  SurfaceShape FaceContact::surface_shape(const dealii::Vector<double> &displacements, unsigned int) const
  {
    SurfaceShape shape;
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int node = 0; node < nodes.size(); ++node)
    {
      shape.xi.push_back(nodes[node].position[0]);
      shape.along.push_back(displacements[2 * node]);
      shape.across.push_back(displacements[2 * node + 1]);
    }
    return shape;
  }

  FacePoints FaceContact::face_points() const
  {
    return FaceView(body.friction_face(), properties.layer_thickness).points();
  }

  FaceState FaceContact::face_state(const FaceEvaluation &found, const DrivePoint &drive) const
  {
    return FaceView(body.friction_face(), properties.layer_thickness).state(found, drive);
  }
} // namespace sprag
