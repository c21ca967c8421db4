#include "fe/face_step.h"

#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  void FaceStepContact::evaluate_sliding(const SlidingState &sliding)
  {
    // Slip in a second.
    clear(sliding.ports, 1.);
    const auto at    = configuration(sliding.ports, sliding.drive.x);
    const auto law   = friction_of_step(properties.friction, sliding.drive.v);
    const auto range = clip(face.near(at, properties.geometry.cylinder_radius));
    sliding_law      = law;
    theta            = at.theta;
    relative_x       = at.x;
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      slide_patch(patch, at, sliding, law);
    sum_forces();
  }

  void FaceStepContact::slide_patch(const unsigned int patch, const FaceConfiguration &at, const SlidingState &sliding,
                                    const FrictionLaw &law)
  {
    const auto &chosen  = face.patches()[patch];
    const auto nodal    = FacePatches::nodal(chosen, *at.displacement);
    const bool slides   = sliding.friction == ContactFriction::sliding;
    const auto &penalty = properties.penalties;
    PatchForces of_patch;
    of_patch.patch = patch;
    bool touched   = false;
    for (unsigned int q = chosen.begin; q < chosen.end; ++q)
    {
      const auto &point = face.points()[q];
      PointState &state = states.emplace_back();
      state.index       = q;
      state.patch       = patch;
      state.position    = FacePatches::position(point, nodal);
      state.slip_change = sliding.speed;
      state.gap         = gap(state.position, at, properties.geometry.cylinder_radius);
      if (state.gap >= 0.)
        continue;
      const auto contact = moving_circle_contact(properties.geometry, state.position, at.x, at.theta);
      if (sliding.rates != nullptr)
        state.slip_change += contact.slip_row * point_change(point, chosen, *sliding.rates);
      const auto share        = slides ? sliding_friction(law, state.slip_change) : SlidingFriction{};
      state.pressure          = -penalty.normal * state.gap;
      state.traction          = share.coefficient * state.pressure;
      state.mu                = slides ? friction_coefficient(law, std::abs(state.slip_change)).coefficient : 0.;
      state.slipping          = slides;
      state.end_force         = state.pressure * contact.gap_row - state.traction * contact.slip_row;
      state.memory.traction   = state.traction;
      state.memory.slip_speed = sliding.speed;
      state.memory.point      = q;
      const double elastic    = law.regularisation_speed > 0. ? 0. : 0.5 * state.traction * state.traction / penalty.tangential;
      stored += point.weight * (0.5 * penalty.normal * state.gap * state.gap + elastic);
      compression = std::max(compression, -state.gap);
      add(point, chosen.n_nodes, state.end_force, sliding_tangent(sliding.part, sliding.friction, contact, share, state.pressure),
          of_patch);
      touched = true;
    }
    if (touched)
      loaded.push_back(of_patch);
  }

  Tensor<2, 4> FaceStepContact::sliding_tangent(const TangentPart part, const ContactFriction friction,
                                                const ContactKinematics<4> &contact, const SlidingFriction &share,
                                                const double pressure) const
  {
    const auto &penalty = properties.penalties;
    switch (part)
    {
    case TangentPart::all:
      return sliding_tangent(TangentPart::pressure, friction, contact, share, pressure) +
             sliding_tangent(TangentPart::friction, friction, contact, share, pressure);
    case TangentPart::pressure:
      return -penalty.normal * outer_product(contact.gap_row, contact.gap_row) + pressure * contact.gap_curvature;
    case TangentPart::friction:
      if (friction == ContactFriction::stuck)
        return -penalty.tangential * outer_product(contact.slip_row, contact.slip_row);
      return share.coefficient *
             (penalty.normal * outer_product(contact.slip_row, contact.gap_row) - pressure * contact.slip_curvature);
    case TangentPart::friction_rate:
      return -share.derivative * pressure * outer_product(contact.slip_row, contact.slip_row);
    case TangentPart::pressure_rate:
      break;
    }
    return {};
  }

  std::vector<FrictionDelay> FaceStepContact::friction_delays() const
  {
    std::vector<FrictionDelay> result;
    const auto &penalty = properties.penalties;
    for (const auto &state : states)
    {
      if (!state.slipping || sliding_law.regularisation_speed > 0.)
        continue;
      const auto share  = sliding_friction(sliding_law, state.slip_change);
      const double time = share.derivative * state.pressure / penalty.tangential;
      if (!(time > 0.))
        continue;
      const auto contact  = moving_circle_contact(properties.geometry, state.position, relative_x, theta);
      const double weight = face.points()[state.index].weight;
      const auto on_ports = [&](const Tensor<1, 4> &row) { return spread(row, state); };
      result.push_back({ time, on_ports(-weight * contact.slip_row),
                         on_ports(-share.coefficient * penalty.normal * contact.gap_row),
                         on_ports(share.derivative * state.pressure * contact.slip_row) });
    }
    return result;
  }

  /// A row of a point's coordinates as one of the loaded ports.
  Vector<double> FaceStepContact::spread(const Tensor<1, 4> &row, const PointState &state) const
  {
    Vector<double> result(static_cast<unsigned int>(summed.ports.size()));
    const auto &point         = face.points()[state.index];
    const auto &patch         = face.patches()[state.patch];
    const bool sprung         = properties.ports.sprung;
    const unsigned int turned = result.size() - (sprung ? 2 : 1);
    for (unsigned int a = 0; a < patch.n_nodes; ++a)
      for (unsigned int d = 0; d < 2; ++d)
        result[place[patch.nodes[a]] + d] += point.shapes[a] * row[d];
    result[turned] = row[2];
    if (sprung)
      result[turned + 1] = -row[3];
    return result;
  }
} // namespace sprag
