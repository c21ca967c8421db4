// SPDX-License-Identifier: GPL-3.0-only
#include "laws/contact_step.h"

#include "laws/point_law.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;

  MeanNormalForce mean_normal_force(const NormalLaw &law, const double gap_begin, const double gap_end)
  {
    const auto gap  = variable<Dual<double, 1>>(gap_end, 0);
    const auto end  = spring_force(law, gap);
    const auto mean = mean_spring_force(law, gap_begin, gap);
    return { spring_force(law, gap_begin), end.v, end.d[0], mean.v, mean.d[0], spring_energy(law, gap_end) };
  }

  SlidingFriction sliding_friction(const FrictionLaw &law, const double speed)
  {
    const auto mu    = friction_coefficient(law, std::abs(speed));
    const double v_r = law.regularisation_speed;
    if (v_r == 0.)
      return { std::copysign(mu.coefficient, speed), mu.derivative };
    const double root  = std::hypot(speed, v_r);
    const double share = speed / root;
    return { mu.coefficient * share, mu.derivative * std::abs(share) + mu.coefficient * v_r * v_r / (root * root * root) };
  }

  EndDamping end_damping(const double damping, const double normal, const double gap, const double gap_rate)
  {
    if (gap >= 0. || damping == 0.)
      return {};
    const double dashpot = -damping * gap_rate;
    return dashpot >= -normal ? EndDamping{ dashpot, 0., -damping } : EndDamping{ -normal, -1., 0. };
  }

  template <int slips>
  EndFriction<slips> end_friction(const FrictionHistory<slips> &history, const double stiffness,
                                  const Tensor<1, slips> &slip_change, const double pressure, const FrictionLaw &law,
                                  const double dt)
  {
    using N = Dual<double, slips + 1>; // of slip and pressure
    SlipMemory<double, slips> memory;
    memory.step = history.step;
    Several<N, slips> slip;
    for (int i = 0; i < slips; ++i)
    {
      memory.traction[i]   = history.traction[i];
      memory.slip_speed[i] = history.slip_speed[i];
      slip[i]              = variable<N>(slip_change[i], i);
    }
    const auto found = end_friction(SlipLaw{ law, stiffness }, memory, slip, variable<N>(pressure, slips), dt);
    EndFriction<slips> result;
    for (int i = 0; i < slips; ++i)
    {
      result.traction[i]   = found.traction[i].v;
      result.slip_speed[i] = found.slip_speed[i];
      result.d_pressure[i] = found.traction[i].d[slips];
      for (int j = 0; j < slips; ++j)
        result.d_slip[i][j] = found.traction[i].d[j];
    }
    result.mu         = found.mu;
    result.slipping   = found.slipping;
    result.energy     = found.energy;
    result.dissipated = found.dissipated;
    result.creep      = found.creep;
    return result;
  }

  template EndFriction<1> end_friction(const FrictionHistory<1> &, double, const Tensor<1, 1> &, double, const FrictionLaw &,
                                       double);
  template EndFriction<2> end_friction(const FrictionHistory<2> &, double, const Tensor<1, 2> &, double, const FrictionLaw &,
                                       double);
} // namespace sprag
