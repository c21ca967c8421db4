// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/apparatus.h"
#include "scene/scene.h"

#include <array>
#include <cmath>
#include <functional>

namespace sprag
{
  // Beam theory of a leaf spring, for comparison with its mesh.

  inline double second_moment(const LeafSpring &leaf)
  {
    return leaf.width * std::pow(leaf.thickness, 3) / 12.;
  }

  inline double bending_stiffness(const LeafSpring &leaf)
  {
    return leaf.young_modulus * second_moment(leaf);
  }

  /// 12 EI/(kappa G A L^2) of a rectangular section.
  inline double shear_number(const LeafSpring &leaf)
  {
    const double shear_modulus = leaf.young_modulus / (2. * (1. + leaf.poisson_ratio));
    return 12. * bending_stiffness(leaf) / (5. / 6. * shear_modulus * leaf.width * leaf.thickness * leaf.length * leaf.length);
  }

  /// Moment about the pivot for a unit turn of a straight leaf, Timoshenko.
  inline double beam_stiffness(const LeafSpring &leaf)
  {
    const double L   = leaf.length;
    const double c   = leaf.clamp_distance;
    const double phi = shear_number(leaf);
    const double EI  = bending_stiffness(leaf);
    switch (leaf.end)
    {
    case LeafEnd::clamped:
      return EI / (L * (1. + phi)) * (12. * c * c / (L * L) + 12. * c / L + 4. + phi);
    case LeafEnd::pinned:
      return 3. * EI / (L * (1. + 0.25 * phi)) * (1. + c / L) * (1. + c / L);
    case LeafEnd::loose:
      return 0.;
    case LeafEnd::guided:
      break;
    }
    return EI / L;
  }

  /// Deflection of a straight Euler-Bernoulli leaf at a distance x from its clamp for a unit turn of the hub, downwards.
  inline double static_shape(const LeafSpring &leaf, const double x)
  {
    const double L = leaf.length;
    const double c = leaf.clamp_distance;
    const double s = x / L;
    switch (leaf.end)
    {
    case LeafEnd::clamped:
      return c * (1. - s) * (1. - s) * (1. + 2. * s) + x * (1. - s) * (1. - s);
    case LeafEnd::pinned: // no curvature at the end
      return c + x - 1.5 * (c + L) * s * s + 0.5 * (c + L) * s * s * s;
    case LeafEnd::loose: // straight
      return c + x;
    case LeafEnd::guided: // no shear
      break;
    }
    return c + x - 0.5 * L * s * s;
  }

  /// The extensible elastica (no shear) of a leaf, straight or bent, at a turn of the hub: shooting with Runge-Kutta's method. In
  /// axes turned by pi, so that the leaf runs along +X.
  class ExtensibleElastica
  {
  public:
    explicit ExtensibleElastica(const LeafSpring &spring)
        : leaf(spring)
        , half_angle(2. * std::atan(2. * spring.sagitta / spring.length))
        , arc_length(half_angle == 0. ? spring.length : spring.length * half_angle / std::sin(half_angle))
    {
    }

    /// About the pivot, that turns the hub [N mm]. In steps of the turn, so that Newton's method follows.
    double moment(const double turn)
    {
      std::array<double, 3> unknowns{}; // H, V, moment at the clamp
      const unsigned int steps = 20;
      for (unsigned int i = 1; i <= steps; ++i)
        solve(turn * i / steps, unknowns);
      const auto [H, V, M] = unknowns;
      const double c       = leaf.clamp_distance;
      return -(M + c * std::cos(turn) * V - c * std::sin(turn) * H);
    }

  private:
    using State = std::array<double, 4>; // X, Y, angle, moment

    State rate(const State &state, const double H, const double V) const
    {
      const double cosine  = std::cos(state[2]);
      const double sine    = std::sin(state[2]);
      const double stretch = 1. + (H * cosine + V * sine) / (leaf.young_modulus * leaf.width * leaf.thickness);
      const double x       = stretch * cosine;
      const double y       = stretch * sine;
      return { { x, y, state[3] / bending_stiffness(leaf) + 2. * half_angle / arc_length, y * H - x * V } };
    }

    State end_state(const double turn, const std::array<double, 3> &unknowns) const
    {
      const auto [H, V, M] = unknowns;
      const double c       = leaf.clamp_distance;
      State at{ { c * std::cos(turn), c * std::sin(turn), turn - half_angle, M } };
      const unsigned int n = 100;
      const double h       = arc_length / n;
      const auto moved     = [](State state, const double by, const State &along)
      {
        for (unsigned int i = 0; i < 4; ++i)
          state[i] += by * along[i];
        return state;
      };
      for (unsigned int i = 0; i < n; ++i)
      {
        const State a = rate(at, H, V);
        const State b = rate(moved(at, 0.5 * h, a), H, V);
        const State d = rate(moved(at, 0.5 * h, b), H, V);
        const State e = rate(moved(at, h, d), H, V);
        for (unsigned int j = 0; j < 4; ++j)
          at[j] += h / 6. * (a[j] + 2. * b[j] + 2. * d[j] + e[j]);
      }
      return at;
    }

    /// Returns the residual at the joint along, across and in turning, by lengths of the leaf and radians.
    std::array<double, 3> misfit(const double turn, const std::array<double, 3> &unknowns) const
    {
      const State end     = end_state(turn, unknowns);
      const double L      = leaf.length;
      const double forces = L * L / bending_stiffness(leaf);
      return { { leaf.axial == LeafAxial::held ? (end[0] - leaf.clamp_distance - L) / L : unknowns[0] * forces,
                 leaf.end == LeafEnd::guided ? unknowns[1] * forces : end[1] / L,
                 leaf.end == LeafEnd::pinned ? end[3] * forces / L : end[2] - half_angle } };
    }

    /// Newton's method with differences.
    void solve(const double turn, std::array<double, 3> &unknowns) const
    {
      const double EI = bending_stiffness(leaf);
      const double L  = leaf.length;
      const std::array<double, 3> sizes{ { EI / (L * L), EI / (L * L), EI / L } };
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
      {
        const auto r = misfit(turn, unknowns);
        if (std::hypot(r[0], r[1], r[2]) < 1e-12)
          return;
        std::array<std::array<double, 3>, 3> columns{};
        for (unsigned int j = 0; j < 3; ++j)
        {
          auto right = unknowns, left = unknowns;
          right[j] += 1e-4 * sizes[j];
          left[j] -= 1e-4 * sizes[j];
          const auto a = misfit(turn, right), b = misfit(turn, left);
          for (unsigned int i = 0; i < 3; ++i)
            columns[j][i] = (a[i] - b[i]) / 2e-4;
        }
        const auto determinant = [](const auto &a, const auto &b, const auto &c)
        { return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]); };
        const double all = determinant(columns[0], columns[1], columns[2]);
        unknowns[0] -= sizes[0] * determinant(r, columns[1], columns[2]) / all;
        unknowns[1] -= sizes[1] * determinant(columns[0], r, columns[2]) / all;
        unknowns[2] -= sizes[2] * determinant(columns[0], columns[1], r) / all;
      }
    }

    const LeafSpring leaf;
    const double half_angle;
    const double arc_length;
  };
} // namespace sprag
