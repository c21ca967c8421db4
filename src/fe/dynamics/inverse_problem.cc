// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/inverse_problem.h"

#include "base/errors.h"

#include <limits>

namespace sprag
{
  using namespace dealii;

  void SparseState::add(const double factor, const SparseState &other)
  {
    q.add(factor, other.q);
    rate.add(factor, other.rate);
    if (traction.size() > 0)
      traction.add(factor, other.traction);
  }

  void SparseState::scale(const double factor)
  {
    q *= factor;
    rate *= factor;
    if (traction.size() > 0)
      traction *= factor;
  }

  double SparseState::operator*(const SparseState &other) const
  {
    return q * other.q + rate * other.rate + (traction.size() > 0 ? traction * other.traction : 0.);
  }

  InverseProblem::InverseProblem(const SparseOperator &sparse_structure, const PortPerturbation &port_forces)
      : structure(sparse_structure)
      , forces(port_forces)
      , stiffness(forces.stiffness())
      , damping(forces.damping())
      , n_forces(static_cast<unsigned int>(forces.ports.size()))
      , springs(n_forces, n_forces)
      , portable(n_forces)
  {
    if (n_forces > 0)
    {
      find_springs();
      find_responses();
    }
    for (const auto &delay : forces.delays)
      tractions.push_back(delay.time * delay.force.l2_norm() / delay.rate_row.l2_norm());
  }

  unsigned int InverseProblem::size() const
  {
    return 2 * structure.size + n_delays();
  }

  SparseState InverseProblem::zero() const
  {
    return { Vector<double>(structure.size), Vector<double>(structure.size), Vector<double>(n_delays()) };
  }

  unsigned int InverseProblem::n_delays() const
  {
    return static_cast<unsigned int>(forces.delays.size());
  }

  void InverseProblem::find_springs()
  {
    LAPACKFullMatrix<double> symmetric(n_forces);
    for (unsigned int a = 0; a < n_forces; ++a)
      for (unsigned int b = 0; b < n_forces; ++b)
        symmetric(a, b) = -0.5 * (forces.pressure(a, b) + forces.pressure(b, a));
    Vector<double> values;
    FullMatrix<double> vectors;
    symmetric.compute_eigenvalues_symmetric(0., std::numeric_limits<double>::max(), 0., values, vectors);
    for (unsigned int i = 0; i < values.size(); ++i)
      for (unsigned int a = 0; a < n_forces; ++a)
        for (unsigned int b = 0; b < n_forces; ++b)
          springs(a, b) += values[i] * vectors(a, i) * vectors(b, i);
  }

  void InverseProblem::find_responses()
  {
    FullMatrix<double> compliance(n_forces, n_forces);
    Vector<double> load(structure.size);
    for (unsigned int b = 0; b < n_forces; ++b)
    {
      load = 0.;
      structure.ports.add_force(forces.ports[b], 1., load);
      responses.emplace_back(structure.size);
      structure.solve(load, responses.back());
      const auto z = loaded_ports(responses.back());
      for (unsigned int a = 0; a < n_forces; ++a)
        compliance(a, b) = z[a];
    }
    FullMatrix<double> matrix(n_forces, n_forces);
    compliance.mmult(matrix, stiffness);
    matrix *= -1.;
    for (unsigned int a = 0; a < n_forces; ++a)
      matrix(a, a) += 1.;
    portable = matrix;
    try
    {
      portable.compute_lu_factorization();
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the slide is at the limit of its stability: it has a mode without stiffness");
    }
  }

  SparseState InverseProblem::apply(const SparseState &state) const
  {
    SparseState result{ displacements(state), state.q, Vector<double>(n_delays()) };
    if (n_delays() == 0)
      return result;
    const auto before = loaded_ports(state.q);
    const auto after  = loaded_ports(result.q);
    for (unsigned int k = 0; k < n_delays(); ++k)
    {
      const auto &delay  = forces.delays[k];
      result.traction[k] = delay.stiffness_row * after + delay.rate_row * before - delay.time * state.traction[k];
    }
    return result;
  }

  SparseState InverseProblem::momenta(const SparseState &state) const
  {
    SparseState result = zero();
    structure.stiffness(state.q, result.q);
    add_port_forces(springs, 1., state.q, result.q);
    mass_product(state.rate, result.rate);
    for (unsigned int k = 0; k < n_delays(); ++k)
      result.traction[k] = tractions[k] * state.traction[k];
    return result;
  }

  double InverseProblem::mass_form(const SparseState &state, const double square) const
  {
    Vector<double> momentum(structure.size);
    mass_product(state.q, momentum);
    const double of_displacements = momentum * state.q;
    mass_product(state.rate, momentum);
    return square * of_displacements + momentum * state.rate;
  }

  void InverseProblem::mass_product(const Vector<double> &rate, Vector<double> &momentum) const
  {
    structure.mass(rate, momentum);
    add_port_forces(forces.inertia, 1., rate, momentum);
  }

  /// The rotational spring is so soft beside the contact that solutions without the contact have lost half their digits: what
  /// they leave out of balance is solved for once more.
  Vector<double> InverseProblem::displacements(const SparseState &state) const
  {
    Vector<double> load(structure.size), left(structure.size), correction(structure.size), result(structure.size);
    structure.damping(state.q, load);
    mass_product(state.rate, left);
    load += left;
    load *= -1.;
    add_port_forces(damping, 1., state.q, load);
    add_delayed(state.traction, load);
    solve(load, result);

    constexpr unsigned int corrections = 2;
    for (unsigned int i = 0; i < corrections; ++i)
    {
      structure.stiffness(result, left);
      left.sadd(-1., 1., load);
      add_port_forces(stiffness, 1., result, left);
      solve(left, correction);
      result += correction;
    }
    return result;
  }

  /// What tractions' rates take off the forces that follow displacements and velocities at once.
  void InverseProblem::add_delayed(const Vector<double> &rates, Vector<double> &sum) const
  {
    if (n_delays() == 0)
      return;
    Vector<double> values(n_forces);
    for (unsigned int k = 0; k < n_delays(); ++k)
      values.add(-forces.delays[k].time * rates[k], forces.delays[k].force);
    for (unsigned int a = 0; a < n_forces; ++a)
      structure.ports.add_force(forces.ports[a], values[a], sum);
  }

  Vector<double> InverseProblem::loaded_ports(const Vector<double> &q) const
  {
    const auto all = structure.ports.displacements(q);
    Vector<double> z(n_forces);
    for (unsigned int a = 0; a < z.size(); ++a)
      z[a] = all[forces.ports[a]];
    return z;
  }

  void InverseProblem::add_port_forces(const FullMatrix<double> &matrix, const double factor, const Vector<double> &q,
                                       Vector<double> &sum) const
  {
    if (n_forces == 0)
      return;
    const auto z = loaded_ports(q);
    Vector<double> values(z.size());
    matrix.vmult(values, z);
    for (unsigned int a = 0; a < n_forces; ++a)
      structure.ports.add_force(forces.ports[a], factor * values[a], sum);
  }

  /// With the stiffness of structure and forces: f = A (1 - G A)^-1 z where the structure alone went to z.
  void InverseProblem::solve(const Vector<double> &right_hand_side, Vector<double> &q) const
  {
    structure.solve(right_hand_side, q);
    if (n_forces == 0)
      return;
    auto z = loaded_ports(q);
    portable.solve(z);
    Vector<double> values(n_forces);
    stiffness.vmult(values, z);
    for (unsigned int a = 0; a < n_forces; ++a)
      q.add(values[a], responses[a]);
  }
} // namespace sprag
