// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/identification.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "input/analysis_texts.h"
#include "results/row_statistics.h"
#include "scene/scene.h"

#include <boost/math/distributions/fisher_f.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace sprag
{
  namespace
  {
    struct VibrationWindow
    {
      double window; ///< [mm]
      bool is_full;  ///< residuals still exceed the noise at the end of the largest window
    };

    constexpr std::size_t fewest_rows = 8;
    constexpr double groups_a_window  = 25.;
    constexpr double chance           = 1e-4;

    /// Neighbouring rows of one channel in one stroke.
    struct RowGroup
    {
      std::vector<double> travels;
      double squares = 0.;
    };

    double noise_limit(const ChannelNoise &noise, const std::size_t rows)
    {
      const double group_size = std::max(1., static_cast<double>(rows) / noise.correlation);
      const boost::math::fisher_f ratio(group_size, std::max(1., noise.effective_rows()));
      return boost::math::quantile(boost::math::complement(ratio, chance));
    }

    /// Returns the most that may be left out behind a turn: a quarter of the shortest stroke [mm].
    double largest_window(const MeasuredMotion &motion)
    {
      double shortest = motion.length(0);
      for (std::size_t stroke = 1; stroke < motion.strokes().size(); ++stroke)
        shortest = std::min(shortest, motion.length(stroke));
      return 0.25 * shortest;
    }

    /// Finds how far behind turns residuals are larger than noise: up to the last of groups of neighbouring rows, at least 8,
    /// whose mean square is more than what noise has once in 10^4 groups (F distribution). `residuals` are over the deviations of
    /// noise, those within the largest window too.
    VibrationWindow vibration_window(const StrokeFit &fit, const std::vector<std::pair<UsedValue, double>> &residuals,
                                     const std::vector<ChannelNoise> &noise, const double largest)
    {
      std::map<std::pair<std::size_t, std::size_t>, std::vector<RowGroup>> all; // by channel and stroke
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> within;
      const auto travel = [&](const UsedValue &value) { return fit.motion.travel(value.row, 0., value.stroke); };
      for (const auto &[value, residual] : residuals)
        if (travel(value) <= largest)
          ++within[{ value.channel, value.stroke }];
      for (const auto &[value, residual] : residuals)
      {
        if (travel(value) > largest)
          continue;
        const std::pair place{ value.channel, value.stroke };
        const auto rows = std::max(fewest_rows, static_cast<std::size_t>(static_cast<double>(within[place]) / groups_a_window));
        auto &groups    = all[place];
        if (groups.empty() || groups.back().travels.size() == rows)
          groups.emplace_back();
        groups.back().travels.push_back(travel(value));
        groups.back().squares += residual * residual;
      }
      VibrationWindow result{ 0., false };
      for (const auto &[place, groups] : all)
        for (const auto &group : groups)
        {
          const auto rows = group.travels.size();
          if (group.squares / static_cast<double>(rows) <= noise_limit(noise[place.first], rows))
            continue;
          result.window  = std::max(result.window, group.travels.back());
          result.is_full = result.is_full || &group == &groups.back();
        }
      return result;
    }

    constexpr double explains     = 0.8;  ///< of the squares of residuals beyond the noise, from which an unknown is named
    constexpr double small_change = 1e-4; ///< relative change of the radius by which its derivatives are found

    /// A change of the lever, or of what a channel shows of it.
    struct Candidate
    {
      OneMoreUnknown unknown;
      IdentifiedLever lever; ///< changed by `by`
      double by;
      bool scales_Q = false; ///< by `by` per cent
    };

    std::vector<Candidate> candidates(const Scene &scene, const IdentifiedLever &lever)
    {
      const auto &settings = scene.identification;
      const auto is_sought = [&](const Unknown unknown) { return contains(settings.sought, unknown); };
      std::vector<Candidate> result;
      const double dR = small_change * lever.geometry.cylinder_radius;
      result.push_back({ { "Geometry/Cylinder radius", "mm", 0., 0. }, lever, dR });
      result.back().lever.geometry.cylinder_radius += dR;
      for (std::size_t i = 0; i < settings.measured.channels.size(); ++i)
      {
        const auto &channel = settings.measured.channels[i];
        const auto word     = word_for(force_words(), channel.force);
        if (channel.force == MeasuredForce::drive)
          result.push_back({ { "the scale of " + word, "%", 0., 0. }, lever, 100., true });
        if (is_sought(Unknown::force_offsets))
          continue;
        result.push_back({ { "the offset of " + word, "N", 0., 0. }, lever, 1. });
        result.back().lever.offsets[i] += 1.;
      }
      if (!is_sought(Unknown::lag) && !settings.measured.time.empty())
      {
        const auto &time = settings.measured.time;
        const double dt  = 0.1 * (time.back() - time.front()) / static_cast<double>(time.size());
        result.push_back({ { "lag", "s", 0., 0. }, lever, dt });
        result.back().lever.lag += dt;
      }
      return result;
    }

    /// Returns the part of a vector that is orthogonal to the columns of an orthonormal basis, which is stored row by row.
    std::vector<double> orthogonal_part(const std::vector<double> &basis, std::vector<double> vector)
    {
      const std::size_t columns = basis.size() / vector.size();
      for (std::size_t j = 0; j < columns; ++j)
      {
        double along = 0.;
        for (std::size_t i = 0; i < vector.size(); ++i)
          along += basis[i * columns + j] * vector[i];
        for (std::size_t i = 0; i < vector.size(); ++i)
          vector[i] -= along * basis[i * columns + j];
      }
      return vector;
    }

    double product(const std::vector<double> &a, const std::vector<double> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    /// The squares that residuals would have if only the noise of neighbouring values were left, by second differences.
    double noise_squares(const std::vector<UsedValue> &used, const std::vector<double> &residuals, const std::size_t channels)
    {
      double result = 0.;
      for (std::size_t channel = 0; channel < channels; ++channel)
      {
        std::vector<double> own;
        for (std::size_t i = 0; i < used.size(); ++i)
          if (used[i].channel == channel)
            own.push_back(residuals[i]);
        for (std::size_t i = 2; i < own.size(); ++i)
          result += std::pow(own[i - 2] - 2. * own[i - 1] + own[i], 2) / 6.;
      }
      return result;
    }

    /// Finds those of offsets, lag, scale of Q and cylinder radius each of which alone would explain the residuals but for noise,
    /// beside changes of the unknowns sought. `jacobian` is that of the residuals over `deviations`. Straight lines stand for the
    /// model: large changes are estimates.
    std::vector<OneMoreUnknown> more_unknowns(const Scene &scene, const StrokeFit &fit, const Identification &found,
                                              const std::vector<double> &deviations, const std::vector<double> &jacobian)
    {
      const auto &channels     = scene.identification.measured.channels;
      const std::size_t sought = found.used.empty() ? 0 : jacobian.size() / found.used.size();
      const auto basis         = singular_values(jacobian, sought).left;
      /// Returns the value that a channel shows of a lever, over its deviation; NaN where the lever has no slide.
      const auto computed_force = [&](const Candidate &candidate, const UsedValue &value)
      {
        const auto slide   = fit.slide(candidate.lever, found.correction, value.row, value.stroke);
        const bool is_Q    = channels[value.channel].force == MeasuredForce::drive;
        const double force = slide ? fit.computed_force(candidate.lever, *slide, value.channel) : std::nan("");
        return (candidate.scales_Q && is_Q ? (1. + candidate.by / 100.) * force : force) / deviations[value.channel];
      };
      const Candidate own{ {}, found.lever, 1. };
      auto residuals       = mapped(found.used, [&](const UsedValue &value)
                                    { return value.value / deviations[value.channel] - computed_force(own, value); });
      const double noise   = noise_squares(found.used, residuals, channels.size());
      residuals            = orthogonal_part(basis, residuals);
      const double squares = product(residuals, residuals) - noise;
      std::vector<OneMoreUnknown> result;
      for (auto &candidate : candidates(scene, found.lever))
      {
        const auto change = orthogonal_part(
            basis, mapped(found.used, [&](const UsedValue &value)
                          { return (computed_force(candidate, value) - computed_force(own, value)) / candidate.by; }));
        const double length = product(change, change), along = product(change, residuals);
        candidate.unknown.change = along / length;
        candidate.unknown.share  = along * along / (length * squares);
        if (squares > 0. && candidate.unknown.share > explains) // false for NaN
          result.push_back(candidate.unknown);
      }
      return result;
    }

    constexpr unsigned int most_rounds = 60;
    constexpr double settled           = 1e-6; ///< change of a scaled unknown in a round
    constexpr double held_within       = 3.;   ///< scales of an unknown
    constexpr double same_lag          = 0.5;  ///< rows; a lag that changes by less leaves the values chosen
    constexpr double corrected         = 1e-4; ///< change below which the model is not evaluated again

    /// Fits again and again, each time with the noise, weights, window and correction of the last fit.
    struct Identifier
    {
      const Scene &scene;
      const MeasuredMotion &motion;
      const LeverUnknowns &unknowns;
      const IdentificationSettings &settings = scene.identification;
      const StrokeFit fit                    = StrokeFit(scene, motion, unknowns);
      Identification result                  = {};
      std::vector<double> scaled =
          mapped(unknowns.numbers(), [](const UnknownNumber &number) { return number.start / number.scale; });
      const std::vector<double> start = scaled;
      std::vector<double> deviations ///< of the channels, by which residuals are scaled
          = mapped(settings.measured.channels, [](const ForceChannel &channel) { return neighbour_deviation(channel.values); });
      std::vector<double> corrected_at                  = {};
      std::optional<std::pair<double, double>> selected = {}; ///< window and lag by which values were chosen

      Identification identify()
      {
        const double generous = largest_window(fit.motion);
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

      void repeat()
      {
        for (result.converged = false; result.rounds < most_rounds && !result.converged; ++result.rounds)
        {
          const auto before = scaled;
          correct();
          select();
          const auto weights = robust_weights();
          scaled             = least_squares([&](const auto &at) { return held_residuals(at, weights); }, scaled);
          result.noise       = estimate_noise(result.used, residuals(), deviations, settings.loss, scaled.size());
          for (std::size_t i = 0; i < deviations.size(); ++i)
            deviations[i] = std::max(result.noise[i].deviation, 1e-12 * channel_peak(i));
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

      double channel_peak(const std::size_t channel) const
      {
        const double peak = largest(settings.measured.channels[channel].values, [](const double value) { return value; });
        return peak > 0. ? peak : 1.;
      }

      /// Standard deviation of the noise, estimated from second differences, which a smooth signal hardly has.
      static double neighbour_deviation(const std::vector<double> &values)
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
        result.correction = model_correction(unknowns.scene_with(lever()), fit.motion.peak_speed());
      }

      void select()
      {
        const double lag = lever().lag;
        if (selected && selected->first == result.window && std::abs(selected->second - lag) <= same_lag * fit.motion.spacing())
          return;
        selected             = { result.window, lag };
        result.used          = fit.used(result.window, lag);
        const bool has_table = contains(settings.sought, Unknown::friction_table);
        if (result.used.size() < 3 * scaled.size())
          throw AnalysisError(std::to_string(result.used.size()) + " values are left behind the reversals' windows" +
                              (has_table ? " from the first of Identification/Friction speeds on" : "") + ", too few for " +
                              std::to_string(scaled.size()) + " unknowns: take a smaller Identification/Reversal window" +
                              (has_table ? " or lower speeds" : ""));
      }

      std::vector<double> residuals() const
      {
        return fit.residuals(scaled, result.used, deviations, result.correction);
      }

      /// Residuals of all rows, those within the reversal windows included.
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
        if (settings.loss == IdentificationLoss::least_squares || result.rounds == 0)
          return {};
        return mapped(residuals(),
                      [&](const double residual) { return residual == 0. ? 1. : influence(settings.loss, residual) / residual; });
      }

      void finish()
      {
        result.lever = lever();
        const auto slopes =
            jacobian([&](const auto &at) { return fit.residuals(at, result.used, deviations, result.correction); }, scaled);
        result.more           = more_unknowns(scene, fit, result, deviations, slopes);
        const auto &numbers   = unknowns.numbers();
        const auto influences = mapped(residuals(), [&](const double residual) { return influence(settings.loss, residual); });
        result.uncertainty    = uncertainty(slopes, result.used, influences, result.noise, numbers, settings.confidence);
        const auto values     = fit.in_units(scaled);
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
          const double deviation = numbers[i].scale * result.uncertainty.deviations[i];
          const double half      = result.uncertainty.quantile * deviation;
          result.found.push_back({ numbers[i], values[i], deviation, values[i] - half, values[i] + half });
        }
      }
    };
  } // namespace

  Identification identify(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns)
  {
    return Identifier{ scene, motion, unknowns }.identify();
  }
} // namespace sprag
