// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/growing_modes.h"

#include "base/eigenvalues.h"
#include "base/errors.h"
#include "base/text.h"
#include "model/step/generalised_alpha.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sprag
{
  namespace
  {
    const double least_growth           = std::log(1000.); ///< of the logarithm of an amplitude within a stroke
    constexpr double tolerated_damping  = 0.1;             ///< over the growth
    constexpr double largest_angle      = 1.;              ///< of a step [rad]
    constexpr unsigned int even_samples = 4;               ///< of a cycle
    constexpr double beyond_reversal    = 0.75;            ///< of its duration, from the turning point

    double first_cycle_end(const Drive &drive)
    {
      return drive.reversals().size() > 1 ? drive.reversals()[1] : drive.duration();
    }

    /// Evenly over the first cycle and on both sides of its reversal.
    std::vector<double> sample_times(const Drive &drive)
    {
      const double end = first_cycle_end(drive);
      std::vector<double> times;
      for (unsigned int i = 0; i < even_samples; ++i)
        times.push_back((i + 0.5) / even_samples * end);
      if (!drive.reversals().empty())
      {
        const double aside = std::max(beyond_reversal * drive.reversal_duration(), 1e-3 * end);
        for (const double time : { drive.reversals().front() - aside, drive.reversals().front() + aside })
          if (time > 0. && time < end)
            times.push_back(time);
      }
      return times;
    }

    std::optional<GrowingMode> fastest_growing(DynamicModel &model, const DrivePoint &drive)
    {
      try
      {
        const auto slide = model.hold(drive, ContactFriction::sliding);
        if (!slide || !(slide->uniqueness > 0.) || !(slide->forces.P > 0.))
          return {};
        std::optional<GrowingMode> fastest;
        for (const auto lambda : model.eigenvalues(*slide, 1))
          if (lambda.imag() > 0. && lambda.real() > 0. && (!fastest || lambda.real() > fastest->growth_rate))
            fastest = GrowingMode{ drive.x, drive.v, lambda.real(), lambda.imag() / (2. * M_PI) };
        return fastest;
      }
      catch (const AnalysisError &)
      {
        return {};
      }
    }

    /// One step of generalised-alpha for q'' = -q, in (q, dt q', dt^2 q'').
    dealii::FullMatrix<double> amplification(const StepWeights &w, const double angle)
    {
      const double square             = angle * angle;
      const double share              = 1. / (1. - w.alpha_m + (1. - w.alpha_f) * w.beta * square);
      const double acceleration_row[] = { -square * share, -(1. - w.alpha_f) * square * share,
                                          -(w.alpha_m + (1. - w.alpha_f) * square * (0.5 - w.beta)) * share };
      const double drift[2][3]        = { { 1., 1., 0.5 - w.beta }, { 0., 1., 1. - w.gamma } };
      const double weight[]           = { w.beta, w.gamma };
      dealii::FullMatrix<double> matrix(3, 3);
      for (unsigned int j = 0; j < 3; ++j)
      {
        for (unsigned int i = 0; i < 2; ++i)
          matrix(i, j) = drift[i][j] + weight[i] * acceleration_row[j];
        matrix(2, j) = acceleration_row[j];
      }
      return matrix;
    }

    /// The eigenvalue of such a step that turns, with the positive imaginary part: of its three roots two are the vibration's.
    std::complex<double> step_root(const double spectral_radius, const double angle)
    {
      std::complex<double> result = 0.;
      for (const auto &root : eigenpairs(amplification(generalised_alpha(spectral_radius, 1.), angle)))
        if (root.value.imag() > 0. && std::abs(root.value) > std::abs(result))
          result = root.value;
      return result;
    }

    double longest_step(const GrowingMode &mode, const double spectral_radius)
    {
      const double omega = 2. * M_PI * mode.frequency;
      const double limit = tolerated_damping * mode.growth_rate / omega;
      double shortest = 0., longest = largest_angle;
      if (algorithmic_damping(spectral_radius, longest) <= limit)
        return longest / omega;
      for (unsigned int i = 0; i < 40; ++i)
      {
        const double middle                                                          = 0.5 * (shortest + longest);
        (algorithmic_damping(spectral_radius, middle) <= limit ? shortest : longest) = middle;
      }
      return longest / omega;
    }
  } // namespace

  std::vector<GrowingMode> growing_modes(DynamicModel &model, const Drive &drive)
  {
    const double stroke = first_cycle_end(drive) / (drive.reversals().empty() ? 1. : 2.);
    std::vector<GrowingMode> result;
    for (const double time : sample_times(drive))
    {
      const auto point = drive.at(time, Drive::Side::after);
      if (point.v == 0.)
        continue;
      if (const auto mode = fastest_growing(model, point); mode && mode->growth_rate * stroke > least_growth)
        result.push_back(*mode);
    }
    return result;
  }

  double algorithmic_damping(const double spectral_radius, const double angle)
  {
    const double size = std::abs(step_root(spectral_radius, angle));
    return size > 0. ? std::max(0., -std::log(size) / angle) : std::numeric_limits<double>::infinity();
  }

  double algorithmic_slowing(const double spectral_radius, const double angle)
  {
    return angle > 0. ? 1. - std::arg(step_root(spectral_radius, angle)) / angle : 0.;
  }

  double longest_step(const std::vector<GrowingMode> &modes, const double spectral_radius)
  {
    double result = std::numeric_limits<double>::infinity();
    for (const auto &mode : modes)
      result = std::min(result, longest_step(mode, spectral_radius));
    return result;
  }

  Warnings hidden_vibration_warnings(const std::vector<GrowingMode> &modes, const TimeSettings &time)
  {
    if (modes.empty() || time.tolerance > 0. || time.step <= longest_step(modes, time.spectral_radius))
      return {};
    const auto worst   = std::min_element(modes.begin(), modes.end(),
                                          [&](const GrowingMode &a, const GrowingMode &b) {
                                          return longest_step(a, time.spectral_radius) < longest_step(b, time.spectral_radius);
                                        });
    const double limit = longest_step(*worst, time.spectral_radius);
    return { { "hidden_vibration",
               "The slide at x = " + mm(worst->x) + " vibrates by itself at " + rounded_text(worst->frequency) +
                   " Hz, growing by " + rounded_text(worst->growth_rate) + " 1/s, and Time/Step = " + rounded_text(time.step) +
                   " s damps that by more than a tenth of its growth: steps of up to " + rounded_text(limit) + " s do not.",
               "P, Q and their peaks lack that vibration: the run models none above " +
                   rounded_text(largest_angle / (2. * M_PI * time.step)) + " Hz.",
               "Leave Time/Step out, so that steps adapt, or give one of " + rounded_text(limit) + " s or less." } };
  }
} // namespace sprag
