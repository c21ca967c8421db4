// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_structure.h"
#include "fe/dynamics/sparse_vibration.h"

namespace sprag
{
  using namespace dealii;

  void SparseStructure::mass_product(const Vector<double> &q, Vector<double> &result) const
  {
    mass.multiply<1>({ { &q } }, { { &result } });
    if (constants.sprung)
      result[n_lever] = constants.support_mass * q[n_lever];
  }

  /// In extended precision: what round-off of the metal's stiffness makes of a vibration is as soft as the whole lever, 1e-9 of
  /// it.
  void SparseStructure::stiffness_product(const Vector<double> &q, Vector<double> &result) const
  {
    std::vector<long double> elastic(n_lever);
    const long double rotation = q[n_lever - 1];
    for (unsigned int i = 0; i < n_lever; ++i)
      elastic[i] = q[i] - rotation * rigid_rotation[i];
    stiffness.multiply(elastic, result);
    result[n_lever - 1] += constants.spring_stiffness * q[n_lever - 1];
    if (constants.sprung)
      result[n_lever] = constants.support_stiffness * q[n_lever];
  }

  void SparseStructure::damping_product(const Vector<double> &q, Vector<double> &result) const
  {
    result = 0.;
    Vector<double> part(q.size());
    const auto add = [&](const CompressedRows &matrix, const double factor)
    {
      if (factor == 0.)
        return;
      matrix.multiply<1>({ { &q } }, { { &part } });
      result.add(factor, part);
    };
    add(mass, constants.mass_damping);
    add(stiffness, constants.stiffness_damping);
    add(layer, constants.relaxation);
    for (unsigned int i = 0; i < damping.directions.size(); ++i)
    {
      const auto &direction = damping.directions[i];
      double amount         = 0.;
      for (unsigned int j = 0; j < n_lever; ++j)
        amount += direction[j] * q[j];
      for (unsigned int j = 0; j < n_lever; ++j)
        result[j] += damping.factors[i] * amount * direction[j];
    }
    if (constants.sprung)
      result[n_lever] = constants.support_damping * q[n_lever];
  }

  double SparseStructure::damping_form(const Motion &velocities) const
  {
    const auto &v = velocities.coordinates.position;
    Vector<double> product(v.size());
    damping_product(v, product);
    return product * v;
  }

  std::vector<StructureMode> SparseStructure::vibrations(const PortPerturbation &forces, const unsigned int number)
  {
    use_statics();
    const auto solve = [this](const Vector<double> &load, Vector<double> &q)
    {
      const auto of_lever = statics->system->solve(Vector<double>(load.begin(), load.begin() + n_lever));
      std::copy(of_lever.begin(), of_lever.end(), q.begin());
      if (constants.sprung)
        q[n_lever] = load[n_lever] / constants.support_stiffness;
    };
    const SparseOperator structure{ lever_ports.n_coordinates(),
                                    [this](const auto &q, auto &result) { mass_product(q, result); },
                                    [this](const auto &q, auto &result) { damping_product(q, result); },
                                    [this](const auto &q, auto &result) { stiffness_product(q, result); },
                                    solve,
                                    lever_ports };
    return sparse_vibrations(structure, forces, number);
  }
} // namespace sprag
