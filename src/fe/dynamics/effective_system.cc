// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/effective_system.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    void invert(FullMatrix<double> &matrix)
    {
      LAPACKFullMatrix<double> lapack(static_cast<unsigned int>(matrix.m()));
      lapack = matrix;
      lapack.set_property(LAPACKSupport::symmetric);
      lapack.invert();
      matrix = lapack;
    }
  } // namespace

  EffectiveSystem::EffectiveSystem(const InertialMatrices &matrices_, const LeverPorts &ports_, const ModalDamping &damping_,
                                   const InertialMatrices::Weights &weights_, const double damping_weight)
      : matrices(matrices_)
      , ports(ports_)
      , damping(damping_)
      , weights(weights_)
      // A lever at rest is as soft as its spring, which multiplies round-off; vibrations rest on that, and LU leaves less of it.
      , factors(weights.mass > 0. ? MatrixKind::positive_definite : MatrixKind::general)
  {
    PETScWrappers::SparseMatrix matrix;
    matrices.sum(weights, matrix);
    factors.factorise(matrix);
    if (damping_weight > 0. && !damping.directions.empty())
      find_low_rank(damping_weight);
  }

  void EffectiveSystem::find_low_rank(const double damping_weight)
  {
    const auto n = static_cast<unsigned int>(damping.directions.size());
    low_rank.reinit(n, n);
    for (unsigned int j = 0; j < n; ++j)
    {
      damped.emplace_back();
      factors.solve(damping.directions[j], damped.back());
      for (unsigned int i = 0; i < n; ++i)
        low_rank(i, j) = damping.directions[i] * damped[j];
      low_rank(j, j) += 1. / (damping_weight * damping.factors[j]);
    }
    invert(low_rank);
  }

  Vector<double> EffectiveSystem::solve(const Vector<double> &right_hand_side) const
  {
    Vector<double> result;
    factors.solve(right_hand_side, result);
    const auto n = static_cast<unsigned int>(damped.size());
    Vector<double> onto(n), amounts(n);
    for (unsigned int i = 0; i < n; ++i)
      onto[i] = damped[i] * right_hand_side;
    if (n > 0)
      low_rank.vmult(amounts, onto);
    for (unsigned int i = 0; i < n; ++i)
      result.add(-amounts[i], damped[i]);
    return result;
  }

  namespace
  {
    // Forces on the same ports step after step are answered fastest by responses to single forces; so many that they are not
    // worth their memory, or ever new ones as a contact moves over a fine face, by one solution for all. Each step earns the
    // right to one solution for a single force, so that both together cost at most twice the better of them.
    constexpr unsigned int most_responses = 128;
  } // namespace

  Vector<double> EffectiveSystem::response(const PortLoads &forces) const
  {
    Vector<double> load(ports.n_coordinates());
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      ports.add_force(forces.ports[a], forces.values[a], load);
    return solve(Vector<double>(load.begin(), load.begin() + matrices.coordinates.size()));
  }

  const Vector<double> &EffectiveSystem::response(const unsigned int port) const
  {
    const auto [found, is_new] = responses.try_emplace(port);
    if (is_new)
    {
      PortLoads unit{ { port }, Vector<double>(1) };
      unit.values[0] = 1.;
      found->second  = response(unit);
    }
    return found->second;
  }

  void EffectiveSystem::add_response(const PortLoads &forces, Vector<double> &position) const
  {
    const auto add = [&](const double factor, const Vector<double> &part)
    {
      for (unsigned int i = 0; i < part.size(); ++i)
        position[i] += part[i] * factor;
    };
    const auto unknown = static_cast<unsigned int>(std::count_if(
        forces.ports.begin(), forces.ports.end(), [&](const unsigned int port) { return responses.count(port) == 0; }));
    credit             = std::min(credit + 1, most_responses);
    if (unknown > credit)
      return add(1., response(forces));
    credit -= unknown;
    if (responses.size() + unknown > most_responses)
      for (auto known = responses.begin(); known != responses.end();)
        known = std::binary_search(forces.ports.begin(), forces.ports.end(), known->first) ? std::next(known)
                                                                                           : responses.erase(known);
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
      add(forces.values[a], response(forces.ports[a]));
  }

  void EffectiveSystem::visit_history(Archive &archive)
  {
    PortSelection known;
    for (const auto &known_response : responses)
      known.push_back(known_response.first);
    archive(credit, known);
    if (!archive.reads())
      return;
    responses.clear();
    for (const unsigned int port : known)
      response(port);
  }

  FullMatrix<double> EffectiveSystem::port_compliance() const
  {
    const auto &layout = ports.layout();
    Mumps condensing;
    PETScWrappers::SparseMatrix matrix;
    matrices.sum(weights, matrix);
    FullMatrix<double> face_compliance = condensing.factorise_with_schur_complement(matrix, ports.face_coordinates());
    invert(face_compliance);
    ports.transform(face_compliance);
    FullMatrix<double> result(layout.ports_per_lever(), layout.ports_per_lever());
    for (unsigned int i = 0; i < face_compliance.m(); ++i)
      for (unsigned int j = 0; j < face_compliance.m(); ++j)
        result(ports.face_port(i), ports.face_port(j)) = 0.5 * (face_compliance(i, j) + face_compliance(j, i));
    subtract_low_rank(result);
    for (unsigned int sensor = 0; sensor < layout.sensors; ++sensor)
      append(layout.sensor(sensor), result);
    if (layout.sprung)
    {
      append(layout.momentum_eta(), result);
      append(layout.momentum_xi(), result);
    }
    return result;
  }

  void EffectiveSystem::subtract_low_rank(FullMatrix<double> &compliance) const
  {
    const auto n               = static_cast<unsigned int>(damped.size());
    const unsigned int n_ports = ports.layout().rotation() + 1;
    if (n == 0)
      return;
    FullMatrix<double> at_ports(n_ports, n), half(n_ports, n), product(n_ports, n_ports);
    for (unsigned int k = 0; k < n; ++k)
    {
      Vector<double> with_support(ports.n_coordinates());
      std::copy(damped[k].begin(), damped[k].end(), with_support.begin());
      const auto displacements = ports.displacements(with_support);
      for (unsigned int i = 0; i < n_ports; ++i)
        at_ports(i, k) = displacements[i];
    }
    at_ports.mmult(half, low_rank);
    half.mTmult(product, at_ports);
    for (unsigned int i = 0; i < n_ports; ++i)
      for (unsigned int j = 0; j < n_ports; ++j)
        compliance(i, j) -= product(i, j);
  }

  void EffectiveSystem::append(const unsigned int port, FullMatrix<double> &compliance) const
  {
    const auto &layout = ports.layout();
    Vector<double> with_support(ports.n_coordinates());
    const auto &lever_response = response(port);
    std::copy(lever_response.begin(), lever_response.end(), with_support.begin());
    const auto displacements = ports.displacements(with_support);
    for (unsigned int i = 0; i < layout.support(); ++i)
      compliance(i, port) = compliance(port, i) = displacements[i];
  }
} // namespace sprag
