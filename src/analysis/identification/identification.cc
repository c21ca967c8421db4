// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/identification.h"

#include "analysis/identification/one_more_unknown.h"
#include "analysis/identification/vibration_window.h"
#include "base/errors.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_rounds = 60;
    constexpr double settled           = 1e-6; ///< change of a scaled unknown in a round
    constexpr double held_within       = 3.;   ///< scales of an unknown
    constexpr double same_lag          = 0.5;  ///< rows; a lag that changes by less leaves the values chosen
    constexpr double corrected         = 1e-4; ///< change that the model is not asked again for

    /// Fits again and again, each time with the noise, weights, window and correction of the last fit.
    class Identifier
    {
    public:
      Identifier(const Scene &of_stroke, const MeasuredMotion &of_cylinder, const LeverUnknowns &of_fit)
          : scene(of_stroke)
          , settings(scene.identification)
          , unknowns(of_fit)
          , fit(scene, of_cylinder, unknowns)
      {
        for (const auto &number : unknowns.numbers())
          scaled.push_back(number.start / number.scale);
        start = scaled;
        for (const auto &channel : settings.measured.channels)
          deviations.push_back(deviation_of_neighbours(channel.values));
      }

      Identification identify()
      {
        const double generous = largest_window(fit.way());
        result.window         = settings.window.value_or(generous);
        repeat();
        if (!settings.window)
        {
          const auto found      = vibration_window(fit, all_residuals(), result.noise, generous);
          result.window         = found.window;
          result.window_is_full = found.is_full;
          repeat();
        }
        finish();
        return result;
      }

    private:
      const Scene &scene;
      const IdentificationSettings &settings;
      const LeverUnknowns &unknowns;
      const StrokeFit fit;
      Identification result;
      std::vector<double> scaled, start;
      std::vector<double> deviations; ///< of the channels, by which residuals are scaled
      std::vector<double> corrected_at;
      std::optional<std::pair<double, double>> selected; ///< window and lag by which values were chosen

      void repeat()
      {
        for (result.converged = false; result.rounds < most_rounds && !result.converged; ++result.rounds)
        {
          const auto before = scaled;
          correct();
          select();
          const auto weights = robust_weights();
          scaled             = least_squares([&](const auto &at) { return held_residuals(at, weights); }, scaled);
          result.noise       = noise_of(result.used, residuals(), deviations, settings.loss, scaled.size());
          for (std::size_t i = 0; i < deviations.size(); ++i)
            deviations[i] = std::max(result.noise[i].deviation, 1e-12 * largest_of(i));
          result.converged = result.rounds > 0 && is_near(before, settled);
        }
      }

      /// With a spring to where the search began for each unknown, so weak that it counts only for what the data do not tell:
      /// that stays near its start.
      std::vector<double> held_residuals(const std::vector<double> &at, const std::vector<double> &weights) const
      {
        auto all = fit.residuals(at, result.used, deviations, result.correction, weights);
        for (std::size_t i = 0; i < at.size(); ++i)
          all.push_back((at[i] - start[i]) / held_within);
        return all;
      }

      bool is_near(const std::vector<double> &other, const double most) const
      {
        for (std::size_t i = 0; i < scaled.size(); ++i)
          if (other.size() != scaled.size() || std::abs(other[i] - scaled[i]) > most * std::max(1., std::abs(scaled[i])))
            return false;
        return true;
      }

      double largest_of(const std::size_t channel) const
      {
        double largest = 0.;
        for (const double value : settings.measured.channels[channel].values)
          largest = std::isnan(value) ? largest : std::max(largest, std::abs(value));
        return largest > 0. ? largest : 1.;
      }

      /// By second differences, which what is smooth hardly has.
      static double deviation_of_neighbours(const std::vector<double> &values)
      {
        double squares = 0., count = 0., largest = 0.;
        for (std::size_t i = 1; i + 1 < values.size(); ++i)
          if (const double second = values[i - 1] - 2. * values[i] + values[i + 1]; !std::isnan(second))
          {
            squares += second * second;
            count += 6.;
            largest = std::max(largest, std::abs(values[i]));
          }
        return std::max({ std::sqrt(squares / std::max(count, 1.)), 1e-6 * largest, 1e-12 });
      }

      IdentifiedLever lever() const
      {
        return unknowns.lever(fit.in_units(scaled));
      }

      void correct()
      {
        if (!corrected_at.empty() && is_near(corrected_at, corrected))
          return;
        corrected_at      = scaled;
        result.correction = model_correction(unknowns.scene_with(lever()), fit.way().peak_speed());
      }

      void select()
      {
        const double lag = lever().lag;
        if (selected && selected->first == result.window && std::abs(selected->second - lag) <= same_lag * fit.way().spacing())
          return;
        selected    = { result.window, lag };
        result.used = fit.used(result.window, lag);
        if (result.used.size() < 3 * scaled.size())
          throw AnalysisError(std::to_string(result.used.size()) +
                              " values are left behind the reversals' windows, too few for " + std::to_string(scaled.size()) +
                              " unknowns: take a smaller Identification/Reversal window");
      }

      std::vector<double> residuals() const
      {
        return fit.residuals(scaled, result.used, deviations, result.correction);
      }

      /// Of all rows, those within the window too.
      std::vector<std::pair<UsedValue, double>> all_residuals() const
      {
        std::vector<std::pair<UsedValue, double>> all;
        const auto values = fit.used(0., lever().lag);
        const auto found  = fit.residuals(scaled, values, deviations, result.correction);
        for (std::size_t i = 0; i < values.size(); ++i)
          all.emplace_back(values[i], found[i]);
        return all;
      }

      std::vector<double> robust_weights() const
      {
        std::vector<double> weights;
        if (settings.loss == IdentificationLoss::squares || result.rounds == 0)
          return weights;
        for (const double residual : residuals())
          weights.push_back(residual == 0. ? 1. : influence(settings.loss, residual) / residual);
        return weights;
      }

      void finish()
      {
        result.lever = lever();
        const auto slopes =
            jacobian([&](const auto &at) { return fit.residuals(at, result.used, deviations, result.correction); }, scaled);
        result.more         = more_unknowns(scene, fit, result, deviations, slopes);
        const auto &numbers = unknowns.numbers();
        result.knowledge    = knowledge(slopes, result.used, result.noise, numbers, settings.confidence);
        const auto values   = fit.in_units(scaled);
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
          const double deviation = numbers[i].scale * result.knowledge.deviations[i];
          const double half      = result.knowledge.quantile * deviation;
          result.found.push_back({ numbers[i], values[i], deviation, values[i] - half, values[i] + half });
        }
      }
    };
  } // namespace

  Identification identify(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns)
  {
    return Identifier(scene, motion, unknowns).identify();
  }
} // namespace sprag
