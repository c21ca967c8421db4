#include "fe/face_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  template <class Surface>
  std::vector<FaceContact::PointState> FaceStep<Surface>::observed_points() const
  {
    std::vector<FaceContact::PointState> result(states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
    {
      const auto &state       = states[i];
      auto &point             = result[i];
      point.index             = state.index;
      point.position          = state.position;
      point.gap               = state.gap;
      point.trial_pressure    = -properties.penalties.normal * state.gap;
      point.slip_change       = state.slip_change;
      point.elastic_slip      = std::abs(state.traction) / properties.penalties.tangential;
      point.response.pressure = state.pressure;
      point.response.traction = state.traction;
      point.response.mu       = state.mu;
      point.response.slipping = state.slipping;
      for (unsigned int d = 0; d < 3; ++d)
        point.response.force[d] = state.end_force[d];
    }
    return result;
  }

  template <class Surface>
  FaceView FaceStep<Surface>::view(const std::vector<FaceContact::PointState> &points) const
  {
    double penetration = 0.;
    for (const auto &point : points)
      penetration = std::max(penetration, -point.gap);
    return { body, points, displacement, step_duration, penetration };
  }

  template <class Surface>
  void FaceStep<Surface>::observe(Row &row) const
  {
    const auto points = observed_points();
    observe_face(view(points), properties.layer_thickness, row);
    row[Column::Q] = 0.;
    for (const auto &state : states)
      row[Column::Q] -= face.points()[state.index].weight * state.end_force[3];
  }

  template <class Surface>
  SurfaceShape FaceStep<Surface>::surface_shape(const dealii::Vector<double> &displacements) const
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

  template <class Surface>
  FacePoints FaceStep<Surface>::face_points() const
  {
    return sprag::face_points(body);
  }

  template <class Surface>
  FaceState FaceStep<Surface>::face_state(const DrivePoint &drive) const
  {
    const auto points = observed_points();
    return sprag::face_state(view(points), drive);
  }

  template class FaceStep<CircleSurface>;
  template class FaceStep<PairSurface>;
} // namespace sprag
