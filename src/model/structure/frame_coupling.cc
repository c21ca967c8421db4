// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/frame_coupling.h"

#include "base/dual.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    double mix(const double begin, const double end, const double alpha)
    {
      return (1. - alpha) * end + alpha * begin;
    }

    Kinematic at_end(const Kinematic &begin, const Vector<double> &end, const StepWeights &w)
    {
      Kinematic result = unaccelerated(begin, w);
      set_position(result, end, w);
      return result;
    }

    /// Mass products of the coupling with the accelerations of (p_eta, p_xi, u).
    Vector<double> mass_product(const InterfaceLayout &layout, const PerLever &theta, const Kinematic &q)
    {
      Vector<double> result(layout.size());
      for (unsigned int lever = 0; lever < layout.levers; ++lever)
      {
        const double s         = std::sin(theta[lever]);
        const double c         = std::cos(theta[lever]);
        const unsigned int eta = layout.momentum_eta(lever);
        const unsigned int xi  = layout.momentum_xi(lever);
        result[eta]            = s * q.acceleration[layout.support()];
        result[xi]             = -c * q.acceleration[layout.support()];
        result[layout.support()] += s * q.acceleration[eta] - c * q.acceleration[xi];
      }
      return result;
    }
  } // namespace

  FrameCoupling::FrameCoupling(const InterfaceLayout &layout_, const double rest_inclination)
      : layout(layout_)
      , rest(rest_inclination)
  {
  }

  /// Returns theta where the forces of a step are balanced.
  double FrameCoupling::inclination(const unsigned int lever, const Kinematic &begin, const Kinematic &end,
                                    const StepWeights &w) const
  {
    const unsigned int hub = layout.rotation(lever);
    return rest + mix(begin.position[hub], end.position[hub], w.alpha_f);
  }

  void FrameCoupling::add_forces(const Kinematic &begin, const Vector<double> &end, const StepWeights &w,
                                 InterfaceForces &forces) const
  {
    if (!layout.sprung)
      return;
    const Kinematic at = at_end(begin, end, w);
    add_dofs(coupled_dofs(), forces);
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      using N                   = Dual<double, 4>; // of the dofs
      const unsigned int dofs[] = { layout.momentum_eta(lever), layout.momentum_xi(lever), layout.rotation(lever),
                                    layout.support() };
      const auto rate           = [&](const unsigned int i)
      { return variable<N>(mix(begin.velocity[dofs[i]], at.velocity[dofs[i]], w.alpha_f), i, w.damping()); };
      const auto acceleration = [&](const unsigned int i)
      { return variable<N>(mix(begin.acceleration[dofs[i]], at.acceleration[dofs[i]], w.alpha_m), i, w.mass()); };
      const N theta = variable<N>(inclination(lever, begin, at, w), 2, w.stiffness());
      const N s = sine(theta), c = cosine(theta), u_rate = rate(3), u_acceleration = acceleration(3);
      const N across  = c * rate(0) + s * rate(1);
      const N moved[] = { -(s * u_acceleration + c * rate(2) * u_rate), c * u_acceleration - s * rate(2) * u_rate,
                          u_rate * across, -(s * acceleration(0) - c * acceleration(1) + rate(2) * across) };
      for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int row = find_index(dofs[i], forces.dofs);
        forces.values[row] += moved[i].v;
        for (unsigned int j = 0; j < 4 && forces.has_tangent; ++j)
          forces.tangent(row, find_index(dofs[j], forces.dofs)) += moved[i].d[j];
      }
    }
  }

  DofSelection FrameCoupling::coupled_dofs() const
  {
    if (!layout.sprung)
      return {};
    std::vector<unsigned int> result;
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      result.insert(result.end(), { layout.rotation(lever), layout.momentum_eta(lever), layout.momentum_xi(lever) });
    result.push_back(layout.support());
    return result;
  }

  void FrameCoupling::add_inertia(const DofSelection &dofs, const PerLever &theta, FullMatrix<double> &inertia) const
  {
    if (!layout.sprung)
      return;
    const unsigned int support = find_index(layout.support(), dofs);
    const auto couple          = [&](const unsigned int dof, const double mass)
    {
      inertia(find_index(dof, dofs), support) += mass;
      inertia(support, find_index(dof, dofs)) += mass;
    };
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      couple(layout.momentum_eta(lever), std::sin(theta[lever]));
      couple(layout.momentum_xi(lever), -std::cos(theta[lever]));
    }
  }

  void FrameCoupling::add_work(const Kinematic &begin, const Vector<double> &end, const StepWeights &w, StepWork &work) const
  {
    if (!layout.sprung)
      return;
    const Kinematic after = at_end(begin, end, w);
    PerLever theta{};
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      theta[lever] = inclination(lever, begin, after, w);
    work.algorithmic +=
        inertial_dissipation(begin, after, mass_product(layout, theta, begin), mass_product(layout, theta, after), w);
  }

  double FrameCoupling::kinetic_energy(const Kinematic &motion) const
  {
    double momentum = 0.;
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      const double theta = rest + motion.position[layout.rotation(lever)];
      momentum += std::sin(theta) * motion.velocity[layout.momentum_eta(lever)] -
                  std::cos(theta) * motion.velocity[layout.momentum_xi(lever)];
    }
    return motion.velocity[layout.support()] * momentum;
  }
} // namespace sprag
