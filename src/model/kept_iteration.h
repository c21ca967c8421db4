// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/kept_tangent.h"
#include "model/port_newton.h"

#include <numeric>

namespace sprag
{
  /// What the steps of an iteration tell of its equations beside an approximate tangent: Broyden's method by the steps alone
  /// (Kelley 1995, Iterative Methods for Linear and Nonlinear Equations, section 7.3). Steps are changes of forces, whose product
  /// with others is the work that these do on the displacements which follow.
  class ForceSteps
  {
  public:
    /// Improves the change that the approximate tangent gives.
    void improve(std::vector<double> &change) const
    {
      for (std::size_t j = 0; j + 1 < steps.size(); ++j)
      {
        const double factor = steps[j].share(change);
        for (std::size_t i = 0; i < change.size(); ++i)
          change[i] += factor * steps[j + 1].forces[i];
      }
      if (steps.empty())
        return;
      const double factor = 1. / (1. - steps.back().share(change));
      for (double &value : change)
        value *= factor;
    }

    /// Takes the change that was made, and the displacements that followed.
    void accept(std::vector<double> forces, std::vector<double> displacements)
    {
      const double work = std::inner_product(forces.begin(), forces.end(), displacements.begin(), 0.);
      steps.push_back({ std::move(forces), std::move(displacements), work });
    }

    void clear()
    {
      steps.clear();
    }

  private:
    struct Step
    {
      std::vector<double> forces;
      std::vector<double> displacements;
      double work;

      double share(const std::vector<double> &of) const
      {
        return std::inner_product(of.begin(), of.end(), displacements.begin(), 0.) / work;
      }
    };

    std::vector<Step> steps;
  };

  /// Solves z = z_free + G f(z) as an equation of forces, f(z_free + G phi) = phi, from a guess of phi, by corrections with a
  /// kept tangent; where these leave a large share of the unbalance, the tangent is renewed at the place that was reached.
  /// Converged where what is left would move no point by more than `left_out` says, see solve_by_newton(). `forces_at(z,
  /// wanted)` returns the forces, `overlap()` the size of the contact's deformation at the last evaluation [mm]. Not
  /// converged where the unbalance does not fall fast: solve_ports() is to be tried then.
  template <class Forces, class Overlap>
  class KeptIteration
  {
  public:
    KeptIteration(const PortEquations &equations_, const Forces &forces_at_, const Overlap &overlap_, const StepWeights &weights_,
                  KeptFactors &factors_)
        : equations(equations_)
        , forces_at(forces_at_)
        , overlap(overlap_)
        , weights(weights_)
        , factors(factors_)
        , moved(equations.free.size())
    {
    }

    PortSolution solve(const PortLoads &guess, std::shared_ptr<const KeptTangent> &kept, dealii::Vector<double> &z,
                       const double left_out)
    {
      constexpr unsigned int most_corrections = 25;
      constexpr unsigned int most_renewals    = 8;
      constexpr double slow                   = 0.05; ///< share of the unbalance that a correction may leave
      constexpr double hopeless               = 100.; ///< share that even a new tangent is not tried for

      NewtonResult result;
      phi = guess;
      if (kept != nullptr)
        include(kept->ports);
      move(z);
      if (kept != nullptr && !use(kept))
        kept.reset();
      evaluate(z, kept == nullptr ? Wanted::with_tangent : Wanted::forces);
      if (kept == nullptr && !renew(kept))
        return { result, forces };
      measure();
      double by_unit        = 0.; // of unbalance, the largest movement
      unsigned int renewals = 0;
      const double least    = equations.smallest_movement();
      result.converged      = unbalance == 0.; // nothing touches
      while (!result.converged && result.iterations < most_corrections)
      {
        ++result.iterations;
        const double before   = unbalance;
        const double movement = correct(z);
        evaluate(z, Wanted::forces);
        measure();
        const double share = unbalance / before;
        if (!(share < hopeless))
          break;
        by_unit          = std::max(by_unit, movement / before);
        result.converged = by_unit * unbalance < left_out * (1. - share) * (relative_tolerance * overlap() + least);
        if (!result.converged && share > slow)
        {
          if (++renewals > most_renewals)
            break;
          forces = &forces_at(z, Wanted::tangent_of_last);
          if (!renew(kept))
            break;
        }
      }
      return { result, forces };
    }

  private:
    const PortEquations &equations;
    const Forces &forces_at;
    const Overlap &overlap;
    const StepWeights &weights;
    KeptFactors &factors;

    PortLoads phi;
    const PortForces *forces = nullptr; ///< at the last evaluation
    dealii::Vector<double> difference;  ///< f - phi
    double unbalance = 0.;              ///< its size, by what it would move
    std::vector<unsigned int> places;   ///< of the kept tangent's ports in phi
    ForceSteps steps;
    dealii::Vector<double> moved; ///< room for displacements of all ports

    /// Makes phi have all of some ports.
    void include(const std::vector<unsigned int> &ports)
    {
      if (std::includes(phi.ports.begin(), phi.ports.end(), ports.begin(), ports.end()))
        return;
      PortLoads wider;
      std::set_union(phi.ports.begin(), phi.ports.end(), ports.begin(), ports.end(), std::back_inserter(wider.ports));
      wider.values.reinit(static_cast<unsigned int>(wider.ports.size()));
      for (unsigned int i = 0; i < phi.ports.size(); ++i)
        wider.values[place_of(phi.ports[i], wider.ports)] = phi.values[i];
      phi = std::move(wider);
      if (!places.empty())
        begin_steps();
    }

    void begin_steps()
    {
      places.clear();
      for (const unsigned int port : factors.ports())
        places.push_back(place_of(port, phi.ports));
      steps.clear();
    }

    /// z_free + G phi. Returns the largest movement.
    double move(dealii::Vector<double> &z)
    {
      for (const unsigned int i : equations.selected)
        moved[i] = equations.free[i];
      add_response(equations.compliance, phi.ports, phi.values, equations.selected, moved);
      double largest = 0.;
      for (const unsigned int i : equations.selected)
      {
        largest = std::max(largest, std::abs(equations.lengths[i] * (moved[i] - z[i])));
        z[i]    = moved[i];
      }
      return largest;
    }

    void evaluate(const dealii::Vector<double> &z, const Wanted wanted)
    {
      forces = &forces_at(z, wanted);
      include(forces->ports);
      difference = phi.values;
      difference *= -1.;
      for (unsigned int i = 0, place = 0; i < forces->ports.size(); ++i, ++place)
      {
        while (phi.ports[place] != forces->ports[i])
          ++place;
        difference[place] += forces->values[i];
      }
    }

    /// As KeptFactors::movement_by(), also where there are other ports than theirs.
    void measure()
    {
      if (places.size() == phi.ports.size())
      {
        unbalance = factors.movement_by(difference);
        return;
      }
      for (const unsigned int port : phi.ports)
        moved[port] = 0.;
      add_response(equations.compliance, phi.ports, difference, phi.ports, moved);
      double squares = 0.;
      for (const unsigned int port : phi.ports)
        if (const double own = equations.compliance(port, port); own > 0.)
          squares += moved[port] * moved[port] / own;
      unbalance = std::sqrt(squares);
    }

    bool renew(std::shared_ptr<const KeptTangent> &kept)
    {
      kept = std::make_shared<const KeptTangent>(KeptTangent{ forces->ports, forces->tangent });
      return use(kept);
    }

    bool use(const std::shared_ptr<const KeptTangent> &kept)
    {
      if (!factors.use(kept, equations.compliance, weights))
        return false;
      begin_steps();
      return true;
    }

    /// Returns the largest movement.
    double correct(dealii::Vector<double> &z)
    {
      dealii::Vector<double> of_kept(static_cast<unsigned int>(places.size()));
      difference.extract_subvector_to(places.begin(), places.end(), of_kept.begin());
      of_kept = factors.solve(of_kept);
      std::vector<double> change(difference.begin(), difference.end());
      for (unsigned int i = 0; i < places.size(); ++i)
        change[places[i]] = of_kept[i];
      steps.improve(change);
      std::vector<double> displacements;
      for (unsigned int i = 0; i < change.size(); ++i)
      {
        phi.values[i] += change[i];
        displacements.push_back(-z[phi.ports[i]]);
      }
      const double movement = move(z);
      for (unsigned int i = 0; i < change.size(); ++i)
        displacements[i] += z[phi.ports[i]];
      steps.accept(std::move(change), std::move(displacements));
      return movement;
    }
  };

  /// Solves the equations of a step in time from a guess of its forces: where the contact keeps its tangent by that, else, and
  /// where that does not lead there, by solve_ports(), which leaves none.
  template <bool keeps_tangent, class Forces, class Overlap>
  PortSolution solve_step(const PortEquations &equations, const Forces &forces_at, const Overlap &overlap,
                          const StepWeights &weights, const PortLoads &guess, KeptFactors &factors,
                          std::shared_ptr<const KeptTangent> &kept, dealii::Vector<double> &z)
  {
    unsigned int iterations = 0;
    z                       = equations.free;
    if constexpr (keeps_tangent)
    {
      const auto result = KeptIteration(equations, forces_at, overlap, weights, factors).solve(guess, kept, z, left_out_in_time);
      if (result.newton.converged)
        return result;
      iterations = result.newton.iterations;
      kept.reset();
      z = equations.free;
    }
    add_response(equations.compliance, guess.ports, guess.values, equations.selected, z);
    auto result = solve_ports(equations, forces_at, overlap, z, left_out_in_time);
    result.newton.iterations += iterations;
    return result;
  }
} // namespace sprag
