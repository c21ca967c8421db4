#include "fe/rigid_surface.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;

  /// Over the coordinates of a patch: two a node, theta, x.
  struct RigidSurface::Sum
  {
    static constexpr unsigned int theta = 2 * FacePatches::max_nodes;
    static constexpr unsigned int n     = theta + 2;

    double values[n]{};
    double tangent[n][n]{};

    /// Of a traction that changes with the slope of the slip along the face, as far as the face's direction goes with it.
    void add_slope(const FacePatches::Point &point, const dealii::Tensor<1, 4> &slip_row, const double traction_by_slope)
    {
      for (unsigned int b = 0; b < FacePatches::max_nodes; ++b)
        for (unsigned int e = 0; e < 2; ++e)
        {
          const double change       = point.weight * traction_by_slope * slip_row[e] * point.slopes[b];
          const unsigned int column = 2 * b + e;
          for (unsigned int i = 2; i < 4; ++i)
            tangent[theta + i - 2][column] -= slip_row[i] * change;
          for (unsigned int a = 0; a < FacePatches::max_nodes; ++a)
            for (unsigned int d = 0; d < 2; ++d)
              tangent[2 * a + d][column] -= point.shapes[a] * slip_row[d] * change;
        }
    }

    void add(const FacePatches::Point &point, const ContactResponse<4> &response)
    {
      const auto force    = point.weight * response.force;
      const auto tangents = point.weight * response.tangent;
      for (unsigned int i = 2; i < 4; ++i)
      {
        const unsigned int row = theta + i - 2;
        values[row] += force[i];
        for (unsigned int j = 2; j < 4; ++j)
          tangent[row][theta + j - 2] += tangents[i][j];
      }
      for (unsigned int a = 0; a < FacePatches::max_nodes; ++a)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const unsigned int row = 2 * a + d;
          values[row] += point.shapes[a] * force[d];
          for (unsigned int j = 2; j < 4; ++j)
          {
            tangent[row][theta + j - 2] += point.shapes[a] * tangents[d][j];
            tangent[theta + j - 2][row] += point.shapes[a] * tangents[j][d];
          }
          for (unsigned int b = 0; b < FacePatches::max_nodes; ++b)
            for (unsigned int e = 0; e < 2; ++e)
              tangent[row][2 * b + e] += point.shapes[a] * point.shapes[b] * tangents[d][e];
        }
    }
  };

  RigidSurface::RigidSurface(const FrictionFace<2> &friction_face, Obstacle convex_body, const StaticPorts &ports_)
      : face(friction_face)
      , obstacle(std::move(convex_body))
      , ports(ports_)
  {
  }

  void RigidSurface::enter(const FaceConfiguration &places)
  {
    at = places;
  }

  ContactKinematics<4> RigidSurface::kinematics_of(const LeverPoint &point) const
  {
    return obstacle(point, at.x, at.theta);
  }

  /// The gap along a straight patch to a convex obstacle lies above its tangent at the first point; the margin covers bending.
  bool RigidSurface::is_near(const FacePatches::Patch &patch) const
  {
    const auto nodal   = FacePatches::nodal(patch, *at.displacement);
    const auto begin   = FacePatches::position(face.points()[patch.begin], nodal);
    const auto end     = FacePatches::position(face.points()[patch.end - 1], nodal);
    const auto contact = kinematics_of(begin);
    const double rise  = contact.gap_row[0] * (end.xi - begin.xi) + contact.gap_row[1] * (end.eta - begin.eta);
    return contact.gap + std::min(0., rise) < 0.02 * patch.length;
  }

  std::vector<unsigned int> RigidSurface::near()
  {
    std::vector<unsigned int> result;
    for (unsigned int patch = 0; patch < face.patches().size(); ++patch)
      if (is_near(face.patches()[patch]))
        result.push_back(patch);
    return result;
  }

  namespace
  {
    /// Derivative of a deformed point's position along the undeformed face.
    Tensor<1, 4> direction_of_face(const FacePatches::Point &point, const FacePatches::Nodal &displacement)
    {
      Tensor<1, 4> result({ 1., 0., 0., 0. });
      for (unsigned int i = 0; i < displacement.size(); ++i)
        result[i % 2] += point.slopes[i / 2] * displacement[i];
      return result;
    }
  } // namespace

  void RigidSurface::evaluate(const unsigned int patch, const StaticStep &step, std::vector<StaticPoint> &points,
                              std::vector<StaticPatch> &loaded)
  {
    const auto &of   = face.patches()[patch];
    const auto nodal = FacePatches::nodal(of, *at.displacement);
    bool touches     = false;
    Sum sum;
    for (unsigned int q = of.begin; q < of.end; ++q)
    {
      const auto &memory = step.start[q];
      auto &point        = points.emplace_back();
      point.index        = q;
      point.position     = FacePatches::position(face.points()[q], nodal);
      auto contact       = kinematics_of(point.position);
      if (!set_trial(memory, contact.gap, contact.slip - memory.slip, step.law, point))
        continue;
      touches              = true;
      const auto direction = direction_of_face(face.points()[q], nodal);
      const auto shift     = slip_shift(face, q, contact.slip_row * direction, step);
      contact.slip_shift   = shift.total();
      point.response       = contact_response(contact, memory, step.law, step.mode);
      set_slips(memory, step, shift.slip, point);
      const double by_slope = shift.d_slope * point.response.d_shift;
      point.response.tangent -= by_slope * outer_product(contact.slip_row, contact.slip_curvature * direction);
      sum.add(face.points()[q], point.response);
      if (by_slope != 0.)
        sum.add_slope(face.points()[q], contact.slip_row, by_slope);
    }
    if (touches)
      loaded.push_back(on_ports(of, sum));
  }

  StaticPatch RigidSurface::on_ports(const FacePatches::Patch &patch, const Sum &sum) const
  {
    StaticPatch result;
    std::vector<unsigned int> of_sum;
    for (unsigned int i = 0; i < 2 * patch.n_nodes; ++i)
    {
      result.ports.push_back(2 * patch.nodes[i / 2] + i % 2);
      of_sum.push_back(i);
    }
    for (unsigned int port = ports.rotation(); port < ports.size(); ++port)
    {
      result.ports.push_back(port);
      of_sum.push_back(Sum::theta + port - ports.rotation());
    }
    set_on_ports(
        of_sum, Sum::theta + 1, [&](const unsigned int i) { return sum.values[i]; },
        [&](const unsigned int i, const unsigned int j) { return sum.tangent[i][j]; }, result);
    return result;
  }

  std::vector<double> RigidSurface::slips(const unsigned int patch)
  {
    const auto &of   = face.patches()[patch];
    const auto nodal = FacePatches::nodal(of, *at.displacement);
    std::vector<double> result;
    for (unsigned int q = of.begin; q < of.end; ++q)
      result.push_back(kinematics_of(FacePatches::position(face.points()[q], nodal)).slip);
    return result;
  }
} // namespace sprag
