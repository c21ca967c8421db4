// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/dynamic_accuracy.h"

#include "analysis/accuracy/step_errors.h"
#include "analysis/transient/transient.h"
#include "analytic/oscillation.h"
#include "base/ranges.h"
#include "base/text.h"
#include "estimate/coarser_scene.h"
#include "fe/contact/face_contact_point.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <utility>

namespace sprag
{
  namespace
  {
    /// Shifts of the slide over the length of a face element, to see how far its place between the nodes matters.
    constexpr double face_shares[] = { 0., 0.25, 0.5, 0.75 };

    /// Modes that a lever with one alone is compared with.
    constexpr unsigned int several_modes = 4;

    constexpr double periods_before = 3.; ///< of the frequency of P, in which a swing before the reversal counts

    constexpr double too_far = 0.2; ///< relative change of a frequency, beyond which another vibration was compared

    constexpr double other_vibration = 0.04; ///< relative distance of a measured frequency from that of the slide, at least

    /// The slide of a scene by models that are less accurate, each in one respect, and at places between the nodes, its own
    /// first.
    struct SlideTrials
    {
      SlideStability soft;                       ///< with a third of the penalty
      std::optional<SlideStability> other_modes; ///< of a condensed lever with several, half of them
      std::vector<SlideStability> places;
      std::vector<SlideStability> other_mesh; ///< on the mesh of with_compared_mesh(), with as many modes as `other_modes`
    };

    /// Checks the slide of a meshed scene, see held_scene(), by these models; `found` is its own. The run's own mesh stays in the
    /// maker.
    SlideTrials run_slide_trials(const Scene &scene, const SlideStability &found, const ContactPenalties &penalties,
                                 DynamicsMaker &maker)
    {
      SlideTrials result;
      result.soft   = check_slide(with_penalties(scene, penalties, 1. / softer), maker);
      result.places = slides_over_face(scene, maker, &found);
      Scene other   = with_compared_mesh(with_penalties(scene, penalties, 1.));
      if (scene.analysis.model == ModelType::condensed && scene.condensed.modes > 1)
      {
        other.condensed.modes = scene.condensed.modes / 2;
        const auto dynamics   = maker.make(scene, other.condensed.modes);
        result.other_modes    = check_slide(dynamics.model(), held_drive(scene), checked_modes(scene));
      }
      else if (scene.analysis.model == ModelType::condensed)
      {
        other.condensed.modes = several_modes;
        Scene more            = scene;
        more.condensed.modes  = several_modes;
        DynamicsMaker finer_maker;
        result.other_modes = check_slide(more, finer_maker);
      }
      DynamicsMaker other_maker;
      result.other_mesh = slides_over_face(other, other_maker);
      return result;
    }

    double mean(const std::vector<SlideStability> &slides, const SlideValue &value)
    {
      return sum_over(slides, value) / static_cast<double>(slides.size());
    }

    /// Returns the parts of the error of the mean of a value over places between the nodes, relative to the value itself, from
    /// what the trial runs change by Richardson; what another number of modes changes counts whole.
    std::vector<ErrorPart> slide_error_parts(const Scene &scene, const SlideStability &found, const SlideTrials &trial_runs,
                                             const SlideValue &value)
    {
      const double size            = std::abs(value(found));
      const double soft            = value(trial_runs.soft) - value(found);
      const double more            = trial_runs.other_modes ? value(*trial_runs.other_modes) - value(found) : 0.;
      const double mesh            = mean(trial_runs.other_mesh, value) - more - mean(trial_runs.places, value);
      std::vector<ErrorPart> parts = { mesh_part(scene, std::abs(mesh) / size, force_order(scene)),
                                       penalty_part(scene, std::abs(soft) / size) };
      if (trial_runs.other_modes)
        parts.push_back({ "modes", std::abs(more) / size, "Try twice the Condensed/Modes." });
      return parts;
    }

    /// Adds to the part of the mesh how far the value scatters over these places.
    std::vector<ErrorPart> with_place(std::vector<ErrorPart> parts, const SlideStability &found, const SlideTrials &trial_runs,
                                      const SlideValue &value)
    {
      parts.front().value += scatter(trial_runs.places, value) / std::abs(value(found));
      return parts;
    }

    /// The slide just behind the first reversal.
    Scene slide_behind_reversal(Scene scene)
    {
      const double time         = scene.drive.reversals().front();
      scene.stability.position  = scene.drive.at(time).x;
      const bool is_backward    = drive_direction(scene.drive.at(time, Drive::Side::after).v) < 0;
      scene.stability.direction = is_backward ? Direction::backward : Direction::forward;
      return held_scene(with_condensed_lever(scene));
    }

    /// Half the largest swing of P in the last `duration` before the first reversal begins [N]: elements that pass under the
    /// contact near the frequency of P, or a slide that grows, let it vibrate.
    double swing_before_reversal(const std::vector<Row> &rows, const Drive &drive, const double duration)
    {
      const double end  = drive.reversals().front() - 0.5 * drive.reversal_duration();
      const auto counts = [&](const Row &row) { return row[Column::time] <= end && row[Column::time] >= end - duration; };
      return largest_swing(filtered(rows, counts), {}, 0.).size;
    }

    /// Returns the end of the stroke behind the first reversal [s].
    double first_stroke_end(const Drive &drive)
    {
      const auto &turns = drive.reversals();
      return turns.size() > 1 ? turns[1] - 0.5 * drive.reversal_duration() : drive.duration();
    }

    std::vector<ErrorPart> times(std::vector<ErrorPart> parts, const double factor)
    {
      for (auto &part : parts)
        part.value *= factor;
      return parts;
    }

    std::vector<ErrorPart> with_part(std::vector<ErrorPart> parts, const ErrorPart &part)
    {
      parts.push_back(part);
      return parts;
    }

    void require_closed_contact(const Scene &scene, const std::vector<Row> &rows)
    {
      if (scene.drive.reversals().empty())
        throw NoEstimate{ "the drive does not turn." };
      const auto is_open = [&](const Row &row) {
        return row[Column::time] > scene.drive.reversals().front() &&
               (row[Column::P] == 0. || row.lever_value(Column::P, 1) == 0.);
      };
      if (std::any_of(rows.begin(), rows.end(), is_open))
        throw NoEstimate{ "the contact opens, and when it does depends on every small error." };
    }

    /// Throws where the contact is too narrow for its mesh, however large P is behind the reversal.
    void require_wide_contact(const Scene &scene, const std::vector<Row> &rows)
    {
      const auto behind =
          filtered(rows, [turn = scene.drive.reversals().front()](const Row &row) { return row[Column::time] > turn; });
      if (is_narrower_than_faces(scene, largest(behind, Column::contact_width)))
        throw NoEstimate{ "the contact is narrower than the faces, so that its stiffness follows no power of their size." };
    }

    std::vector<ErrorEstimate> estimates(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &all_rows,
                                         DynamicsMaker &maker)
    {
      require_closed_contact(scene, all_rows);
      const auto turned = oscillations(all_rows, scene.drive).front();
      const auto rows   = lever_rows(all_rows, turned.lever == 2. ? 1 : 0);
      if (is_meshed(scene.analysis.model))
        require_wide_contact(scene, rows);
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
      const double turn      = scene.drive.reversals().front();
      const double omega     = 2. * M_PI * slide_frequency(found);
      const auto step_errors = [&](const double at, const double end)
      {
        return estimate_step_errors(rows, turn, end,
                                    [&](const double dt)
                                    { return std::abs(algorithmic_frequency_error(scene.time.spectral_radius, at * dt)); });
      };
      // Behind a reversal P rings faster than what lasts on a soft support. The delay grows with time: in a ringing that decays
      // as exp(-d t) it counts most at 1/d, be that beyond the window.
      const auto fast       = eigenvalue_near(found, std::fmax(measured, turned.first_frequency));
      const double fastest  = fast.imag();
      const auto errors     = step_errors(omega, turned.window_end);
      const double fast_end = std::max(fastest > omega ? turned.window_begin + least_window : turned.window_end,
                                       std::min(first_stroke_end(scene.drive), turn - 1. / fast.real()));
      const auto fast_errors = step_errors(fastest, fast_end);
      const double peak      = largest(rows, Column::P);
      const double lag       = change_by_frequency(rows, turn, fast_end) / peak;
      const auto step        = [&](const double value)
      {
        return ErrorPart{ "step", value,
                          scene.time.tolerance > 0. ? "Try a third of the Time/Tolerance."
                                                    : "Try a Time/Step 0.7 times as large." };
      };
      const auto vibration = [&](const double value)
      {
        return ErrorPart{ "vibration", value,
                          is_meshed(scene.analysis.model)
                              ? "P vibrates before the reversal. Try a Mesh/Face size 0.7 times as large."
                              : "No setting reduces it: P vibrates before the reversal." };
      };
      std::vector<ErrorPart> frequency_parts, decay_parts, overshoot_parts;
      if (is_meshed(scene.analysis.model))
      {
        const auto trial_runs = run_slide_trials(held, found, dynamics.penalties, maker);
        frequency_parts       = slide_error_parts(held, found, trial_runs, slide_frequency);
        decay_parts           = slide_error_parts(held, found, trial_runs, decay_rate);
        overshoot_parts       = times(with_place(frequency_parts, found, trial_runs, slide_frequency), 2.);
      }
      for (const auto &part : overshoot_parts)
        if (!(part.value < 2. * too_far))
          throw NoEstimate{ "with another " + part.name + (part.name == "mesh" ? ", or elsewhere between its nodes," : "") +
                            " the slide behind the first reversal has no vibration of this frequency." };
      const double peak_angle   = fastest * errors.peak_step;
      const double between_rows = 1. - std::cos(0.5 * peak_angle); // of a peak
      const double at_overshoot =
          2. * std::abs(algorithmic_frequency_error(scene.time.spectral_radius, peak_angle)) + between_rows;
      ErrorEstimate decay{ "decay", "", {}, "No estimate: P does not decay in the window behind the first reversal." };
      if (const double fitted = -turned.growth_rate; fitted > 0.)
      {
        const double scheme = algorithmic_damping(scene.time.spectral_radius, omega * errors.peak_step);
        decay               = { "decay", "it", with_part(decay_parts, step(scheme * omega / fitted)), {} };
        // Passing elements keep the envelope up, to which the decay is fitted; the slide's own decay knows neither.
        decay.parts.push_back({ "fit", std::abs(decay_rate(found) / fitted - 1.),
                                is_meshed(scene.analysis.model)
                                    ? "Try a Mesh/Face size 0.5 times as large."
                                    : "No setting reduces it: over the window the decay is not that of a single slide." });
      }
      // See the header: a sinusoid of amplitude a has the root mean square a/sqrt(2), its integral over the window is as a T,
      // that of the ringing as excess/decay.
      const double swing  = swing_before_reversal(rows, scene.drive, periods_before / measured);
      const double excess = turned.overshoot_P * turned.scale;
      const double window = turned.window_end - turned.window_begin;
      const double weight = swing > 0. ? swing * window / (swing * window + excess / decay_rate(found)) : 0.;
      const double apart  = std::abs(measured / slide_frequency(found) - 1.);
      const double share  = apart > other_vibration ? 1. : weight; // of both in what was measured
      const auto add_both = [&](const std::vector<ErrorPart> &parts, const double by_step, const double by_vibration)
      { return with_part(with_part(parts, step(by_step)), vibration(by_vibration)); };
      ErrorEstimate overshoot{ "overshoot", "", {}, "No estimate: P does not overshoot." };
      if (excess > 0.)
        overshoot = { "overshoot", "it", add_both(overshoot_parts, at_overshoot, M_SQRT1_2 * swing / excess), {} };
      const double largest_before = swing_before_reversal(rows, scene.drive, window);
      const bool goes_on          = turned.verdict == Verdict::grows || turned.verdict == Verdict::sticks_and_slips;
      ErrorEstimate P{ "P", "", {}, "No estimate: P vibrates on behind the first reversal, and errors grow with it." };
      if (!goes_on)
        P = { "P", "its peak", add_both(times(frequency_parts, lag), fast_errors.P / peak, largest_before / peak), {} };
      return { P, overshoot, { "frequency", "it", add_both(frequency_parts, errors.frequency, share * apart), {} }, decay };
    }
  } // namespace

  std::vector<SlideStability> slides_over_face(const Scene &scene, DynamicsMaker &maker, const SlideStability *const known)
  {
    const Scene held    = held_scene(scene);
    const auto dynamics = maker.make(held);
    std::vector<SlideStability> result;
    for (const double share : face_shares)
    {
      if (known != nullptr && share == 0.)
      {
        result.push_back(*known);
        continue;
      }
      DrivePoint drive  = held_drive(scene);
      const double away = share * scene.mesh.face_size;
      drive.x += drive.x - away > scene.drive.minimum() ? -away : away;
      if (auto slide = check_slide(dynamics.model(), drive, checked_modes(held)); slide.slide)
        result.push_back(std::move(slide));
    }
    return result;
  }

  double scatter(const std::vector<SlideStability> &places, const SlideValue &value)
  {
    const double middle = mean(places, value);
    return root_mean_square(mapped(places, [&](const auto &slide) { return value(slide) - middle; }));
  }

  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker)
  {
    if (!is_meshed(scene.analysis.model))
      return {};
    if (scene.analysis.model == ModelType::finite_element)
    {
      // The condensed lever of the mesh has these errors, but for those of its modes.
      const auto condensed = with_condensed_lever(scene);
      auto estimates       = vibration_accuracy(condensed, check_slide(condensed, maker), dynamics, maker);
      for (auto &estimate : estimates)
        estimate.parts = filtered(estimate.parts, [](const ErrorPart &part) { return part.name != "modes"; });
      return estimates;
    }
    const auto estimate = [&]
    {
      if (!(found.frequency() > 0.))
        throw NoEstimate{ "the mode that grows most does not oscillate." };
      const auto trial_runs      = run_slide_trials(scene, found, dynamics.penalties, maker);
      const SlideValue frequency = [](const SlideStability &slide) { return slide.frequency(); };
      const SlideValue growth    = [](const SlideStability &slide) { return slide.growth_rate(); };
      if (!(mean(trial_runs.other_mesh, frequency) > 0.) || !(frequency(trial_runs.soft) > 0.))
        throw NoEstimate{ "on another mesh or with a softer penalty the mode that grows most does not oscillate." };
      const auto parts = [&](const SlideValue &value)
      { return with_place(slide_error_parts(scene, found, trial_runs, value), found, trial_runs, value); };
      auto frequency_parts = parts(frequency);
      const double jump    = largest(joined(trial_runs.places, trial_runs.other_mesh),
                                     [&](const auto &slide) { return frequency(slide) / frequency(found) - 1.; });
      if (jump > too_far) // another mode grows most there
        frequency_parts.front().value = jump;
      return std::vector<ErrorEstimate>{ { "growth_rate", "it, and beyond 100 % the verdict may flip", parts(growth), {} },
                                         { "frequency", "it", frequency_parts, {} } };
    };
    return estimates_or_reason(scene, { "growth_rate", "frequency" }, estimate);
  }

  std::vector<ErrorEstimate> transient_accuracy(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                                DynamicsMaker &maker)
  {
    return estimates_or_reason(scene, { "P", "overshoot", "frequency", "decay" },
                               [&] { return estimates(scene, dynamics, rows, maker); });
  }
} // namespace sprag
