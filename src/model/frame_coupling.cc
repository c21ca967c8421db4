#include "model/frame_coupling.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Positions, rates and accelerations of the ports that the coupling acts on: momentum along eta and xi, support.
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

    Local weighted(const PortLayout &ports, const double rest, const Kinematic &begin, const Kinematic &end, const StepWeights &w)
    {
      const auto rate         = [&](const unsigned int port) { return mix(begin.velocity[port], end.velocity[port], w.alpha_f); };
      const auto acceleration = [&](const unsigned int port)
      { return mix(begin.acceleration[port], end.acceleration[port], w.alpha_m); };
      const unsigned int hub = ports.rotation();
      return { rest + mix(begin.position[hub], end.position[hub], w.alpha_f),
               rate(hub),
               rate(ports.momentum_eta()),
               rate(ports.momentum_xi()),
               rate(ports.support()),
               acceleration(ports.momentum_eta()),
               acceleration(ports.momentum_xi()),
               acceleration(ports.support()) };
    }

    /// Mass products of the coupling with the accelerations of (p_eta, p_xi, u).
    Vector<double> mass_product(const PortLayout &ports, const double theta, const Kinematic &q)
    {
      const double s = std::sin(theta);
      const double c = std::cos(theta);
      Vector<double> result(ports.size());
      result[ports.momentum_eta()] = s * q.acceleration[ports.support()];
      result[ports.momentum_xi()]  = -c * q.acceleration[ports.support()];
      result[ports.support()]      = s * q.acceleration[ports.momentum_eta()] - c * q.acceleration[ports.momentum_xi()];
      return result;
    }
  } // namespace

  FrameCoupling::FrameCoupling(const PortLayout &ports, const double rest_inclination)
      : layout(ports)
      , rest(rest_inclination)
  {
  }

  const PortForces &FrameCoupling::add_forces(const PortForces &contact, const Kinematic &begin, const Vector<double> &end,
                                              const StepWeights &w)
  {
    if (!layout.sprung)
      return contact;
    const Local q       = weighted(layout, rest, begin, at_end(begin, end, w), w);
    const double s      = std::sin(q.theta);
    const double c      = std::cos(q.theta);
    const double across = c * q.p_eta_rate + s * q.p_xi_rate;

    // Ports of the contact with those of the coupling: rotation, p_eta, p_xi, support.
    sum.ports = contact.ports;
    for (const unsigned int port : coupled_ports())
      sum.ports.push_back(port);
    std::sort(sum.ports.begin(), sum.ports.end());
    sum.ports.erase(std::unique(sum.ports.begin(), sum.ports.end()), sum.ports.end());
    const auto place = [&](const unsigned int port)
    { return static_cast<unsigned int>(std::lower_bound(sum.ports.begin(), sum.ports.end(), port) - sum.ports.begin()); };
    const auto n = static_cast<unsigned int>(sum.ports.size());
    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    for (unsigned int i = 0; i < contact.ports.size(); ++i)
    {
      sum.values[place(contact.ports[i])] = contact.values[i];
      for (unsigned int j = 0; j < contact.ports.size(); ++j)
        sum.tangent(place(contact.ports[i]), place(contact.ports[j])) = contact.tangent(i, j);
    }

    const unsigned int hub = place(layout.rotation()), eta = place(layout.momentum_eta()), xi = place(layout.momentum_xi()),
                       u = place(layout.support());
    sum.values[eta] -= s * q.u_acceleration + c * q.theta_rate * q.u_rate;
    sum.values[xi] += c * q.u_acceleration - s * q.theta_rate * q.u_rate;
    sum.values[hub] += q.u_rate * across;
    sum.values[u] -= s * q.p_eta_acceleration - c * q.p_xi_acceleration + q.theta_rate * across;

    const double m = w.mass();
    const double r = w.damping();
    const double k = w.stiffness();
    sum.tangent(eta, u) -= s * m + c * q.theta_rate * r;
    sum.tangent(eta, hub) -= k * (c * q.u_acceleration - s * q.theta_rate * q.u_rate) + r * c * q.u_rate;
    sum.tangent(xi, u) += c * m - s * q.theta_rate * r;
    sum.tangent(xi, hub) += k * (-s * q.u_acceleration - c * q.theta_rate * q.u_rate) - r * s * q.u_rate;
    sum.tangent(hub, u) += r * across;
    sum.tangent(hub, eta) += r * q.u_rate * c;
    sum.tangent(hub, xi) += r * q.u_rate * s;
    sum.tangent(hub, hub) += k * q.u_rate * (-s * q.p_eta_rate + c * q.p_xi_rate);
    sum.tangent(u, eta) -= s * m + q.theta_rate * c * r;
    sum.tangent(u, xi) -= -c * m + q.theta_rate * s * r;
    sum.tangent(u, hub) -= k * (c * q.p_eta_acceleration + s * q.p_xi_acceleration) + r * across +
                           k * q.theta_rate * (-s * q.p_eta_rate + c * q.p_xi_rate);
    return sum;
  }

  std::vector<unsigned int> FrameCoupling::coupled_ports() const
  {
    if (!layout.sprung)
      return {};
    return { layout.rotation(), layout.momentum_eta(), layout.momentum_xi(), layout.support() };
  }

  void FrameCoupling::add_inertia(const std::vector<unsigned int> &ports, const double theta, FullMatrix<double> &inertia) const
  {
    if (!layout.sprung)
      return;
    const auto place = [&](const unsigned int port)
    { return static_cast<unsigned int>(std::lower_bound(ports.begin(), ports.end(), port) - ports.begin()); };
    const auto couple = [&](const unsigned int port, const double mass)
    {
      inertia(place(port), place(layout.support())) += mass;
      inertia(place(layout.support()), place(port)) += mass;
    };
    couple(layout.momentum_eta(), std::sin(theta));
    couple(layout.momentum_xi(), -std::cos(theta));
  }

  void FrameCoupling::add_work(const Kinematic &begin, const Vector<double> &end, const StepWeights &w, StepWork &work) const
  {
    if (!layout.sprung)
      return;
    const Kinematic after = at_end(begin, end, w);
    const double theta    = weighted(layout, rest, begin, after, w).theta;
    work.algorithmic +=
        inertial_dissipation(begin, after, mass_product(layout, theta, begin), mass_product(layout, theta, after), w);
  }

  double FrameCoupling::kinetic_energy(const Kinematic &ports) const
  {
    const double theta = rest + ports.position[layout.rotation()];
    return ports.velocity[layout.support()] *
           (std::sin(theta) * ports.velocity[layout.momentum_eta()] - std::cos(theta) * ports.velocity[layout.momentum_xi()]);
  }
} // namespace sprag
