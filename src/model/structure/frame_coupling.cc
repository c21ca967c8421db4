// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/frame_coupling.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Positions, rates and accelerations of the dofs of a lever that the coupling acts on: momentum along eta and xi, support.
    struct Local
    {
      double theta = 0., theta_rate = 0.;
      double p_eta_rate = 0., p_xi_rate = 0., u_rate = 0.;
      double p_eta_acceleration = 0., p_xi_acceleration = 0., u_acceleration = 0.;
    };

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

    Local weighted(const InterfaceLayout &layout, const unsigned int lever, const double rest, const Kinematic &begin,
                   const Kinematic &end, const StepWeights &w)
    {
      const auto rate         = [&](const unsigned int dof) { return mix(begin.velocity[dof], end.velocity[dof], w.alpha_f); };
      const auto acceleration = [&](const unsigned int dof)
      { return mix(begin.acceleration[dof], end.acceleration[dof], w.alpha_m); };
      const unsigned int hub = layout.rotation(lever);
      return { rest + mix(begin.position[hub], end.position[hub], w.alpha_f),
               rate(hub),
               rate(layout.momentum_eta(lever)),
               rate(layout.momentum_xi(lever)),
               rate(layout.support()),
               acceleration(layout.momentum_eta(lever)),
               acceleration(layout.momentum_xi(lever)),
               acceleration(layout.support()) };
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

  void FrameCoupling::add_forces(const Kinematic &begin, const Vector<double> &end, const StepWeights &w,
                                 InterfaceForces &forces) const
  {
    if (!layout.sprung)
      return;
    const Kinematic at = at_end(begin, end, w);
    add_dofs(coupled_dofs(), forces);
    const auto place = [&](const unsigned int dof) { return find_index(dof, forces.dofs); };
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      const Local q       = weighted(layout, lever, rest, begin, at, w);
      const double s      = std::sin(q.theta);
      const double c      = std::cos(q.theta);
      const double across = c * q.p_eta_rate + s * q.p_xi_rate;

      const unsigned int hub = place(layout.rotation(lever)), eta = place(layout.momentum_eta(lever)),
                         xi = place(layout.momentum_xi(lever)), u = place(layout.support());
      forces.values[eta] -= s * q.u_acceleration + c * q.theta_rate * q.u_rate;
      forces.values[xi] += c * q.u_acceleration - s * q.theta_rate * q.u_rate;
      forces.values[hub] += q.u_rate * across;
      forces.values[u] -= s * q.p_eta_acceleration - c * q.p_xi_acceleration + q.theta_rate * across;

      if (!forces.has_tangent)
        continue;
      const double m = w.mass();
      const double r = w.damping();
      const double k = w.stiffness();
      forces.tangent(eta, u) -= s * m + c * q.theta_rate * r;
      forces.tangent(eta, hub) -= k * (c * q.u_acceleration - s * q.theta_rate * q.u_rate) + r * c * q.u_rate;
      forces.tangent(xi, u) += c * m - s * q.theta_rate * r;
      forces.tangent(xi, hub) += k * (-s * q.u_acceleration - c * q.theta_rate * q.u_rate) - r * s * q.u_rate;
      forces.tangent(hub, u) += r * across;
      forces.tangent(hub, eta) += r * q.u_rate * c;
      forces.tangent(hub, xi) += r * q.u_rate * s;
      forces.tangent(hub, hub) += k * q.u_rate * (-s * q.p_eta_rate + c * q.p_xi_rate);
      forces.tangent(u, eta) -= s * m + q.theta_rate * c * r;
      forces.tangent(u, xi) -= -c * m + q.theta_rate * s * r;
      forces.tangent(u, hub) -= k * (c * q.p_eta_acceleration + s * q.p_xi_acceleration) + r * across +
                                k * q.theta_rate * (-s * q.p_eta_rate + c * q.p_xi_rate);
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
      theta[lever] = weighted(layout, lever, rest, begin, after, w).theta;
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
