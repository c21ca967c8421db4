// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/transient_accuracy.h"

#include "analysis/accuracy/dilation.h"
#include "analysis/transient/growing_modes.h"
#include "analytic/oscillation.h"
#include "base/text.h"
#include "estimate/coarser_scene.h"
#include "estimate/vibration_accuracy.h"
#include "results/row_statistics.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace sprag
{
  namespace
  {
    // Below so many faces in contact the overshoot hangs on where between two nodes the drive turns. Faces of 1 mm under a
    // contact of 2.6 mm change that of model A by 15 %, faces of 0.75 mm under one of 1.8 mm that of model B by 29 %.
    constexpr double fewest_faces  = 3.5;
    constexpr double by_place      = 0.7; ///< over the faces in contact
    constexpr double most_by_place = 0.4;

    constexpr double too_far = 0.2; ///< relative change of a frequency, beyond which another vibration was compared

    /// The slide just behind the first reversal.
    Scene slide_behind_reversal(Scene scene)
    {
      const double time         = scene.drive.reversals().front();
      scene.stability.position  = scene.drive.at(time).x;
      const bool is_backward    = drive_direction(scene.drive.at(time, Drive::Side::after).v) < 0;
      scene.stability.direction = is_backward ? Direction::backward : Direction::forward;
      if (scene.analysis.model == ModelType::finite_element)
        scene.analysis.model = ModelType::condensed;
      return held_scene(scene);
    }

    /// The vibration of a slide that is nearest to a frequency [Hz].
    std::complex<double> eigenvalue_near(const SlideStability &slide, const double frequency)
    {
      std::complex<double> result = std::nan("");
      for (const auto &mode : slide.modes)
        if (const auto lambda = mode.mode.eigenvalue;
            !(std::abs(lambda.imag() / (2. * M_PI) - frequency) >= std::abs(result.imag() / (2. * M_PI) - frequency)))
          result = lambda;
      return result;
    }

    std::vector<ErrorPart> times(std::vector<ErrorPart> parts, const double factor)
    {
      for (auto &part : parts)
        part.value *= factor;
      return parts;
    }

    std::vector<ErrorPart> with_step(std::vector<ErrorPart> parts, const double value, const std::string &remedy)
    {
      parts.push_back({ "step", value, remedy });
      return parts;
    }

    void require_closed_contact(const Scene &scene, const std::vector<Row> &rows)
    {
      if (scene.drive.reversals().empty())
        throw NoEstimate{ "the drive does not turn." };
      const auto is_open = [&](const Row &row)
      { return row[Column::time] > scene.drive.reversals().front() && row[Column::P] == 0.; };
      if (std::any_of(rows.begin(), rows.end(), is_open))
        throw NoEstimate{ "the contact opens, and when it does depends on every small error." };
    }

    std::vector<ErrorEstimate> estimates(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                         DynamicsMaker &maker)
    {
      require_closed_contact(scene, rows);
      const auto turned     = oscillations(rows, scene.drive).front();
      const double measured = turned.frequency;
      if (!(measured > 0.))
        throw NoEstimate{ "P does not ring behind the first reversal." };
      const Scene held           = slide_behind_reversal(scene);
      const auto found           = check_slide(held, maker);
      const auto slide_frequency = [&](const SlideStability &slide)
      { return eigenvalue_near(slide, measured).imag() / (2. * M_PI); };
      const auto decay_rate = [&](const SlideStability &slide) { return -eigenvalue_near(slide, measured).real(); };
      if (!(slide_frequency(found) > 0.) || !(eigenvalue_near(found, measured).real() < 0.))
        throw NoEstimate{ "the slide behind the first reversal does not ring down." };
      const double turn  = scene.drive.reversals().front();
      const double omega = 2. * M_PI * slide_frequency(found);
      const auto by_step = [&](const double dt) { return std::abs(algorithmic_slowing(scene.time.spectral_radius, omega * dt)); };
      const auto slowing = estimate_slowing(rows, turn, turned.window_end, 1. / slide_frequency(found), by_step);
      const double lag   = change_by_frequency(rows, turn, turned.window_end) / largest(rows, Column::P);
      const std::string step =
          scene.time.tolerance > 0. ? "Try a third of the Time/Tolerance." : "Try a Time/Step 0.7 times as large.";
      std::vector<ErrorPart> frequency_parts, decay_parts;
      if (is_meshed(scene.analysis.model))
      {
        const auto trial_runs = run_slide_trials(held, dynamics.penalties, maker);
        frequency_parts       = slide_error_parts(held, found, trial_runs, slide_frequency);
        decay_parts           = slide_error_parts(held, found, trial_runs, decay_rate);
      }
      for (const auto &part : frequency_parts)
        if (!(part.value < too_far))
          throw NoEstimate{ "with another " + part.name + (part.name == "mesh" ? ", or elsewhere between its nodes," : "") +
                            " the slide behind the first reversal has no vibration of this frequency." };
      const double between_rows = 1. - std::cos(0.5 * omega * slowing.first_step); // of a peak
      const double first_swing  = 2. * by_step(slowing.first_step) + between_rows;
      const double faces        = largest(rows, Column::contact_width) / scene.mesh.face_size;
      ErrorEstimate decay{ "decay", "", {}, "No estimate: P does not decay in the window behind the first reversal." };
      if (const double fitted = -turned.growth_rate; fitted > 0.)
      {
        const double scheme = algorithmic_damping(scene.time.spectral_radius, omega * slowing.first_step);
        decay               = { "decay", "it", with_step(decay_parts, scheme * omega / fitted, step), {} };
        // Steps and passing elements keep the envelope up, to which the decay is fitted; the slide's own decay knows neither.
        decay.parts.push_back({ "fit", std::abs(decay_rate(found) / fitted - 1.), step });
      }
      ErrorEstimate overshoot{ "overshoot", "it", with_step(times(frequency_parts, 2.), first_swing, step), {} };
      if (is_meshed(scene.analysis.model) && faces < fewest_faces)
        overshoot.parts.push_back({ "turn", std::min(most_by_place, by_place / faces), "Try a smaller Mesh/Face size." });
      return { { "P", "its peak", with_step(times(frequency_parts, lag), slowing.P / largest(rows, Column::P), step), {} },
               overshoot,
               { "frequency", "it", with_step(frequency_parts, slowing.frequency, step), {} },
               decay };
    }
  } // namespace

  std::vector<ErrorEstimate> transient_accuracy(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                                DynamicsMaker &maker)
  {
    return estimates_or_reason(scene, { "P", "overshoot", "frequency", "decay" },
                               [&] { return estimates(scene, dynamics, rows, maker); });
  }
} // namespace sprag
