// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/identification.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/ranges.h"
#include "base/text.h"
#include "levers/dynamics.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int sampled_positions = 24; ///< x per direction, equally spaced over the drive

    /// Returns P and Q of the model less those of the closed form [N], interpolated over x; the sign of `v` is the direction.
    std::array<MonotoneCubic, 2> force_corrections(const Scene &scene, DynamicModel &model, const double v)
    {
      const double from = scene.drive.minimum();
      const double to   = scene.drive.maximum();
      std::vector<double> x, P, Q;
      if (from == 0. && scene.spring.rest_angle == 0.) // no contact force at x = 0, so no difference
      {
        x.push_back(0.);
        P.push_back(0.);
        Q.push_back(0.);
      }
      for (unsigned int i = 1; i <= sampled_positions; ++i)
      {
        const DrivePoint drive{ 0., from + (to - from) * i / sampled_positions, v, 0. };
        const auto found = model.sliding_forces(drive);
        if (found.empty())
          throw AnalysisError("the model has no steady slide at x = " + mm(drive.x) + (v < 0. ? " backward" : " forward") +
                              ", so that it cannot correct the closed form: take Analysis/Model = closed form");
        const auto closed = closed_form(scene, drive.x, v);
        x.push_back(drive.x);
        P.push_back(found.front().P - closed.P);
        Q.push_back(found.front().Q - closed.Q);
      }
      return { { MonotoneCubic(x, P), MonotoneCubic(x, Q) } };
    }

    constexpr double least_speed       = 0.02; ///< share of the peak speed, below which the contact may stick
    constexpr double stroke_end        = 0.02; ///< share of the stroke's length, in which the drive slows down to turn
    constexpr double no_slide_residual = 1e6;  ///< standard deviations; residual of a lever without a steady slide

    /// Returns the second derivative of theta over x: theta_x = sin^2 th / ((R - e) cos th - h) [rad/mm^2].
    double curvature(const Geometry &geometry, const Kinematics &contact)
    {
      const double sine  = std::sin(contact.theta);
      const double arm   = geometry.cylinder_radius - geometry.interface_offset;
      const double below = arm * std::cos(contact.theta) - geometry.pivot_height;
      return contact.theta_x * sine * (2. * std::cos(contact.theta) * below + arm * sine * sine) / (below * below);
    }

    constexpr double huber_limit         = 1.345; ///< standard deviations; 95 % efficiency for normal noise (Huber)
    constexpr double indistinct_width    = 0.5;   ///< half-width of an interval over an unknown's scale: not determined
    constexpr double unlimited_deviation = 1e6;   ///< in scales, of a direction without influence on the data
    constexpr double slowest_decay       = 0.98;  ///< ratio of the autocorrelation at neighbouring distances
    constexpr double weak_correlation    = 0.98;  ///< of two unknowns that are badly separated
    constexpr double named_component     = 0.2;   ///< smallest component, over the largest, whose unknown is named
    constexpr double smallest_singular   = 1e-10; ///< over the largest singular value: round-off below

    /// Returns r(d) = sum x_i x_(i + d) / sum x_i^2 within strokes, for residuals x at a distance of d rows.
    double autocorrelation(const std::vector<std::vector<double>> &strokes, const std::size_t distance)
    {
      double products = 0., squares = 0.;
      for (const auto &stroke : strokes)
        for (std::size_t i = 0; i < stroke.size(); ++i)
        {
          squares += stroke[i] * stroke[i];
          if (i + distance < stroke.size())
            products += stroke[i] * stroke[i + distance];
        }
      return squares > 0. ? products / squares : 0.;
    }

    /// Returns the rows per independent row, 1 + 2 sum_d r(d), over distances d up to the first r(d) < 2/sqrt(rows).
    double estimate_correlation(const std::vector<std::vector<double>> &strokes, const double rows)
    {
      std::size_t longest = 0;
      for (const auto &stroke : strokes)
        longest = std::max(longest, stroke.size());
      double sum = 1., last = 0., rate = 0.;
      for (std::size_t distance = 1; distance < longest / 2; ++distance)
      {
        const double found = autocorrelation(strokes, distance);
        if (found < 2. / std::sqrt(rows))
          break;
        sum += 2. * found;
        last = found;
        rate = distance == 1 ? found : rate;
      }
      // The rest of the sum is approximated by a geometric series with ratio r(1).
      return sum + 2. * last * rate / (1. - std::min(rate, slowest_decay));
    }

    /// Returns the names of the unknowns with large components in a right singular vector of the Jacobian.
    std::vector<std::string> direction_names(const SingularValues &singular, const std::size_t direction,
                                             const std::vector<UnknownNumber> &unknowns)
    {
      const auto n         = unknowns.size();
      const auto component = [&](const std::size_t i) { return std::abs(singular.directions[i * n + direction]); };
      double largest       = 0.;
      for (std::size_t i = 0; i < n; ++i)
        largest = std::max(largest, component(i));
      std::vector<std::string> result;
      for (std::size_t i = 0; i < n; ++i)
        if (component(i) >= named_component * largest)
          result.push_back(unknowns[i].name);
      return result;
    }

    std::string listed(std::vector<std::string> names)
    {
      const auto last = names.back();
      names.pop_back();
      return names.empty() ? last : boost::algorithm::join(names, ", ") + " and " + last;
    }

    /// Returns the covariance of the scaled unknowns, (J'J)^-1 (sum_i f_i J_i' J_i) (J'J)^-1, by J = U S V'. f_i is correlation
    /// times spread of the channel of value i, 1 for white normal noise, times `shares` (sandwich estimator).
    std::vector<double> covariance(const SingularValues &singular, const std::vector<UsedValue> &values,
                                   const std::vector<ChannelNoise> &noise, const std::vector<double> &shares)
    {
      const auto n       = singular.values.size();
      const auto is_lost = [&](const std::size_t a) { return singular.values[a] <= smallest_singular * singular.values[0]; };
      std::vector<double> result(n * n), change(n); // of the unknowns by one value
      const auto add = [&](const double factor)
      {
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            result[i * n + j] += factor * change[i] * change[j];
      };
      for (std::size_t row = 0; row < values.size(); ++row)
      {
        std::fill(change.begin(), change.end(), 0.);
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t i = 0; i < n && !is_lost(a); ++i)
            change[i] += singular.left[row * n + a] / singular.values[a] * singular.directions[i * n + a];
        const auto &channel = noise[values[row].channel];
        add(channel.correlation * channel.spread * shares[row]);
      }
      for (std::size_t a = 0; a < n; ++a)
      {
        for (std::size_t i = 0; i < n; ++i)
          change[i] = unlimited_deviation * singular.directions[i * n + a];
        if (is_lost(a))
          add(1.);
      }
      return result;
    }

    /// Returns the square of the influence of each value over the mean of its channel: 1 on average, more where there is more
    /// noise.
    std::vector<double> noise_shares(const std::vector<UsedValue> &values, const std::vector<double> &influences,
                                     const std::size_t channels)
    {
      std::vector<double> sums(channels), counts(channels), result;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        sums[values[i].channel] += influences[i] * influences[i];
        counts[values[i].channel] += 1.;
      }
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const double mean = sums[values[i].channel] / counts[values[i].channel];
        result.push_back(mean > 0. ? influences[i] * influences[i] / mean : 1.);
      }
      return result;
    }

    /// Adds a sentence for each right singular vector along which the confidence interval is too wide.
    void add_indistinct(const std::vector<double> &covariances, const std::vector<UnknownNumber> &unknowns, Uncertainty &found)
    {
      const auto n = unknowns.size();
      for (std::size_t direction = n; direction-- > 0;)
      {
        double variance = 0.;
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            variance += found.singular.directions[i * n + direction] * covariances[i * n + j] *
                        found.singular.directions[j * n + direction];
        if (found.quantile * std::sqrt(variance) < indistinct_width)
          continue;
        const auto names    = direction_names(found.singular, direction, unknowns);
        const auto sentence = "The data do not tell " + listed(names) + (names.size() == 1 ? "." : " apart.");
        if (!contains(found.indistinct, sentence))
          found.indistinct.push_back(sentence);
      }
    }

    /// Adds a sentence for each pair of strongly correlated unknowns.
    void add_weak(const std::vector<UnknownNumber> &unknowns, Uncertainty &found)
    {
      const auto n = unknowns.size();
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
          if (std::abs(found.correlation[i * n + j]) > weak_correlation)
            found.weak.push_back(unknowns[i].name + " and " + unknowns[j].name + " are told apart badly: correlation " +
                                 formatted("%.4f", found.correlation[i * n + j]) + ".");
    }
  } // namespace

  ModelCorrection model_correction(const Scene &scene, const double peak_speed)
  {
    if (!identifies_by_model(scene))
      return [](double, int) { return SlidingForces{}; };
    Scene held             = scene;
    held.stability.damping = false;
    held                   = held_scene(held);
    const auto dynamics    = DynamicsMaker(false).make(held);
    const auto forward     = force_corrections(scene, dynamics.model(), peak_speed);
    const auto back        = force_corrections(scene, dynamics.model(), -peak_speed);
    return [forward, back](const double x, const int direction)
    {
      const auto &forces = direction > 0 ? forward : back;
      return SlidingForces{ forces[0].value(x), forces[1].value(x) };
    };
  }

  StrokeFit::StrokeFit(const Scene &scene_, const MeasuredMotion &motion_, const LeverUnknowns &unknowns_)
      : motion(motion_)
      , scene(scene_)
      , unknowns(unknowns_)
      , inertia(identifies_by_model(scene) ? scene.lever.moment_of_inertia : 0.)
  {
  }

  std::vector<UsedValue> StrokeFit::used(const double window, const double lag) const
  {
    const auto &settings = scene.identification;
    const auto &measured = settings.measured;
    // Below its first speed a table holds mu constant, which would bias that value.
    const double slowest = contains(settings.sought, Unknown::friction_table) ? settings.friction_speeds.front() : 0.;
    const bool by_drive  = scene.friction.speed == FrictionSpeed::drive;
    std::vector<UsedValue> result;
    for (std::size_t row = 0; row < measured.rows(); ++row)
    {
      const auto stroke = motion.stroke_at(row, lag);
      const auto place  = motion.at(row, lag, stroke);
      const bool slides =
          motion.covers(row, lag, stroke) && place.x > 0. && std::abs(place.v) > least_speed * motion.peak_speed();
      const double travel = motion.travel(row, lag, stroke);
      if (std::abs(by_drive ? place.v : sliding_speed(scene.geometry, place.x, place.v)) < slowest)
        continue;
      if (!slides || travel <= window || travel > (1. - stroke_end) * motion.length(stroke))
        continue;
      for (std::size_t channel = 0; channel < measured.channels.size(); ++channel)
        if (const double value = measured.channels[channel].values[row]; !std::isnan(value))
          result.push_back({ row, channel, stroke, value });
    }
    return result;
  }

  std::optional<SlidingForces> StrokeFit::slide(const IdentifiedLever &lever, const ModelCorrection &correction,
                                                const std::size_t row, const std::size_t stroke) const
  {
    const auto place    = motion.at(row, lever.lag, stroke);
    const int direction = motion.strokes()[stroke].direction;
    const double v      = std::copysign(place.v, direction);
    const auto contact  = kinematics(lever.geometry, place.x);
    const double turn   = contact.theta - kinematics(lever.geometry, 0.).theta;
    const double spring = lever.stiffness * (turn - lever.rest_angle);
    // Steady sliding still accelerates the lever: theta'' = theta_xx v^2.
    const double moment = spring + inertia * curvature(lever.geometry, contact) * v * v;
    const auto state    = closed_form(lever.geometry, lever.friction, moment, contact, v);
    const double arm    = contact.s + direction * state.mu * lever.geometry.interface_offset;
    if (!(arm > 0.) || !std::isfinite(state.P) || state.mu < 0.)
      return std::nullopt;
    const auto model = correction(place.x, direction);
    return SlidingForces{ state.P + model.P, state.Q + model.Q };
  }

  double StrokeFit::computed_force(const IdentifiedLever &lever, const SlidingForces &slide, const std::size_t channel) const
  {
    const bool is_Q = scene.identification.measured.channels[channel].force == MeasuredForce::drive;
    return (is_Q ? slide.Q : slide.P) + lever.offsets[channel];
  }

  std::vector<double> StrokeFit::in_units(const std::vector<double> &scaled) const
  {
    auto result = scaled;
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] *= unknowns.numbers()[i].scale;
    return result;
  }

  std::vector<double> StrokeFit::residuals(const std::vector<double> &scaled, const std::vector<UsedValue> &values,
                                           const std::vector<double> &deviations, const ModelCorrection &correction,
                                           const std::vector<double> &weights) const
  {
    std::vector<double> result(values.size(), no_slide_residual);
    try
    {
      const auto lever = unknowns.lever(in_units(scaled));
      std::optional<SlidingForces> row_slide;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const auto &[row, channel, stroke, value] = values[i];
        if (i == 0 || row != values[i - 1].row)
          row_slide = slide(lever, correction, row, stroke);
        if (row_slide)
          result[i] = (value - computed_force(lever, *row_slide, channel)) / deviations[channel];
        if (!weights.empty())
          result[i] *= std::sqrt(weights[i]);
      }
    }
    catch (const InputError &)
    {
      // The values make no lever: the least-squares step is rejected for its large residuals.
    }
    return result;
  }

  double influence(const IdentificationLoss loss, const double residual)
  {
    return loss == IdentificationLoss::least_squares ? residual : std::clamp(residual, -huber_limit, huber_limit);
  }

  std::vector<ChannelNoise> estimate_noise(const std::vector<UsedValue> &values, const std::vector<double> &residuals,
                                           const std::vector<double> &deviations, const IdentificationLoss loss,
                                           const std::size_t unknowns)
  {
    std::vector<ChannelNoise> result(deviations.size());
    for (std::size_t channel = 0; channel < result.size(); ++channel)
    {
      std::vector<std::vector<double>> strokes;
      std::vector<double> sizes;
      double squares = 0., influences = 0., slopes = 0.;
      for (std::size_t i = 0, last = values.size(); i < values.size(); ++i)
      {
        if (values[i].channel != channel)
          continue;
        if (last == values.size() || values[i].stroke != values[last].stroke)
          strokes.emplace_back();
        last                 = i;
        const double bounded = influence(loss, residuals[i]);
        strokes.back().push_back(bounded);
        sizes.push_back(std::abs(residuals[i]));
        squares += residuals[i] * residuals[i];
        influences += bounded * bounded;
        slopes += bounded == residuals[i] ? 1. : 0.;
      }
      auto &noise = result[channel];
      noise.rows  = static_cast<double>(sizes.size());
      if (sizes.empty())
        continue;
      noise.correlation = estimate_correlation(strokes, noise.rows);
      // Degrees of freedom: the fit uses as many independent rows as it has unknowns.
      const double fitted     = static_cast<double>(unknowns) * noise.correlation / static_cast<double>(values.size());
      const double free_share = 1. - std::min(fitted, 0.9);
      if (loss == IdentificationLoss::least_squares)
        noise.deviation = deviations[channel] * std::sqrt(squares / noise.rows / free_share);
      else
      {
        std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
        noise.deviation    = deviations[channel] * sizes[sizes.size() / 2] / 0.6745; // median of |x| for normal x, deviation 1
        const double share = slopes / noise.rows;
        noise.spread       = influences / noise.rows / free_share / (share * share);
      }
    }
    return result;
  }

  Uncertainty uncertainty(const std::vector<double> &jacobian, const std::vector<UsedValue> &values,
                          const std::vector<double> &influences, const std::vector<ChannelNoise> &noise,
                          const std::vector<UnknownNumber> &unknowns, const double confidence)
  {
    Uncertainty result;
    const auto n          = unknowns.size();
    result.singular       = singular_values(jacobian, n);
    auto covariances      = covariance(result.singular, values, noise, std::vector<double>(values.size(), 1.));
    const auto by_squares = covariance(result.singular, values, noise, noise_shares(values, influences, noise.size()));
    std::vector<double> wider; // by which a deviation is larger, as noise is larger where the unknown counts
    for (std::size_t i = 0; i < n; ++i)
      wider.push_back(std::sqrt(std::max(1., by_squares[i * n + i] / covariances[i * n + i])));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        covariances[i * n + j] *= wider[i] * wider[j];
    const double independent = sum_over(noise, [](const ChannelNoise &channel) { return channel.effective_rows(); });
    result.freedom           = std::max(1., independent - static_cast<double>(n));
    result.quantile          = boost::math::quantile(boost::math::students_t(result.freedom), 0.5 + 0.5 * confidence);
    result.correlation.resize(n * n);
    for (std::size_t i = 0; i < n; ++i)
    {
      result.deviations.push_back(std::sqrt(covariances[i * n + i]));
      for (std::size_t j = 0; j < n; ++j)
        result.correlation[i * n + j] = covariances[i * n + j] / std::sqrt(covariances[i * n + i] * covariances[j * n + j]);
    }
    add_indistinct(covariances, unknowns, result);
    if (result.indistinct.empty())
      add_weak(unknowns, result);
    result.singular.left.clear();
    return result;
  }
} // namespace sprag
