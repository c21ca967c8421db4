#pragma once

#include "base/lanes.h"
#include "laws/contact.h"
#include "laws/friction.h"

#include <limits>

namespace sprag
{
  using TwoLanes = SomeLanes<2>;

  /// Friction of eight points at the end of a step, see EndFriction and FrictionTraction.
  struct FrictionInLanes
  {
    TwoLanes traction;
    Lanes mu;
    LaneMask slipping;
    TwoLanes slip_speed;
    SomeLanes<4> by_slip; ///< derivatives of the traction, row by row
    TwoLanes by_pressure;
    TwoLanes by_shift; ///< by that of the slip round the cylinder
    Lanes energy;
    Lanes dissipated;
    Lanes creep;
  };

  /// What returns to the cone, see friction_traction().
  struct TrialInLanes
  {
    TwoLanes traction; ///< where the step begins
    TwoLanes slip;     ///< of the step [mm]
    TwoLanes shift;    ///< [mm]
    Lanes duration;    ///< [s]
    Lanes pressure;
  };

  SPRAG_PART void find_coefficients(const std::vector<FrictionPiece> &law, const Lanes &speed, Lanes &mu, Lanes &derivative)
  {
    for (const auto &piece : law)
    {
      const LaneMask here = speed >= piece.from;
      mu                  = here ? (piece.quadratic * speed + piece.linear) * speed + piece.constant : mu;
      derivative          = here ? 2. * piece.quadratic * speed + piece.linear : derivative;
    }
  }

  /// Sets traction, mu, slipping and derivatives as friction_traction() does, for a law of rising pieces: the slip speed is its
  /// only root, and Newton's method finds it from that of a contact without elastic slip. Returns the lanes where it did not.
  SPRAG_PART LaneMask return_to_cone(const TrialInLanes &of, const std::vector<FrictionPiece> &law, const double stiffness,
                                     FrictionInLanes &result)
  {
    const double round_off  = 4. * std::numeric_limits<double>::epsilon();
    const Lanes trial_0     = of.traction[0] + stiffness * of.slip[0];
    const Lanes trial_1     = of.traction[1] + stiffness * of.slip[1];
    const Lanes trial       = square_root(trial_0 * trial_0 + trial_1 * trial_1);
    const LaneMask is_none  = trial == 0.;
    const Lanes one         = all_lanes(1.);
    const Lanes inverse     = 1. / (is_none ? one : trial);
    const Lanes d[2]        = { is_none ? one : trial_0 * inverse, trial_1 * inverse };
    const Lanes shift       = of.shift[0] * d[0] + of.shift[1] * d[1];
    const Lanes shifted     = trial + stiffness * shift;
    const Lanes &p          = of.pressure;
    const double mu_at_rest = law.front().constant;
    const LaneMask pressed  = p > 0.;
    const LaneMask sticks   = trial <= mu_at_rest * p;
    const LaneMask at_rest  = ~sticks & (shifted <= mu_at_rest * p);
    const LaneMask slips    = pressed & ~sticks & ~at_rest;

    Lanes mu = all_lanes(mu_at_rest), rate{}; // derivative of mu p by the speed over the resistance
    LaneMask unknown{};
    if (any(slips))
    {
      const Lanes resistance = stiffness * of.duration;
      const Lanes fastest    = slips ? shifted / resistance : Lanes{};
      Lanes speed            = smaller(larger(Lanes{}, (of.slip[0] * d[0] + of.slip[1] * d[1] + shift) / of.duration), fastest);
      Lanes of_speed{}, derivative{};
      unknown = slips;
      for (unsigned int i = 0; i < 6 && any(unknown); ++i)
      {
        find_coefficients(law, speed, of_speed, derivative);
        const Lanes excess = shifted - resistance * speed - of_speed * p;
        unknown            = slips & (absolute(excess) > round_off * shifted);
        speed += unknown ? excess / (resistance + derivative * p) : Lanes{};
        speed = smaller(larger(Lanes{}, speed), fastest);
      }
      mu   = slips ? of_speed : mu;
      rate = slips ? derivative * p / resistance : Lanes{};
    }
    const LaneMask slipping = pressed & ~sticks & (at_rest | (mu * p <= trial));
    const Lanes traction    = slipping ? mu * p : trial;
    result.mu               = pressed ? mu : Lanes{};
    result.slipping         = slipping;

    const Lanes by_size     = rate / (1. + rate);
    const Lanes by_pressure = slipping ? mu / (1. + rate) : Lanes{};
    const Lanes by_shift    = slipping ? stiffness * by_size : Lanes{};
    const Lanes across      = traction * inverse;
    const Lanes turned      = stiffness * by_size * inverse;
    for (unsigned int q = 0; q < 2; ++q)
    {
      result.traction[q]    = pressed ? traction * d[q] : Lanes{};
      result.by_pressure[q] = by_pressure * d[q];
      result.by_shift[q]    = by_shift * d[q] * d[0];
      for (unsigned int r = 0; r < 2; ++r)
      {
        const Lanes along         = d[q] * d[r];
        const Lanes same          = all_lanes(q == r ? 1. : 0.);
        const Lanes slip          = by_size * along + across * (same - along) + d[q] * turned * (of.shift[r] - shift * d[r]);
        result.by_slip[2 * q + r] = pressed ? stiffness * (slipping ? slip : same) : Lanes{};
      }
    }
    return unknown;
  }

  /// Sets the same of one lane by friction_traction().
  inline void return_to_cone(const TrialInLanes &of, const FrictionLaw &law, const double stiffness, const unsigned int lane,
                             FrictionInLanes &result)
  {
    const auto of_lane = [lane](const TwoLanes &lanes) { return dealii::Tensor<1, 2>({ lanes[0][lane], lanes[1][lane] }); };
    const auto found   = friction_traction(of_lane(of.traction) + stiffness * of_lane(of.slip), of.pressure[lane], law, stiffness,
                                           of.duration[lane], of_lane(of.shift));
    for (unsigned int q = 0; q < 2; ++q)
    {
      result.traction[q][lane]    = found.traction[q];
      result.by_pressure[q][lane] = found.d_pressure[q];
      result.by_shift[q][lane]    = found.d_shift[q][0];
      for (unsigned int r = 0; r < 2; ++r)
        result.by_slip[2 * q + r][lane] = stiffness * found.d_trial[q][r];
    }
    result.mu[lane]       = found.mu;
    result.slipping[lane] = found.slipping ? -1 : 0;
  }
} // namespace sprag
