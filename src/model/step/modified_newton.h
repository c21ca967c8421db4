// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_newton.h"
#include "model/step/stored_jacobian.h"

namespace sprag
{
  /// Solves z = z_free + G f(z) as an equation for forces, f(z_free + G phi) = phi, by Newton corrections with a stored Jacobian
  /// from a guess of phi. The Jacobian is renewed if the residual falls slowly. Converged if the remaining residual moves no
  /// point by more than `left_out` allows, see solve_by_newton(). `contact_at(z, request)` returns an InterfaceEvaluation. If the
  /// iteration does not converge, solve_interface() is to be tried.
  template <class Contact>
  class ModifiedNewton
  {
  public:
    ModifiedNewton(const InterfaceEquations &equations_, const Contact &contact_at_, const StepWeights &weights_,
                   JacobianFactors &factors_)
        : equations(equations_)
        , contact_at(contact_at_)
        , weights(weights_)
        , factors(factors_)
    {
    }

    InterfaceSolution solve(DofLoads phi, std::shared_ptr<const StoredJacobian> &jacobian, dealii::Vector<double> &z,
                            const double left_out) const
    {
      constexpr unsigned int most_corrections = 25;
      constexpr unsigned int most_renewals    = 8;
      constexpr double slow                   = 0.05; ///< ratio of successive residuals that admits the stored Jacobian
      constexpr double divergent              = 100.; ///< ratio of successive residuals from which no new Jacobian is tried

      NewtonResult result;
      if (jacobian != nullptr)
        add_dofs(jacobian->dofs, phi);
      move(phi, z);
      if (jacobian != nullptr && !factors.use(jacobian, equations.compliance, weights))
        jacobian.reset();
      auto found = evaluate(z, jacobian == nullptr ? Request::with_tangent : Request::forces, phi);
      if (jacobian == nullptr && !renew(*found.forces, jacobian))
        return { result, found.forces };
      double by_unit        = 0.; // largest movement by a unit residual
      unsigned int renewals = 0;
      const double least    = equations.smallest_movement();
      result.converged      = found.residual_norm == 0.; // nothing touches
      while (!result.converged && result.iterations < most_corrections)
      {
        ++result.iterations;
        const double before   = found.residual_norm;
        const double movement = correct(found, phi, z);
        found                 = evaluate(z, Request::forces, phi);
        const double share    = found.residual_norm / before;
        if (!(share < divergent))
          break;
        by_unit = std::max(by_unit, movement / before);
        result.converged =
            by_unit * found.residual_norm < left_out * (1. - share) * (relative_tolerance * found.penetration + least);
        if (!result.converged && share > slow &&
            (++renewals > most_renewals || !renew(*contact_at(z, Request::with_tangent).forces, jacobian)))
          break;
      }
      return { result, found.forces };
    }

  private:
    /// An evaluation with the residual f(z_free + G phi) - phi.
    struct ResidualEvaluation : InterfaceEvaluation
    {
      dealii::Vector<double> difference; ///< f - phi
      dealii::Vector<double> moved;      ///< by the difference, of all dofs
      double residual_norm;              ///< size of that, each dof over the root of its compliance
    };

    const InterfaceEquations &equations;
    const Contact &contact_at;
    const StepWeights &weights;
    JacobianFactors &factors;

    /// Sets z to z_free + G phi. Returns the largest movement.
    double move(const DofLoads &phi, dealii::Vector<double> &z) const
    {
      dealii::Vector<double> next = equations.free;
      add_response(equations.compliance, phi.dofs, phi.values, equations.selected, next);
      z -= next;
      const double largest = equations.movement(z);
      z                    = std::move(next);
      return largest;
    }

    ResidualEvaluation evaluate(const dealii::Vector<double> &z, const Request request, DofLoads &phi) const
    {
      ResidualEvaluation result{ contact_at(z, request), {}, dealii::Vector<double>(z.size()), 0. };
      const auto &[dofs, values] = static_cast<const DofLoads &>(*result.forces);
      add_dofs(dofs, phi);
      result.difference = phi.values;
      result.difference *= -1.;
      for (unsigned int i = 0, place = 0; i < dofs.size(); ++i)
      {
        while (phi.dofs[place] != dofs[i])
          ++place;
        result.difference[place] += values[i];
      }
      add_response(equations.compliance, phi.dofs, result.difference, phi.dofs, result.moved);
      for (const unsigned int dof : phi.dofs)
        if (const double own = equations.compliance(dof, dof); own > 0.)
          result.residual_norm += result.moved[dof] * result.moved[dof] / own;
      result.residual_norm = std::sqrt(result.residual_norm);
      return result;
    }

    bool renew(const InterfaceForces &forces, std::shared_ptr<const StoredJacobian> &jacobian) const
    {
      jacobian = std::make_shared<const StoredJacobian>(StoredJacobian{ forces.dofs, forces.tangent });
      return factors.use(jacobian, equations.compliance, weights);
    }

    /// Adds to phi what it differs by, and the forces by which the stored Jacobian answers to that. Returns the largest movement.
    double correct(const ResidualEvaluation &found, DofLoads &phi, dealii::Vector<double> &z) const
    {
      const auto &dofs = factors.jacobian().dofs;
      dealii::Vector<double> residual(static_cast<unsigned int>(dofs.size()));
      found.moved.extract_subvector_to(dofs.begin(), dofs.end(), residual.begin());
      residual = factors.reaction(residual);
      phi.values += found.difference;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        phi.values[find_index(dofs[i], phi.dofs)] += residual[i];
      return move(phi, z);
    }
  };

  /// Solves the equations of a step in time from a guess of its forces: where the contact keeps its Jacobian by that, else, and
  /// where that does not lead there, by solve_interface(), which leaves none.
  template <class Contact>
  InterfaceSolution solve_step(const bool keeps_tangent, const InterfaceEquations &equations, const Contact &contact_at,
                               const StepWeights &weights, const DofLoads &guess, JacobianFactors &factors,
                               std::shared_ptr<const StoredJacobian> &jacobian, dealii::Vector<double> &z)
  {
    unsigned int iterations = 0;
    z                       = equations.free;
    if (keeps_tangent)
    {
      const auto result = ModifiedNewton(equations, contact_at, weights, factors).solve(guess, jacobian, z, left_out_in_time);
      if (result.newton.converged)
        return result;
      iterations = result.newton.iterations;
      jacobian.reset();
      z = equations.free;
    }
    add_response(equations.compliance, guess.dofs, guess.values, equations.selected, z);
    auto result = solve_interface(equations, contact_at, z, left_out_in_time);
    result.newton.iterations += iterations;
    return result;
  }
} // namespace sprag
