// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/one_more_unknown.h"

#include "scene/identification_text.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double explains     = 0.8;  ///< of the squares of residuals beyond the noise, from which an unknown is named
    constexpr double small_change = 1e-4; ///< change of a lever by which derivatives are found, relative

    /// A change of the lever, or of what a channel shows of it.
    struct Candidate
    {
      OneMoreUnknown unknown;
      IdentifiedLever lever; ///< changed by `by`
      double by;
      bool scales_Q = false; ///< by 1 + `by`
    };

    std::vector<Candidate> candidates(const Scene &scene, const IdentifiedLever &lever)
    {
      const auto &settings = scene.identification;
      const auto is_sought = [&](const Unknown unknown)
      { return std::find(settings.sought.begin(), settings.sought.end(), unknown) != settings.sought.end(); };
      std::vector<Candidate> result;
      const double dR = small_change * lever.geometry.cylinder_radius;
      result.push_back({ { "Geometry/Cylinder radius", "mm", 0., 0. }, lever, dR });
      result.back().lever.geometry.cylinder_radius += dR;
      for (std::size_t i = 0; i < settings.measured.channels.size(); ++i)
      {
        const auto &channel = settings.measured.channels[i];
        const auto word     = word_for(force_words(), channel.force);
        if (channel.force == MeasuredForce::drive)
          result.push_back({ { "the scale of " + word, "1", 0., 0. }, lever, 1., true });
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

    /// Takes off what the columns of an orthonormal basis, row by row, have of a vector.
    std::vector<double> beside(const std::vector<double> &basis, std::vector<double> vector)
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
      double sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }
  } // namespace

  namespace
  {
    /// The squares that residuals would have if only the noise of neighbouring values were left, by second differences.
    double squares_of_noise(const std::vector<UsedValue> &used, const std::vector<double> &residuals, const std::size_t channels)
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
  } // namespace

  std::vector<OneMoreUnknown> more_unknowns(const Scene &scene, const StrokeFit &fit, const Identification &found,
                                            const std::vector<double> &deviations, const std::vector<double> &jacobian)
  {
    const auto &channels     = scene.identification.measured.channels;
    const std::size_t sought = found.used.empty() ? 0 : jacobian.size() / found.used.size();
    const auto basis         = singular_values(jacobian, sought).left;
    /// Returns the value that a channel shows of a lever, over its deviation; NaN where the lever has no slide.
    const auto shown = [&](const Candidate &candidate, const UsedValue &value)
    {
      const auto slide   = fit.slide(candidate.lever, found.correction, value.row, value.stroke);
      const bool is_Q    = channels[value.channel].force == MeasuredForce::drive;
      const double force = slide ? fit.shown(candidate.lever, *slide, value.channel) : std::nan("");
      return (candidate.scales_Q && is_Q ? (1. + candidate.by) * force : force) / deviations[value.channel];
    };
    const Candidate own{ {}, found.lever, 1. };
    std::vector<double> residuals;
    for (const auto &value : found.used)
      residuals.push_back(value.value / deviations[value.channel] - shown(own, value));
    const double noise   = squares_of_noise(found.used, residuals, channels.size());
    residuals            = beside(basis, residuals);
    const double squares = product(residuals, residuals) - noise;
    std::vector<OneMoreUnknown> result;
    for (auto &candidate : candidates(scene, found.lever))
    {
      std::vector<double> change;
      for (const auto &value : found.used)
        change.push_back((shown(candidate, value) - shown(own, value)) / candidate.by);
      change              = beside(basis, change);
      const double length = product(change, change), along = product(change, residuals);
      candidate.unknown.change = along / length;
      candidate.unknown.share  = along * along / (length * squares);
      if (squares > 0. && candidate.unknown.share > explains) // false for NaN
        result.push_back(candidate.unknown);
    }
    return result;
  }
} // namespace sprag
