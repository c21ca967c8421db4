// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_structure.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    double product(const Vector<double> &a, const Vector<double> &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }
  } // namespace

  SparseStructure::Products SparseStructure::make_products(const Motion &motion) const
  {
    const auto &q = motion.coordinates;
    Products of;
    of.position = q.position;
    of.velocity = q.velocity;
    for (unsigned int k = 0; k < 3; ++k)
    {
      of.mass[k].reinit(n_lever, true);
      of.modal[k].reinit(static_cast<unsigned int>(mode_momenta.size()));
    }
    // A rigid rotation meets no stiffness, but round-off as large as its displacements.
    of.elastic = Vector<double>(q.position.begin(), q.position.begin() + n_lever);
    of.elastic.add(-q.position[n_lever - 1], rigid_rotation);
    const std::array<const Vector<double> *, 3> motions = { { &q.position, &q.velocity, &q.acceleration } };
    mass.multiply<3>(motions, { { &of.mass[0], &of.mass[1], &of.mass[2] } });
    const std::array<const Vector<double> *, 3> strains = { { &of.elastic, &q.velocity, &q.acceleration } };
    const auto multiply = [&](const CompressedRows &matrix, const bool rates, std::array<Vector<double>, 3> &results)
    {
      for (unsigned int k = 0; k < (rates ? 3u : 1u); ++k)
        results[k].reinit(n_lever, true);
      if (rates)
        matrix.multiply<3>(strains, { { &results[0], &results[1], &results[2] } });
      else
        matrix.multiply<1>({ { strains[0] } }, { { &results[0] } });
    };
    multiply(stiffness, constants.stiffness_damping > 0., of.stiffness);
    multiply(layer, constants.relaxation > 0., of.layer);
    for (unsigned int i = 0; i < mode_momenta.size(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        of.modal[k][i] = product(mode_momenta[i], *motions[k]);
    return of;
  }

  const SparseStructure::Products &SparseStructure::products(const Motion &motion) const
  {
    const auto &q       = motion.coordinates;
    const auto is_equal = [](const Vector<double> &a, const Vector<double> &b)
    { return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin()); };
    for (const unsigned int slot : { latest, 1 - latest })
      if (is_equal(q.position, known[slot].position) && is_equal(q.velocity, known[slot].velocity))
      {
        latest = slot;
        return known[slot];
      }
    latest        = 1 - latest;
    known[latest] = make_products(motion);
    return known[latest];
  }

  void SparseStructure::add_work(const Motion &begin, const Motion &end, StepWork &work) const
  {
    const auto &w        = current->weights;
    const auto &q_0      = begin.coordinates;
    const auto &q_1      = end.coordinates;
    const Products &of_0 = products(begin);
    const Products &of_1 = products(end);

    Vector<double> change = q_1.position;
    change -= q_0.position;
    // Damping acts on (1 - alpha_f) v_1 + alpha_f v_0.
    const auto power = [&](const Vector<double> &at_end, const Vector<double> &at_begin)
    { return w.stiffness() * product(at_end, change) + w.alpha_f * product(at_begin, change); };
    if (constants.mass_damping > 0.)
      work.damping += constants.mass_damping * power(of_1.mass[1], of_0.mass[1]);
    if (constants.stiffness_damping > 0.)
      work.damping += constants.stiffness_damping * power(of_1.stiffness[1], of_0.stiffness[1]);
    if (constants.relaxation > 0.)
      work.damping += constants.relaxation * power(of_1.layer[1], of_0.layer[1]);
    for (unsigned int i = 0; i < damping.factors.size(); ++i)
    {
      const double mean_rate = w.stiffness() * of_1.modal[1][i + 1] + w.alpha_f * of_0.modal[1][i + 1];
      work.damping += damping.factors[i] * mean_rate * (of_1.modal[0][i + 1] - of_0.modal[0][i + 1]);
    }
    const double turn     = change[n_lever - 1];
    Vector<double> strain = of_1.elastic;
    strain -= of_0.elastic;
    work.algorithmic += inertial_dissipation(q_0, q_1, of_0.mass[2], of_1.mass[2], w) +
                        w.delay() * (product(of_1.stiffness[0], strain) - product(of_0.stiffness[0], strain) +
                                     constants.spring_stiffness * turn * turn);
    if (constants.sprung)
      add_support_work(q_0, q_1, w, work);
  }

  void SparseStructure::add_support_work(const Kinematic &q_0, const Kinematic &q_1, const StepWeights &w, StepWork &work) const
  {
    const auto of_support = [this](const Kinematic &q)
    {
      const auto entry = [&](const Vector<double> &values) { return Vector<double>(values.begin() + n_lever, values.end()); };
      return Kinematic{ entry(q.position), entry(q.velocity), entry(q.acceleration) };
    };
    const auto u_0      = of_support(q_0);
    const auto u_1      = of_support(q_1);
    const double change = u_1.position[0] - u_0.position[0];
    work.damping += constants.support_damping * change * (w.stiffness() * u_1.velocity[0] + w.alpha_f * u_0.velocity[0]);
    work.algorithmic += constants.support_mass * inertial_dissipation(u_0, u_1, u_0.acceleration, u_1.acceleration, w) +
                        w.delay() * constants.support_stiffness * change * change;
  }

  StoredEnergy SparseStructure::stored_energy(const Motion &motion) const
  {
    const auto &q  = motion.coordinates;
    const auto &of = products(motion);
    StoredEnergy energy;
    energy.kinetic = 0.5 * product(of.mass[1], q.velocity);
    energy.spring  = 0.5 * constants.spring_stiffness * q.position[n_lever - 1] * q.position[n_lever - 1];
    energy.elastic = 0.5 * product(of.stiffness[0], of.elastic);
    energy.layer   = 0.5 * product(of.layer[0], of.elastic);
    if (constants.sprung)
    {
      energy.kinetic += 0.5 * constants.support_mass * q.velocity[n_lever] * q.velocity[n_lever];
      energy.support = 0.5 * constants.support_stiffness * q.position[n_lever] * q.position[n_lever];
    }
    return energy;
  }

  Vector<double> SparseStructure::port_error(const Motion &begin, const Motion &end) const
  {
    const auto &w        = current->weights;
    const double factor  = w.dt * w.dt * (w.beta - 1. / 6.);
    const Products &of_0 = products(begin);
    const Products &of_1 = products(end);
    Vector<double> result(ports().size());
    for (unsigned int i = 0; i < mode_ports.size(); ++i)
      result.add(factor * (of_1.modal[2][i] - of_0.modal[2][i]), mode_ports[i]);
    if (constants.sprung)
      result[ports().support()] = factor * (end.coordinates.acceleration[n_lever] - begin.coordinates.acceleration[n_lever]);
    return result;
  }
} // namespace sprag
