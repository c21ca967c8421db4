// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace sprag
{
  /// Constants of one step of the generalised-alpha method (Chung and Hulbert 1993). With state 0 before and 1 after the step,
  ///   M a_m + C v_f + K q_f = f,   y_m = (1 - alpha_m) y_1 + alpha_m y_0,   y_f = (1 - alpha_f) y_1 + alpha_f y_0,
  ///   q_1 = q_0 + dt v_0 + dt^2 ((1/2 - beta) a_0 + beta a_1),   v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1).
  struct StepWeights
  {
    double dt; ///< [s], > 0
    double alpha_m;
    double alpha_f;
    double beta;
    double gamma;
    bool wants_error = true; ///< whether the local error of the step is of interest

    /// Weights of q_1 in a_m, v_f and q_f: the effective matrix is mass() M + damping() C + stiffness() K.
    double mass() const
    {
      return (1. - alpha_m) / (beta * dt * dt);
    }
    double damping() const
    {
      return (1. - alpha_f) * rate();
    }
    double stiffness() const
    {
      return 1. - alpha_f;
    }
    /// dv_1/dq_1 [1/s].
    double rate() const
    {
      return gamma / (beta * dt);
    }
    /// Forces count by this share of dt later than the middle of the step; 0 for a spectral radius of 1.
    double delay() const
    {
      return 0.5 - alpha_f;
    }
  };

  /// For a spectral radius of 0 ... 1 at infinite frequency; 1 dissipates nothing.
  inline StepWeights generalised_alpha(const double spectral_radius, const double dt)
  {
    StepWeights w{};
    w.dt      = dt;
    w.alpha_m = (2. * spectral_radius - 1.) / (spectral_radius + 1.);
    w.alpha_f = spectral_radius / (spectral_radius + 1.);
    w.gamma   = 0.5 - w.alpha_m + w.alpha_f;
    w.beta    = 0.25 * (1. - w.alpha_m + w.alpha_f) * (1. - w.alpha_m + w.alpha_f);
    return w;
  }

  /// Finds among some steps, the latest last, the one with these weights; makes it where there is none, and forgets the earliest
  /// one where there are `most` already.
  template <class Step, class Make>
  const Step *step_among(std::vector<std::unique_ptr<Step>> &steps, const StepWeights &w, const std::size_t most,
                         const Make &make)
  {
    const auto is_equal = [&](const auto &step) { return step->weights.dt == w.dt && step->weights.alpha_f == w.alpha_f; };
    const auto found    = std::find_if(steps.begin(), steps.end(), is_equal);
    if (found != steps.end())
      std::rotate(found, found + 1, steps.end());
    else
    {
      if (steps.size() >= most)
        steps.erase(steps.begin());
      steps.push_back(make());
    }
    return steps.back().get();
  }

  /// Coordinates with their rates.
  struct Kinematic
  {
    dealii::Vector<double> position;
    dealii::Vector<double> velocity;
    dealii::Vector<double> acceleration;
  };

  /// Position and velocity at the end of a step whose acceleration there is 0; the acceleration is empty.
  inline Kinematic unaccelerated(const Kinematic &begin, const StepWeights &w)
  {
    Kinematic end{ begin.position, begin.velocity, {} };
    end.position.add(w.dt, begin.velocity, w.dt * w.dt * (0.5 - w.beta), begin.acceleration);
    end.velocity.add(w.dt * (1. - w.gamma), begin.acceleration);
    return end;
  }

  /// Completes `end`, which unaccelerated() made, for the position that the step has led to.
  inline void set_position(Kinematic &end, const dealii::Vector<double> &position, const StepWeights &w)
  {
    end.acceleration = position;
    end.acceleration -= end.position;
    end.acceleration *= 1. / (w.beta * w.dt * w.dt);
    end.velocity.add(w.dt * w.gamma, end.acceleration);
    end.position = position;
  }

  /// Work that the scheme dissipates in a step for one coordinate of mass m and stiffness k: what balances the change of kinetic
  /// and elastic energy against the work of the forces, from the formulas of the step. With < > the mean of both ends and [ ] the
  /// change, for symmetric M and K:
  ///   -dt (gamma - 1/2) <v> M [a] + dt^2 (beta - gamma/2) [a] M <a> + (1/2 - alpha_m) [q] M [a] + (1/2 - alpha_f) [q] K [q].
  /// Here the part of M, as a bilinear form with M x handed in for both accelerations.
  inline double inertial_dissipation(const Kinematic &begin, const Kinematic &end, const dealii::Vector<double> &mass_begin,
                                     const dealii::Vector<double> &mass_end, const StepWeights &w)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < mass_begin.size(); ++i)
    {
      const double change = mass_end[i] - mass_begin[i];
      sum += -w.dt * (w.gamma - 0.5) * 0.5 * (begin.velocity[i] + end.velocity[i]) * change +
             w.dt * w.dt * (w.beta - 0.5 * w.gamma) * 0.5 * (begin.acceleration[i] + end.acceleration[i]) * change +
             (0.5 - w.alpha_m) * (end.position[i] - begin.position[i]) * change;
    }
    return sum;
  }
} // namespace sprag
