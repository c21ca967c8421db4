// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/sparse_vibration.h"

#include <deal.II/lac/lapack_full_matrix.h>

namespace sprag
{
  /// State of the first-order problem: displacements, velocities and the tractions of friction's delays.
  struct SparseState
  {
    dealii::Vector<double> q, rate, traction;

    void add(double factor, const SparseState &other);
    void scale(double factor);
    double operator*(const SparseState &other) const;
  };

  /// The linearised problem E s' = A s of a sparse structure under forces on its ports, s = (q, q', tau): products with A^-1 E,
  /// whose eigenvalues are 1 / lambda.
  ///
  /// States are measured by their energy, q^T K q + q'^T M q' + tau^2 over the stiffness of stick, K with the contact's springs.
  /// Without friction and damping the products are skew in it: their eigenvectors are orthogonal, and what is stiff is small.
  class InverseProblem
  {
  public:
    /// Arguments must outlive the problem. Throws AnalysisError if there is a mode without stiffness.
    InverseProblem(const SparseOperator &structure, const PortPerturbation &forces);

    unsigned int size() const; ///< of the state
    SparseState zero() const;

    /// The state that leads to the given one: displacements -K^-1 (C q + M q' + delayed tractions).
    SparseState apply(const SparseState &state) const;

    /// Energy's derivative: its product with a state is twice their mutual energy.
    SparseState momenta(const SparseState &state) const;

    /// square q^T M q + q'^T M q'. Unlike energy it does not see round-off of displacements, of which stiffness makes 1e-9 of it.
    double mass_form(const SparseState &state, double square) const;

  private:
    const SparseOperator &structure;
    const PortPerturbation &forces;
    const dealii::FullMatrix<double> stiffness;
    const dealii::FullMatrix<double> damping;
    const unsigned int n_forces;
    dealii::FullMatrix<double> springs;            ///< of the contact, those that are not negative
    std::vector<double> tractions;                 ///< energy of the delays' tractions by their square
    std::vector<dealii::Vector<double>> responses; ///< of the structure to unit forces on the ports
    dealii::LAPACKFullMatrix<double> portable;     ///< factors of 1 - G df/dz

    void find_springs();
    void find_responses();
    unsigned int n_delays() const;
    dealii::Vector<double> displacements(const SparseState &state) const;
    void mass_product(const dealii::Vector<double> &rate, dealii::Vector<double> &momentum) const;
    void add_delayed(const dealii::Vector<double> &rates, dealii::Vector<double> &sum) const;
    dealii::Vector<double> loaded_ports(const dealii::Vector<double> &q) const;
    void add_port_forces(const dealii::FullMatrix<double> &matrix, double factor, const dealii::Vector<double> &q,
                         dealii::Vector<double> &sum) const;
    void solve(const dealii::Vector<double> &right_hand_side, dealii::Vector<double> &q) const;
  };
} // namespace sprag
