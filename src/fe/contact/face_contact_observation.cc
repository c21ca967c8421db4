#include "fe/contact/face_contact.h"

namespace sprag
{
  FaceView FaceContact::view() const
  {
    return { body, states, displacement, step_duration, penetration() };
  }

  void FaceContact::observe(Row &row) const
  {
    observe_face(view(), properties.layer_thickness, row);
    row[Column::Q] = 0.;
    for (const auto &state : states)
      row[Column::Q] -= face.points()[state.index].weight * state.end_force[3];
  }

  SurfaceShape FaceContact::surface_shape(const dealii::Vector<double> &displacements) const
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
    return sprag::face_points(body);
  }

  FaceState FaceContact::face_state(const DrivePoint &drive) const
  {
    return sprag::face_state(view(), drive);
  }
} // namespace sprag
