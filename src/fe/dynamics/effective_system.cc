// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/effective_system.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  EffectiveSystem::EffectiveSystem(const InertialMatrices &matrices_, const LeverInterface &interface_,
                                   const ModalDamping &damping_, const InertialMatrices::Weights &weights_,
                                   const double damping_weight)
      : matrices(matrices_)
      , interface(interface_)
      , damping(damping_)
      , weights(weights_)
      // A lever at rest is as soft as its spring, which multiplies round-off; vibrations rest on that, and LU leaves less of it.
      , factors(weights.mass > 0. ? MatrixKind::positive_definite : MatrixKind::general)
  {
    PETScWrappers::SparseMatrix matrix;
    matrices.sum(weights, matrix);
    factors.factorise(matrix);
    if (!(damping_weight > 0.) || damping.directions.empty())
      return;
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
    low_rank = inverse(low_rank, true);
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

  Vector<double> EffectiveSystem::response(const DofLoads &forces) const
  {
    Vector<double> load(interface.n_coordinates());
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      interface.add_force(forces.dofs[a], forces.values[a], load);
    return solve(Vector<double>(load.begin(), load.begin() + matrices.coordinates.size()));
  }

  FullMatrix<double> EffectiveSystem::interface_compliance() const
  {
    const auto &layout = interface.layout();
    Mumps condensing;
    PETScWrappers::SparseMatrix matrix;
    matrices.sum(weights, matrix);
    auto face_compliance = inverse(condensing.factorise_with_schur_complement(matrix, interface.face_coordinates()), true);
    interface.transform(face_compliance);
    FullMatrix<double> result(layout.dofs_per_lever(), layout.dofs_per_lever());
    for (unsigned int i = 0; i < face_compliance.m(); ++i)
      for (unsigned int j = 0; j < face_compliance.m(); ++j)
        result(interface.face_dof(i), interface.face_dof(j)) = 0.5 * (face_compliance(i, j) + face_compliance(j, i));
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
    const auto n                   = static_cast<unsigned int>(damped.size());
    const unsigned int n_interface = interface.layout().rotation() + 1;
    if (n == 0)
      return;
    FullMatrix<double> at_interface(n_interface, n), half(n_interface, n), product(n_interface, n_interface);
    for (unsigned int k = 0; k < n; ++k)
    {
      Vector<double> with_support(interface.n_coordinates());
      std::copy(damped[k].begin(), damped[k].end(), with_support.begin());
      const auto displacements = interface.displacements(with_support);
      for (unsigned int i = 0; i < n_interface; ++i)
        at_interface(i, k) = displacements[i];
    }
    at_interface.mmult(half, low_rank);
    half.mTmult(product, at_interface);
    for (unsigned int i = 0; i < n_interface; ++i)
      for (unsigned int j = 0; j < n_interface; ++j)
        compliance(i, j) -= product(i, j);
  }

  void EffectiveSystem::append(const unsigned int dof, FullMatrix<double> &compliance) const
  {
    const auto &layout = interface.layout();
    Vector<double> with_support(interface.n_coordinates());
    DofLoads unit{ { dof }, Vector<double>(1) };
    unit.values[0]            = 1.;
    const auto lever_response = response(unit);
    std::copy(lever_response.begin(), lever_response.end(), with_support.begin());
    const auto displacements = interface.displacements(with_support);
    for (unsigned int i = 0; i < layout.support(); ++i)
      compliance(i, dof) = compliance(dof, i) = displacements[i];
  }
} // namespace sprag
