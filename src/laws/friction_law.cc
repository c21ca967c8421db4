// SPDX-License-Identifier: GPL-3.0-only
#include "laws/friction_law.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double scatter             = 0.01; ///< in a table, of its largest coefficient
    constexpr double largest_coefficient = 10.;
    constexpr double plausible           = 2.; ///< for a coefficient, and too slow for the fastest of a table [mm/s]

    FrictionValue evaluate(const CoulombFriction &law, const double /*speed*/)
    {
      return { law.coefficient, 0. };
    }

    constexpr FrictionPiece cork_on_aluminium[] = { { 0., -9.235e-6, 4.422e-3, 0.3491 },
                                                    { 200., -7.086e-7, 1.058e-3, 0.6809 },
                                                    { 750., 0., 0., 1.076 } };

    FrictionValue evaluate(const CorkOnAluminium & /*law*/, const double v)
    {
      const auto *piece = std::begin(cork_on_aluminium);
      while (std::next(piece) != std::end(cork_on_aluminium) && v >= std::next(piece)->from)
        ++piece;
      return { (piece->quadratic * v + piece->linear) * v + piece->constant, 2. * piece->quadratic * v + piece->linear };
    }

    FrictionValue evaluate(const StribeckFriction &law, const double speed)
    {
      const double u    = speed / law.speed;
      const double fall = (law.at_rest - law.kinetic) * std::exp(-std::pow(u, law.exponent));
      return { law.kinetic + fall + law.viscous * speed,
               law.viscous - fall * law.exponent * std::pow(u, law.exponent - 1.) / law.speed };
    }

    FrictionValue evaluate(const TabulatedFriction &law, const double speed)
    {
      return { law.curve.value(speed), law.curve.derivative(speed) };
    }
  } // namespace

  TabulatedFriction::TabulatedFriction(const std::vector<double> &speeds, const std::vector<double> &coefficients)
      : curve(speeds, coefficients)
      , fastest(speeds.back())
  {
    if (speeds.front() < 0.)
      throw InputError("row 1: speed " + number_text(speeds.front()) + " mm/s: must be >= 0");
    const auto negative = std::find_if(coefficients.begin(), coefficients.end(), [](const double mu) { return mu < 0.; });
    if (negative != coefficients.end())
      throw InputError("row " + std::to_string(negative - coefficients.begin() + 1) + ": coefficient " + number_text(*negative) +
                       ": must be >= 0");
    const auto largest   = std::max_element(coefficients.begin(), coefficients.end());
    const bool exchanged = *largest > plausible && speeds.back() <= plausible;
    if (*largest > largest_coefficient || exchanged)
      throw InputError("row " + std::to_string(largest - coefficients.begin() + 1) + ": coefficient " + number_text(*largest) +
                       (exchanged ? " with speeds of " + number_text(speeds.back()) + " mm/s at most" : "") +
                       ": must be <= " + number_text(exchanged ? plausible : largest_coefficient) +
                       "; the speed is the first column, mu the second: are they exchanged?");
    double highest = 0.;
    for (const double mu : coefficients)
    {
      highest = std::max(highest, mu);
      falls   = falls || mu < highest - scatter * *largest;
    }
  }

  FrictionValue friction_coefficient(const FrictionLaw &law, const double speed)
  {
    const auto value = std::visit([speed](const auto &choice) { return evaluate(choice, speed); }, law.law);
    return { law.factor * value.coefficient, law.factor * value.derivative };
  }

  std::vector<FrictionPiece> rising_pieces(const FrictionLaw &law)
  {
    std::vector<FrictionPiece> result;
    if (const auto *const constant = std::get_if<CoulombFriction>(&law.law))
      result = { { 0., 0., 0., constant->coefficient } };
    else if (std::holds_alternative<CorkOnAluminium>(law.law))
      result = { std::begin(cork_on_aluminium), std::end(cork_on_aluminium) };
    for (auto &piece : result)
    {
      piece.quadratic *= law.factor;
      piece.linear *= law.factor;
      piece.constant *= law.factor;
    }
    return result;
  }

  bool falls_with_speed(const FrictionLaw &law)
  {
    if (const auto *const stribeck = std::get_if<StribeckFriction>(&law.law))
    {
      const double steepest = stribeck->speed * std::pow(1. - 1. / stribeck->exponent, 1. / stribeck->exponent);
      return evaluate(*stribeck, steepest).derivative < 0.;
    }
    if (const auto *const table = std::get_if<TabulatedFriction>(&law.law))
      return table->falls;
    return false;
  }

  FrictionLaw friction_at_speed(FrictionLaw law, const double speed)
  {
    law.law    = CoulombFriction{ friction_coefficient(law, std::abs(speed)).coefficient };
    law.factor = 1.;
    return law;
  }

  FrictionLaw step_friction(const FrictionLaw &friction, const double drive_speed)
  {
    return friction.speed == FrictionSpeed::drive ? friction_at_speed(friction, drive_speed) : friction;
  }
} // namespace sprag
