// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/measures.h"

#include "base/pattern.h"
#include "base/ranges.h"
#include "base/unknown.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace sprag
{
  namespace
  {
    struct Stroke
    {
      bool forward;
      std::optional<double> turned_at; ///< x of the reversal before it
      StrokeCurve points;              ///< by increasing x
    };

    /// Rests and repeated places stay as they are.
    std::vector<Stroke> split_strokes(const StrokeCurve &curve)
    {
      std::vector<Stroke> strokes;
      for (std::size_t i = 0; i < curve.size(); ++i)
      {
        const bool forward = curve[i].direction >= 0.;
        if (strokes.empty() || strokes.back().forward != forward)
          strokes.push_back({ forward, i > 0 ? std::make_optional(curve[i - 1].x) : std::nullopt, {} });
        strokes.back().points.push_back(curve[i]);
      }
      for (auto &stroke : strokes)
        std::stable_sort(stroke.points.begin(), stroke.points.end(),
                         [](const StrokePoint &a, const StrokePoint &b) { return a.x < b.x; });
      return strokes;
    }

    /// Returns a force at x; none beyond the ends, but for round-off.
    std::optional<double> value_at(const StrokeCurve &points, double StrokePoint::*force, const double x)
    {
      const double margin = 1e-9 * (1. + std::abs(x));
      if (x < points.front().x - margin || x > points.back().x + margin)
        return {};
      const auto high = std::lower_bound(points.begin(), points.end(), x,
                                         [](const StrokePoint &point, const double at) { return point.x < at; });
      if (high == points.begin())
        return points.front().*force;
      if (high == points.end())
        return points.back().*force;
      const auto low     = high - 1;
      const double share = (x - low->x) / (high->x - low->x);
      return (1. - share) * ((*low).*force) + share * ((*high).*force);
    }

    /// Returns the largest difference over the reference's peak, without the first `left_out` behind a reversal.
    double compute_error(const Stroke &stroke, const Stroke &reference, double StrokePoint::*force, const double left_out)
    {
      const double peak = largest(reference.points, [force](const auto &point) { return point.*force; });
      double largest    = unknown;
      for (const auto &point : stroke.points)
      {
        if (stroke.turned_at && std::abs(point.x - *stroke.turned_at) < left_out)
          continue;
        if (const auto expected = value_at(reference.points, force, point.x))
        {
          const double difference = std::abs(point.*force - *expected);
          largest                 = std::isnan(largest) ? difference : std::max(largest, difference);
        }
      }
      return peak > 0. ? largest / peak : unknown;
    }

    /// A quantity that stands in one or several entries of a summary.
    struct Compared
    {
      std::string name;
      std::string pattern; ///< of the entries' names
    };

    const std::vector<Compared> &compared_entries(const AnalysisType type)
    {
      static const std::map<AnalysisType, std::vector<Compared>> all = {
        { AnalysisType::quasi_static, { { "loop_area", "loop_area" }, { "largest_pressure", "largest_pressure" } } },
        { AnalysisType::transient,
          { { "peak_P", "peak_P_(forward|backward)" },
            { "peak_Q", "peak_Q_(forward|backward)" },
            { "frequency", "reversal_[0-9]+_frequency" },
            { "largest_pressure", "largest_pressure" } } },
        { AnalysisType::modal, { { "frequency", "frequency_[0-9]+" } } },
        { AnalysisType::stability, { { "growth_rate", "growth_rate" }, { "frequency", "frequency" } } },
        { AnalysisType::sprag_slip,
          { { "growth_rate", "measured_growth_rate" },
            { "frequency", "measured_frequency" },
            { "cycle_amplitude", "cycle_amplitude_P" },
            { "cycle_frequency", "cycle_frequency" } } },
        { AnalysisType::isolation,
          { { "transmissibility", "transmissibility_(peak|fundamental|rms)" },
            { "displacement", "largest_displacement" },
            { "dissipated_energy", "dissipated_energy" } } },
        { AnalysisType::contact_law, { { "stiffness", "stiffness" }, { "exponent", "exponent" } } },
        { AnalysisType::calibration,
          { { "stiffness", "stiffness" },
            { "moment_of_inertia", "moment_of_inertia" },
            { "bending_stiffness", "bending_stiffness" },
            { "contact_stiffness", "contact_stiffness" } } },
      };
      static const std::vector<Compared> none;
      const auto found = all.find(type);
      return found == all.end() ? none : found->second;
    }

    std::optional<double> find_number(const std::vector<Entry> &summary, const std::string &name)
    {
      const auto *const entry    = find_by(summary, &Entry::name, name);
      const double *const number = entry != nullptr ? std::get_if<double>(&entry->value) : nullptr;
      return number != nullptr && std::isfinite(*number) ? std::make_optional(*number) : std::nullopt;
    }

    /// The entries of a quantity that have a number to compare with.
    std::vector<std::string> entry_names(const Compared &compared, const std::vector<Entry> &summary)
    {
      std::vector<std::string> names;
      for (const auto &entry : summary)
        if (matches(entry.name, compared.pattern))
          if (const auto number = find_number(summary, entry.name); number && *number != 0.)
            names.push_back(entry.name);
      return names;
    }

    /// The largest of a quantity's entries.
    double compute_error(const std::vector<std::string> &entries, const std::vector<Entry> &summary,
                         const std::vector<Entry> &reference)
    {
      double largest = 0.;
      for (const auto &name : entries)
      {
        const auto number = find_number(summary, name);
        if (!number)
          return unknown;
        const double expected = *find_number(reference, name);
        largest               = std::max(largest, std::abs((*number - expected) / expected));
      }
      return largest;
    }
  } // namespace

  StrokeErrors stroke_errors(const StrokeCurve &curve, const StrokeCurve &reference)
  {
    const auto found = split_strokes(curve), expected = split_strokes(reference);
    if (found.empty() || found.size() != expected.size() || found.front().forward != expected.front().forward)
      return { unknown, unknown };
    StrokeErrors errors{ 0., 0. };
    const double left_out = left_out_behind_reversal * largest(reference, [](const auto &point) { return point.x; });
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const auto join = [&](double &error, double StrokePoint::*force)
      {
        const double more = compute_error(found[i], expected[i], force, left_out);
        error             = std::isnan(more) || std::isnan(error) ? unknown : std::max(error, more);
      };
      join(errors.P, &StrokePoint::P);
      join(errors.Q, &StrokePoint::Q);
    }
    return errors;
  }

  std::vector<Measure> make_measures(const AnalysisType type, const Comparable &reference)
  {
    std::vector<Measure> measures;
    if (!reference.curve.empty())
    {
      const std::string meaning =
          ": largest difference on both strokes over the reference's peak of the stroke, the first 0.5 mm "
          "after a reversal apart";
      measures = { { "P", "P" + meaning }, { "Q", "Q" + meaning } };
    }
    for (const auto &compared : compared_entries(type))
      if (const auto entries = entry_names(compared, reference.summary); !entries.empty())
        measures.push_back({ compared.name, (entries.size() > 1 ? "worst of " : "") + entries.front() +
                                                (entries.size() > 1 ? " ... " + entries.back() : "") });
    return measures;
  }

  std::vector<double> compute_errors(const AnalysisType type, const Comparable &run, const Comparable &reference)
  {
    std::vector<double> errors;
    if (!reference.curve.empty())
    {
      const auto [P, Q] = stroke_errors(run.curve, reference.curve);
      errors            = { P, Q };
    }
    for (const auto &compared : compared_entries(type))
      if (const auto entries = entry_names(compared, reference.summary); !entries.empty())
        errors.push_back(compute_error(entries, run.summary, reference.summary));
    return errors;
  }
} // namespace sprag
