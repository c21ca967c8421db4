#include "run/transient_accuracy.h"

#include "analysis/accuracy/dilation.h"
#include "analysis/transient/growing_modes.h"
#include "analysis/transient/oscillation.h"
#include "base/errors.h"
#include "results/row_statistics.h"
#include "run/coarser_scene.h"
#include "run/slide_probes.h"
#include "scene/held_slide.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace sprag
{
  namespace
  {
    constexpr double rings = 0.1; ///< of the largest ringing, from which a row's step counts

    std::vector<ErrorEstimate> unknown(const std::string &reason)
    {
      std::vector<ErrorEstimate> result;
      for (const char *const quantity : { "P", "overshoot", "frequency", "growth_rate" })
        result.push_back({ quantity, "", {}, "No estimate: " + reason });
      return result;
    }

    double ringing(const Row &row)
    {
      return std::abs(row[Column::P] - row[Column::P_quasi_static]);
    }

    /// Rows behind the first reversal that ring.
    std::vector<Row> ringing_rows(const std::vector<Row> &rows, const Drive &drive)
    {
      std::vector<Row> behind;
      for (const Row &row : rows)
        if (row[Column::time] > drive.reversals().front())
          behind.push_back(row);
      const double size = largest(behind, ringing);
      std::vector<Row> result;
      std::copy_if(behind.begin(), behind.end(), std::back_inserter(result),
                   [&](const Row &row) { return ringing(row) >= rings * size; });
      return result;
    }

    /// The slide just behind the first reversal.
    Scene slide_behind_reversal(Scene scene)
    {
      const double time         = scene.drive.reversals().front();
      scene.stability.position  = scene.drive.at(time).x;
      const bool is_backward    = direction_of(scene.drive.at(time, Drive::Side::after).v) < 0;
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

    std::string why_not(const Scene &scene, const std::vector<Row> &rows)
    {
      if (scene.drive.reversals().empty())
        return "the drive does not turn, and nothing rings.";
      const auto is_open = [&](const Row &row)
      { return row[Column::time] > scene.drive.reversals().front() && row[Column::P] == 0.; };
      if (std::any_of(rows.begin(), rows.end(), is_open))
        return "the contact opens, and when it does depends on every small error.";
      if (!scene.mesh.file.empty() && is_meshed(scene.analysis.model))
        return "a mesh from a file has no coarser one to compare with. Run a finer mesh beside it.";
      return {};
    }

    std::vector<ErrorEstimate> estimates(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                         DynamicsMaker &maker)
    {
      const double measured = oscillations(rows, scene.drive).front().frequency;
      if (!(measured > 0.))
        return unknown("P does not ring behind the first reversal.");
      const Scene held        = slide_behind_reversal(scene);
      const auto found        = judge(held, maker);
      const auto frequency_of = [&](const SlideStability &slide)
      { return eigenvalue_near(slide, measured).imag() / (2. * M_PI); };
      const auto decay_of = [&](const SlideStability &slide) { return eigenvalue_near(slide, measured).real(); };
      if (!(frequency_of(found) > 0.) || !(decay_of(found) < 0.))
        return unknown("the slide behind the first reversal does not ring down.");
      const auto ringing   = ringing_rows(rows, scene.drive);
      const double dt      = sum(ringing, Column::time_step) / static_cast<double>(ringing.size());
      const double angle   = 2. * M_PI * frequency_of(found) * dt;
      const double radius  = scene.time.spectral_radius;
      const double slowing = std::abs(algorithmic_slowing(radius, angle));
      const double damping = algorithmic_damping(radius, angle);
      const double lag     = change_by_frequency(rows, scene.drive);
      const std::string step =
          scene.time.tolerance > 0. ? "Try a third of the Time/Tolerance." : "Try a Time/Step 0.7 times as large.";
      std::vector<ErrorPart> of_frequency, of_decay;
      if (is_meshed(scene.analysis.model))
      {
        const auto probes = probe_slide(held, dynamics.penalties, maker);
        of_frequency      = parts_of_slide(held, found, probes, frequency_of);
        of_decay          = parts_of_slide(held, found, probes, decay_of);
      }
      const double decay = std::abs(decay_of(found)) / (2. * M_PI * frequency_of(found));
      return { { "P", "its peak", with_step(times(of_frequency, lag), slowing * lag, step), {} },
               { "overshoot", "it", with_step(of_frequency, M_PI * damping, step), {} },
               { "frequency", "it", with_step(of_frequency, slowing, step), {} },
               { "growth_rate", "it", with_step(of_decay, damping / decay, step), {} } };
    }
  } // namespace

  std::vector<ErrorEstimate> transient_accuracy(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                                DynamicsMaker &maker)
  {
    if (const auto reason = why_not(scene, rows); !reason.empty())
      return unknown(reason);
    try
    {
      return estimates(scene, dynamics, rows, maker);
    }
    catch (const AnalysisError &error)
    {
      return unknown("in the comparison " + std::string(error.what()) + ".");
    }
  }
} // namespace sprag
