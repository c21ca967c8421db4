// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/measured_motion.h"

#include "base/least_squares.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double least_turn         = 0.02; ///< of the whole range
    constexpr std::size_t lines_a_way   = 40;   ///< of a stroke, by which speeds are smoothed
    constexpr std::size_t most_each_way = 50;   ///< rows of such a line

    double cubic(const double share, const double step, const double from, const double to, const double v_from,
                 const double v_to)
    {
      const double s = share;
      return (1. + 2. * s) * (1. - s) * (1. - s) * from + s * s * (3. - 2. * s) * to +
             step * (s * (1. - s) * (1. - s) * v_from - s * s * (1. - s) * v_to);
    }
  } // namespace

  MeasuredMotion::MeasuredMotion(const Scene &scene)
      : time(scene.identification.measured.time)
      , x(scene.identification.measured.x)
  {
    const bool by_drive = x.empty();
    for (std::size_t row = 0; by_drive && row < time.size(); ++row)
      x.push_back(scene.drive.at(time[row]).x);
    find_strokes();
    for (const auto &stroke : all)
    {
      std::vector<double> found;
      if (!by_drive && !time.empty())
        found = measured_speeds(stroke);
      for (std::size_t row = stroke.first; by_drive && row <= stroke.last; ++row)
        found.push_back(scene.drive.at(time[row], row == stroke.first ? Drive::Side::after : Drive::Side::before).v);
      if (found.empty())
        found.assign(stroke.last - stroke.first + 1, stroke.direction * scene.drive.peak_speed());
      speeds.push_back(found);
    }
    for (const auto &of_stroke : speeds)
      for (const double speed : of_stroke)
        fastest = std::max(fastest, std::abs(speed));
  }

  void MeasuredMotion::find_strokes()
  {
    const auto range   = std::minmax_element(x.begin(), x.end());
    const double least = least_turn * (*range.second - *range.first);
    std::size_t first = 0, lowest = 0, highest = 0;
    int direction  = 0;
    const auto end = [&](const std::size_t turn)
    {
      all.push_back({ first, turn, direction });
      first     = turn;
      direction = -direction;
      lowest = highest = turn;
    };
    for (std::size_t row = 0; row < x.size(); ++row)
    {
      lowest  = x[row] < x[lowest] ? row : lowest;
      highest = x[row] > x[highest] ? row : highest;
      if (direction == 0 && x[highest] - x[lowest] > least)
      {
        direction = highest > lowest ? 1 : -1;
        first     = direction > 0 ? lowest : highest;
      }
      else if (direction > 0 && x[highest] - x[row] > least)
      {
        end(highest);
        lowest = row;
      }
      else if (direction < 0 && x[row] - x[lowest] > least)
      {
        end(lowest);
        highest = row;
      }
    }
    end(direction > 0 ? highest : lowest);
  }

  std::vector<double> MeasuredMotion::measured_speeds(const Stroke &stroke) const
  {
    const auto rows     = stroke.last - stroke.first + 1;
    const auto each_way = std::clamp<std::size_t>(rows / lines_a_way / 2, 2, most_each_way);
    std::vector<double> result;
    for (std::size_t row = stroke.first; row <= stroke.last; ++row)
    {
      // As many rows each way: the line's slope is then good to second order where the speed changes.
      const auto room = std::max<std::size_t>(1, std::min({ each_way, row - stroke.first, stroke.last - row }));
      const auto from = std::max(row, stroke.first + room) - room;
      const auto to   = std::min(row + room, stroke.last) + 1;
      const auto part = [&](const std::vector<double> &values)
      { return std::vector<double>(values.begin() + from, values.begin() + to); };
      const auto times = part(time);
      result.push_back(times.back() > times.front() ? fitted_line(times, part(x)).slope : 0.);
    }
    return result;
  }

  std::size_t MeasuredMotion::stroke_at(const std::size_t row, const double lag) const
  {
    std::size_t stroke = 0;
    const auto begun = [&](const Stroke &next) { return time.empty() ? row >= next.first : time[row] - lag >= time[next.first]; };
    while (stroke + 1 < all.size() && begun(all[stroke + 1]))
      ++stroke;
    return stroke;
  }

  bool MeasuredMotion::covers(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    const auto &[first, last, direction] = all[stroke];
    if (time.empty())
      return row > first && row < last;
    return time[row] - lag > time[first] && time[row] - lag < time[last];
  }

  MeasuredMotion::Place MeasuredMotion::at(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    const Stroke &within = all[stroke];
    const auto &v        = speeds[stroke];
    const auto place     = std::clamp(row, within.first, within.last);
    if (time.empty() || (lag == 0. && place == row))
      return { x[place], v[place - within.first] };
    const double when = time[row] - lag;
    if (when <= time[within.first])
      return { x[within.first] + v.front() * (when - time[within.first]), v.front() };
    if (when >= time[within.last])
      return { x[within.last] + v.back() * (when - time[within.last]), v.back() };
    const auto next    = std::upper_bound(time.begin() + within.first + 1, time.begin() + within.last, when) - time.begin();
    const auto i       = static_cast<std::size_t>(next) - 1;
    const auto j       = i - within.first;
    const double step  = time[i + 1] - time[i];
    const double share = (when - time[i]) / step;
    return { cubic(share, step, x[i], x[i + 1], v[j], v[j + 1]), v[j] + share * (v[j + 1] - v[j]) };
  }

  double MeasuredMotion::travel(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    return all[stroke].direction * (at(row, lag, stroke).x - x[all[stroke].first]);
  }

  double MeasuredMotion::length(const std::size_t stroke) const
  {
    return std::abs(x[all[stroke].last] - x[all[stroke].first]);
  }

  double MeasuredMotion::spacing() const
  {
    return time.size() < 2 ? 0. : (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  }
} // namespace sprag
