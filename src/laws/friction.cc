#include "laws/friction.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"

#include <algorithm>

namespace sprag
{
  class TabulatedFriction::Interpolant : public MonotoneCubic
  {
  public:
    Interpolant(const std::vector<double> &x, const std::vector<double> &y)
        : MonotoneCubic(x, y)
        , speeds(x)
    {
    }

    const std::vector<double> speeds;
  };

  namespace
  {
    constexpr double largest_coefficient = 10.;
    constexpr double plausible           = 2.; ///< for a coefficient, and too slow for the fastest of a table [mm/s]
  }                                            // namespace

  TabulatedFriction::TabulatedFriction(std::vector<double> speeds, std::vector<double> coefficients)
      : interpolant(std::make_shared<const Interpolant>(speeds, coefficients))
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
  }

  FrictionValue TabulatedFriction::value(const double speed) const
  {
    return { interpolant->value(speed), interpolant->derivative(speed) };
  }

  const std::vector<double> &TabulatedFriction::speeds() const
  {
    return interpolant->speeds;
  }

  namespace
  {
    FrictionValue value_of(const CoulombFriction &law, const double /*speed*/)
    {
      return { law.coefficient, 0. };
    }

    FrictionValue value_of(const CorkOnAluminium & /*law*/, const double v)
    {
      if (v < 200.)
        return { (-9.235e-6 * v + 4.422e-3) * v + 0.3491, -2. * 9.235e-6 * v + 4.422e-3 };
      if (v < 750.)
        return { (-7.086e-7 * v + 1.058e-3) * v + 0.6809, -2. * 7.086e-7 * v + 1.058e-3 };
      return { 1.076, 0. };
    }

    FrictionValue value_of(const TabulatedFriction &law, const double speed)
    {
      return law.value(speed);
    }

    const std::vector<double> &knots_of(const CoulombFriction & /*law*/)
    {
      static const std::vector<double> none;
      return none;
    }

    const std::vector<double> &knots_of(const CorkOnAluminium & /*law*/)
    {
      static const std::vector<double> ends = { 200., 750. };
      return ends;
    }

    const std::vector<double> &knots_of(const TabulatedFriction &law)
    {
      return law.speeds();
    }
  } // namespace

  FrictionValue friction_coefficient(const FrictionLaw &law, const double speed)
  {
    const auto value = std::visit([speed](const auto &choice) { return value_of(choice, speed); }, law.law);
    return { law.factor * value.coefficient, law.factor * value.derivative };
  }

  const std::vector<double> &friction_knots(const FrictionLaw &law)
  {
    return std::visit([](const auto &choice) -> const std::vector<double> & { return knots_of(choice); }, law.law);
  }
} // namespace sprag
