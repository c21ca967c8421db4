// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/stroke_errors.h"

#include "base/unknown.h"

#include <algorithm>
#include <cmath>
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
    std::vector<Stroke> strokes_of(const StrokeCurve &curve)
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

    /// None beyond the ends, but for round-off.
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

    /// Over the reference's peak.
    double error_of(const Stroke &stroke, const Stroke &reference, double StrokePoint::*force)
    {
      double peak = 0., largest = unknown;
      for (const auto &point : reference.points)
        peak = std::max(peak, std::abs(point.*force));
      for (const auto &point : stroke.points)
      {
        if (stroke.turned_at && std::abs(point.x - *stroke.turned_at) < left_out_behind_reversal)
          continue;
        if (const auto expected = value_at(reference.points, force, point.x))
        {
          const double difference = std::abs(point.*force - *expected);
          largest                 = std::isnan(largest) ? difference : std::max(largest, difference);
        }
      }
      return peak > 0. ? largest / peak : unknown;
    }
  } // namespace

  StrokeErrors stroke_errors(const StrokeCurve &curve, const StrokeCurve &reference)
  {
    const auto found = strokes_of(curve), expected = strokes_of(reference);
    if (found.empty() || found.size() != expected.size() || found.front().forward != expected.front().forward)
      return { unknown, unknown };
    StrokeErrors errors{ 0., 0. };
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const auto join = [&](double &error, double StrokePoint::*force)
      {
        const double more = error_of(found[i], expected[i], force);
        error             = std::isnan(more) || std::isnan(error) ? unknown : std::max(error, more);
      };
      join(errors.P, &StrokePoint::P);
      join(errors.Q, &StrokePoint::Q);
    }
    return errors;
  }
} // namespace sprag
