// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/dual.h"
#include "laws/friction_law.h"

#include <cmath>
#include <limits>

/// The laws of a contact point, for any kind of number: double, SimdBatch, or dual numbers of these, which carry the derivatives.
/// Where a step begins all is known: values there are plain.
namespace sprag
{
  /// Some numbers. std::array would not let them be added as batches.
  template <class N, int n>
  struct Several
  {
    N values[n]{};

    SPRAG_PART N &operator[](const unsigned int i)
    {
      return values[i];
    }
    SPRAG_PART const N &operator[](const unsigned int i) const
    {
      return values[i];
    }
  };

  /// Unilateral spring p = stiffness delta^exponent of the penetration delta = max(0, -gap).
  struct NormalLaw
  {
    double stiffness = 0.; ///< > 0
    double exponent  = 1.; ///< >= 1
  };

  /// Traction over pressure where a contact slides, and its derivative by the slip speed.
  struct SlidingFriction
  {
    double coefficient = 0.; ///< signed as the speed
    double derivative  = 0.; ///< [s/mm]
    double mu          = 0.; ///< of the law at that speed
    double by_mu       = 0.; ///< the part of the derivative that mu has, which follows the speed where it falls [s/mm]
  };

  /// mu(|w|) sgn(w), or mu(|w|) w / sqrt(w^2 + v_r^2) with a regularisation speed v_r; w != 0 [mm/s].
  SlidingFriction sliding_friction(const FrictionLaw &law, double speed);

  /// Lag of friction in a slide.
  struct FrictionLag
  {
    double time;     ///< [s]; 0: it does not; below 0: slip runs away
    double pressure; ///< share of the pressure behind which it lags; 0: it lags behind the speed alone
  };

  /// Friction as a step applies it.
  struct SlipLaw
  {
    FrictionLaw friction;
    double stiffness                  = 0.;    ///< in stick, > 0
    std::vector<FrictionPiece> pieces = {};    ///< see rising_pieces(); none: evaluates the law
    bool follows_speed                = false; ///< over the memory length, see falls_with_speed()
    bool is_layer                     = false; ///< the spring of stick is a layer's shear, else a penalty
  };

  SlipLaw slip_law(const FrictionLaw &friction, double stiffness, bool is_layer = false);

  /// A mu that falls with speed follows the speed w of a slide over the memory length L, in the time L / |w|. The spring of stick
  /// in series delays all friction by mu' p / stiffness, a penalty only while mu rises; `slope` = mu' p [N s/mm]. Both together,
  ///   t (1 + (L / |w| + slope / stiffness) s) = mu (1 + L / |w| s) p + slope v   with the Laplace variable s,
  /// leave a time below 0 where mu falls faster than it can follow: there slip runs away. `is_layer`: see SlipLaw.
  FrictionLag friction_lag(const FrictionLaw &law, double stiffness, bool is_layer, double slope, double speed);

  /// Friction of a point at the end of a step, see end_friction().
  template <class N, int slips>
  struct PointFriction
  {
    Several<N, slips> traction;
    Plain<N> mu{};
    Mask<N> slipping{};
    Several<Plain<N>, slips> slip_speed; ///< mean of the step, of plastic slip or of the faces; 0 in stick [mm/s]
    Plain<N> energy{};                   ///< of the tangential spring at the end
    Plain<N> dissipated{};               ///< in the step
    Plain<N> creep{};                    ///< slip below the regularisation speed [mm]
  };

  /// State of friction at the end of the last step.
  template <class V, int slips>
  struct SlipHistory
  {
    Several<V, slips> traction;
    Several<V, slips> slip_speed; ///< mean of the last step; 0 after stick [mm/s]
    V mu{};                       ///< where the point slid, else 0
    V step{};                     ///< duration of the last step [s]
  };

  /// Returns mu and its derivative at the slip speed w >= 0 [mm/s] where a load above mu(0) p is resistance w + mu(w) p. The law
  /// falls nowhere, so there is one.
  FrictionValue slip_friction(const FrictionLaw &law, double load, double resistance, double pressure);

  /// Sets mu and dmu/dw at the slip speed w of a load above the cone: load = resistance w + mu(w) p. Newton's
  /// method finds it in all lanes from a guess if the law consists of pieces; else see slip_friction().
  template <class V, class M>
  SPRAG_PART void find_slip(const SlipLaw &law, const M &slips, const V &load, const V &resistance, const V &p, const V &guess,
                            V &mu, V &slope)
  {
    M unknown = slips;
    if constexpr (std::is_same_v<V, Batch>)
      if (!law.pieces.empty())
      {
        const double round_off  = 4. * std::numeric_limits<double>::epsilon();
        const SimdBatch fastest = slips ? load / resistance : SimdBatch{};
        SimdBatch w             = smaller(larger(SimdBatch{}, guess), fastest);
        for (unsigned int i = 0; i < 6 && any(unknown); ++i)
        {
          for (const auto &piece : law.pieces)
          {
            const BatchMask here = w >= piece.from;
            mu                   = here ? (piece.quadratic * w + piece.linear) * w + piece.constant : mu;
            slope                = here ? 2. * piece.quadratic * w + piece.linear : slope;
          }
          const SimdBatch excess = load - resistance * w - mu * p;
          unknown                = slips & (absolute(excess) > round_off * load);
          w = smaller(larger(SimdBatch{}, w + (unknown ? excess / (resistance + slope * p) : SimdBatch{})), fastest);
        }
      }
    for_each_lane(unknown,
                  [&](const unsigned int i)
                  {
                    const auto found = slip_friction(law.friction, at_lane(load, i), at_lane(resistance, i), at_lane(p, i));
                    set_lane(mu, i, found.coefficient);
                    set_lane(slope, i, found.derivative);
                  });
  }

  template <class A, class B, int n>
  SPRAG_PART auto dot(const Several<A, n> &a, const Several<B, n> &b)
  {
    auto sum = a[0] * b[0];
    for (int i = 1; i < n; ++i)
      sum = sum + a[i] * b[i];
    return sum;
  }

  /// A vector's size and direction. That of nothing is along the first axis.
  template <class N, int n>
  struct SizeAndDirection
  {
    Mask<N> is_nothing;
    N size;
    Several<N, n> direction;

    SPRAG_PART explicit SizeAndDirection(const Several<N, n> &vector)
    {
      const N square = dot(vector, vector);
      is_nothing     = value(square) == 0.;
      const N root   = square_root(select(is_nothing, N{} + 1., square));
      size           = select(is_nothing, N{}, root);
      for (int i = 0; i < n; ++i)
        direction[i] = select(is_nothing, N{} + (i == 0 ? 1. : 0.), vector[i] / root);
    }
  };

  /// Returns mu at speeds w >= 0 [mm/s] where `here` holds, else 0.
  template <class N, class M>
  SPRAG_PART N friction_at(const FrictionLaw &law, const M &here, const N &w)
  {
    Plain<N> mu{}, slope{};
    for_each_lane(here,
                  [&](const unsigned int i)
                  {
                    const auto found = friction_coefficient(law, at_lane(value(w), i));
                    set_lane(mu, i, found.coefficient);
                    set_lane(slope, i, found.derivative);
                  });
    return chained(mu, slope, w);
  }

  /// Returns a trial traction to the cone of the pressure p at the end of a step of a duration [s]. In stick |t| <= mu(0) p and
  /// t is the trial. In slip t keeps its direction, and its size and the slip speed w are solved together,
  ///   t = mu(w) p,   w = max(0, (t_trial - t) / stiffness + shift) / duration,
  /// `shift` [mm] being by how much the slip of a step at the speed of its end is longer than the step's own; its part along the
  /// trial counts. t stays below the trial. Newton's method begins with the step's `slip`.
  template <class N, class S, int slips>
  SPRAG_PART PointFriction<N, slips> return_to_cone(const SlipLaw &law, const Several<N, slips> &trial, const N &p,
                                                    const Plain<N> &duration, const Several<S, slips> &shift,
                                                    const Several<N, slips> &slip)
  {
    using V        = Plain<N>;
    const double k = law.stiffness;
    const SizeAndDirection<N, slips> split(trial);
    const N along      = dot(split.direction, shift);
    const N load       = split.size + k * along;
    const double mu_0  = friction_coefficient(law.friction, 0.).coefficient;
    const auto pressed = value(p) > 0.;
    const auto beyond  = pressed & (value(split.size) > mu_0 * value(p));
    const auto at_rest = value(load) <= mu_0 * value(p);
    const auto slides  = beyond & negated(at_rest);
    N mu               = N{} + mu_0;
    if (any(slides))
    {
      V guess = value(along);
      for (int i = 0; i < slips; ++i)
        guess = guess + value(slip[i]) * value(split.direction[i]);
      V found{}, slope{};
      const V resistance = k * duration;
      find_slip(law, slides, value(load), resistance, value(p), V(guess / duration), found, slope);
      const V share = select(slides, V(slope / (resistance + slope * value(p))), V{});
      mu            = select(slides, chained(found, share, N(load - found * p)), mu);
    }
    PointFriction<N, slips> result;
    result.mu       = select(pressed, value(mu), V{});
    result.slipping = beyond & (at_rest | (value(mu) * value(p) <= value(split.size)));
    for (int i = 0; i < slips; ++i)
      result.traction[i] = select(pressed, select(result.slipping, mu * p * split.direction[i], trial[i]), N{});
    return result;
  }

  /// The traction of a spring that keeps the slip of a step.
  template <class N, int slips>
  SPRAG_PART Several<N, slips> stick_traction(const SlipLaw &law, const Several<Plain<N>, slips> &before,
                                              const Several<N, slips> &slip)
  {
    Several<N, slips> result;
    for (int i = 0; i < slips; ++i)
      result[i] = law.stiffness * slip[i] + before[i];
    return result;
  }

  /// Returns the share c = dt/(dt + dt_last) of the linear extrapolation to the slip speed at the end of a step from the means of
  /// this step and the last, w_end = (1 + c) w - c w_last.
  template <class V, int slips>
  SPRAG_PART V extrapolated_share(const SlipHistory<V, slips> &history, const V &along_last, const double dt)
  {
    return select((history.step > 0.) & (along_last >= 0.), V(dt / (dt + history.step)), V{});
  }

  /// Returns true if the point stuck where the step begins.
  template <class V, int slips>
  SPRAG_PART auto stuck_before(const SlipHistory<V, slips> &history)
  {
    return (history.step > 0.) & (history.mu == 0.) & (dot(history.traction, history.traction) > 0.);
  }

  /// Returns mu at the end of a step where it falls with speed: over the memory length L it comes to that of the speed v of the
  /// faces,
  ///   dmu/ds = (mu(v) - mu) / L   along the path s on which they slide,
  /// from mu(0) after stick, and at once where the point was open. Ruina's slip law does so near a slide; here mu stays within
  /// its law however fast slip is. mu(v) is linear over the path, with the speeds that the means of this step and the last give
  /// at its ends: with e = exp(-q), q = s/L,
  ///   mu_end = e mu_begin + ((1 - e)/q - e) mu(v_begin) + (1 - (1 - e)/q) mu(v_end).
  /// `mean`: of the step, `last`: that of the last one along this one [mm/s]. Only points that are `pressed` count.
  template <class N, int slips>
  SPRAG_PART N remembered_friction(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history, const Mask<N> &pressed,
                                   const N &path, const N &mean, const N &last, const double dt)
  {
    using V                            = Plain<N>;
    constexpr double most_extrapolated = 0.2; ///< of the mean: what jumps from step to step would go on to
    const double length                = law.friction.memory_length;
    const auto slid                    = history.mu > 0.;
    V at_begin                         = history.mu, e{}, d_e{}, g{}, d_g{}; // g = (1 - e)/q
    for_each_lane(slid | stuck_before(history),
                  [&](const unsigned int i)
                  {
                    const double q    = at_lane(value(path), i) / length;
                    const double left = std::exp(-q), share = q > 0. ? -std::expm1(-q) / q : 1.;
                    if (at_lane(history.mu, i) == 0.) // it stuck
                      set_lane(at_begin, i, friction_coefficient(law.friction, 0.).coefficient);
                    set_lane(e, i, left);
                    set_lane(d_e, i, -left / length);
                    set_lane(g, i, share);
                    set_lane(d_g, i, (q > 1e-6 ? (left - share) / q : -0.5) / length);
                  });
    const N extrapolated = select(slid, extrapolated_share(history, value(last), dt), V{}) * (mean - last);
    const N most         = most_extrapolated * mean;
    const N at_least     = select(value(extrapolated) > -value(most), extrapolated, N(-most));
    const N half_change  = select(value(at_least) < value(most), at_least, most);
    const N mu_begin     = friction_at(law.friction, pressed, N(mean - half_change));
    const N mu_end       = friction_at(law.friction, pressed, N(mean + half_change));
    const N kept = chained(e, d_e, path), mixed = chained(g, d_g, path);
    return kept * (at_begin - mu_begin) + mixed * (mu_begin - mu_end) + mu_end;
  }

  /// Friction t = mu p w / sqrt(w^2 + v_r^2) along the mean slip of a step, w at its end. mu is mu(|w|), or comes to that over
  /// the memory length where it falls with speed.
  template <class N, int slips>
  SPRAG_PART PointFriction<N, slips> regularised(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history,
                                                 const Several<N, slips> &slip, const N &p, const double dt)
  {
    using V          = Plain<N>;
    const double v_r = law.friction.regularisation_speed;
    PointFriction<N, slips> result;
    const SizeAndDirection<N, slips> path(slip);
    const N last       = dot(history.slip_speed, path.direction);
    const V share      = extrapolated_share(history, value(last), dt);
    const N w          = (1. + share) * (1. / dt * path.size) - share * last;
    const N speed      = select(value(w) < 0., N(-w), w);
    const auto pressed = value(p) > 0.;
    const N mu    = law.follows_speed ? remembered_friction(law, history, pressed, path.size, N(1. / dt * path.size), last, dt)
                                      : friction_at(law.friction, pressed, speed);
    const N root  = square_root(w * w + v_r * v_r);
    const N along = mu * w / root;
    const V rest_tangent = (1. + share) / dt * value(mu) * v_r * v_r / (value(root) * value(root) * value(root));
    result.mu            = value(mu);
    result.slipping      = pressed;
    for (int i = 0; i < slips; ++i)
    {
      const N at_rest      = rest_tangent * slip[i] + (i == 0 ? value(along) : V{});
      result.traction[i]   = select(pressed, p * select(path.is_nothing, at_rest, along * path.direction[i]), N{});
      result.slip_speed[i] = select(pressed, V(1. / dt * value(slip[i])), V{});
      result.dissipated    = result.dissipated + 0.5 * (history.traction[i] + value(result.traction[i])) * value(slip[i]);
    }
    const auto creeps = pressed & (value(path.size) < dt * v_r);
    result.creep      = select(creeps, value(path.size), V{});
    return result;
  }

  /// Returns true if the faces slide by what a layer's shear leaves. In a step in which the point touches the shear counts as
  /// slip.
  template <class V, int slips>
  SPRAG_PART bool slides_behind_layer(const SlipLaw &law, const SlipHistory<V, slips> &history)
  {
    if constexpr (std::is_same_v<V, Batch>)
      return false;
    else
      return law.follows_speed && law.is_layer && (history.mu > 0. || stuck_before(history));
  }

  /// Traction that falls with speed behind a layer whose shear takes a part of the slip:
  ///   t = mu p,   mu that of remembered_friction() after the path (t_trial - t) / stiffness.
  /// Newton's method is kept inside 0 <= t <= t_trial. Several t may do: it begins at the speed of the last step, and from stick
  /// at none, from where it finds the shortest path.
  template <class N, int slips>
  PointFriction<N, slips> following_behind_layer(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history,
                                                 const Several<N, slips> &trial, const N &p, const double dt)
  {
    using Varied = Dual<double, 1>;
    const SizeAndDirection<N, slips> split(trial);
    const double size = value(split.size), last = value(dot(history.slip_speed, split.direction));
    const double round_off = 4. * std::numeric_limits<double>::epsilon() * size;
    const auto mu_behind   = [&](const auto &taken) // by the layer
    {
      using X      = std::decay_t<decltype(taken)>;
      const X path = 1. / law.stiffness * taken;
      return remembered_friction<X, slips>(law, history, true, path, 1. / dt * path, X{} + last, dt);
    };
    PointFriction<N, slips> result;
    double t = size, lower = 0., upper = size, slope = 1.;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const auto varied = variable<Varied>(t, 0);
      const auto mu     = mu_behind(Varied(size - varied));
      const auto excess = varied - value(p) * mu;
      result.mu         = mu.v;
      result.slipping   = t < size || excess.v > 0.;
      if (!result.slipping)
        break;
      (excess.v > 0. ? upper : lower) = t;
      slope                           = excess.d[0];
      if (std::abs(excess.v) <= round_off)
        break;
      if (i == 0 && last > 0.)
        t = std::max(0., size - law.stiffness * last * dt);
      else
        t -= excess.v / slope;
      if (!(t >= lower && t <= upper))
        t = 0.5 * (lower + upper);
    }
    const N at_t     = N{} + t; // by the implicit function theorem
    const N traction = result.slipping ? at_t - 1. / slope * (at_t - mu_behind(N(split.size - at_t)) * p) : split.size;
    for (int i = 0; i < slips; ++i)
      result.traction[i] = traction * split.direction[i];
    return result;
  }

  /// Traction that falls with speed, see remembered_friction(). In stick |t| <= mu(0) p. Slip of a penalty's spring counts as
  /// that of the faces: a mesh has the layer's shear.
  template <class N, int slips>
  SPRAG_PART PointFriction<N, slips> following_faces(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history,
                                                     const Several<N, slips> &slip, const N &p, const double dt)
  {
    using V          = Plain<N>;
    const auto trial = stick_traction(law, history.traction, slip);
    if constexpr (!std::is_same_v<V, Batch>)
      if (slides_behind_layer(law, history) && value(p) > 0.)
        return following_behind_layer(law, history, trial, p, dt);
    const auto pressed = value(p) > 0.;
    const SizeAndDirection<N, slips> path(slip);
    const N last = dot(history.slip_speed, path.direction);
    const SizeAndDirection<N, slips> split(trial);
    const N beyond = 1. / law.stiffness * (split.size - friction_coefficient(law.friction, 0.).coefficient * p);
    const N slid   = select(stuck_before(history), select(value(beyond) > 0., beyond, N{}), path.size);
    const N mu     = remembered_friction(law, history, pressed, slid, N(1. / dt * path.size), last, dt);
    const N cone   = mu * p;
    PointFriction<N, slips> result;
    result.mu       = value(mu);
    result.slipping = pressed & (value(split.size) > value(cone));
    for (int i = 0; i < slips; ++i)
      result.traction[i] = select(pressed, select(result.slipping, cone * split.direction[i], trial[i]), N{});
    return result;
  }

  /// Traction that does not. The slip speed at the end is extrapolated along t from this step and the last (second order).
  template <class N, int slips>
  SPRAG_PART PointFriction<N, slips> following_slip(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history,
                                                    const Several<N, slips> &slip, const N &p, const double dt)
  {
    using V = Plain<N>;
    V last{};
    for (int i = 0; i < slips; ++i)
      last = last + history.slip_speed[i] * (law.stiffness * value(slip[i]) + history.traction[i]);
    const V share    = extrapolated_share(history, last, dt);
    const V duration = dt / (1. + share);
    Several<V, slips> shift;
    for (int i = 0; i < slips; ++i)
      shift[i] = -duration * share * history.slip_speed[i];
    return return_to_cone(law, stick_traction(law, history.traction, slip), p, duration, shift, slip);
  }

  /// Friction at the end of a step of duration dt > 0 [s] in which the contact slips by `slip`: stick with a spring, or slip on
  /// the cone. With a regularisation speed there is no stick.
  template <class N, int slips>
  SPRAG_PART PointFriction<N, slips> end_friction(const SlipLaw &law, const SlipHistory<Plain<N>, slips> &history,
                                                  const Several<N, slips> &slip, const N &p, const double dt)
  {
    using V = Plain<N>;
    if (law.friction.regularisation_speed > 0.)
      return regularised(law, history, slip, p, dt);
    const double k            = law.stiffness;
    const bool counts_elastic = law.follows_speed && !slides_behind_layer(law, history);
    auto result = law.follows_speed ? following_faces(law, history, slip, p, dt) : following_slip(law, history, slip, p, dt);
    for (int i = 0; i < slips; ++i)
    {
      const V t = value(result.traction[i]), before = history.traction[i];
      const V slipped      = value(slip[i]) - (t - before) / k;
      result.slip_speed[i] = select(result.slipping, V((counts_elastic ? value(slip[i]) : slipped) / dt), V{});
      result.energy        = result.energy + 0.5 / k * t * t;
      result.dissipated    = result.dissipated + 0.5 * (before + t) * slipped;
    }
    return result;
  }

  /// Returns k delta^n of a unilateral spring, delta = max(0, -gap); in batches for n = 1.
  template <class N>
  SPRAG_PART N spring_force(const NormalLaw &law, const N &gap)
  {
    N force = -law.stiffness * gap;
    if constexpr (!std::is_same_v<Plain<N>, Batch>)
      if (law.exponent != 1.)
        force = law.stiffness * power(N(-gap), law.exponent);
    return select(value(gap) < 0., force, N{});
  }

  /// Returns k delta^(n + 1)/(n + 1).
  template <class N>
  SPRAG_PART N spring_energy(const NormalLaw &law, const N &gap)
  {
    return -1. / (law.exponent + 1.) * gap * spring_force(law, gap);
  }

  /// Returns the mean force over a change of the gap, -(W_end - W_begin)/(gap_end - gap_begin) (discrete gradient).
  template <class N>
  SPRAG_PART N mean_spring_force(const NormalLaw &law, const Plain<N> &begin, const N &end)
  {
    using V        = Plain<N>;
    const N change = end - begin;
    // If the gap hardly changes, Simpson's rule is exact to round-off and the quotient is not.
    const V size     = select(value(change) < 0., V(-value(change)), value(change));
    const auto small = (size < -1e-3 * begin) | (size < -1e-3 * value(end)) | (size == 0.);
    const N simpson =
        1. / 6. * (spring_force(law, begin) + 4. * spring_force(law, N(0.5 * (begin + end))) + spring_force(law, end));
    const N by_energy = (spring_energy(law, begin) - spring_energy(law, end)) / select(small, N{} + 1., change);
    return select(small, simpson, by_energy);
  }

  /// Force of a dashpot beside a spring of force `normal`, -damping * gap_rate while closed; it cannot pull the surfaces
  /// together.
  template <class N>
  SPRAG_PART N dashpot_force(const double damping, const N &normal, const N &gap, const N &gap_rate)
  {
    const N dashpot = -damping * gap_rate;
    return select(value(gap) < 0., select(value(dashpot) < -value(normal), N(-normal), dashpot), N{});
  }
} // namespace sprag
