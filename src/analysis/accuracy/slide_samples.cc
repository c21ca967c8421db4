// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/slide_samples.h"

#include "analytic/closed_form.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "results/entries.h"
#include "results/row_statistics.h"
#include "scene/closed_form.h"
#include "scene/drive.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sprag
{
  namespace
  {
    using Index = std::size_t;

    constexpr double least_P           = 0.02; ///< of sampled rows, over the largest P
    constexpr unsigned int most_halves = 6;    ///< halvings of a step
    constexpr Index passage_limit      = 2000; ///< rows

    /// Returns the value of a row less the linear interpolation over x between two others; 0 if these have the same x.
    double distance_from_line(const Row &before, const Row &row, const Row &after, const Column column)
    {
      const double dx = after[Column::x] - before[Column::x];
      if (dx == 0.)
        return 0.;
      const double share = (row[Column::x] - before[Column::x]) / dx;
      return row[column] - (1. - share) * before[column] - share * after[column];
    }

    bool slides(const Row &row, const double largest_force)
    {
      return row[Column::v] != 0. && row[Column::P] > least_P * largest_force && !sticks(row);
    }

    /// Returns the rows in full sliding of the stroke that begins at a row, and the first row after the stroke. Rows before the
    /// contact has moved by its own width depend on its history and are left out.
    std::pair<std::vector<Index>, Index> stroke_from(const std::vector<Row> &rows, const Index begin, const double largest_force)
    {
      const double turned_at = rows[begin > 0 ? begin - 1 : 0][Column::x];
      std::vector<Index> result;
      Index i = begin;
      for (; i < rows.size() && drive_direction(rows[i][Column::v]) == drive_direction(rows[begin][Column::v]); ++i)
        if (slides(rows[i], largest_force) && std::abs(rows[i][Column::x] - turned_at) > rows[i][Column::contact_width])
          result.push_back(i);
      return { result, i };
    }

    /// Adds the rows closest to equally spaced x, and those with the largest P and pressure.
    void choose_evenly(const std::vector<Row> &rows, const std::vector<Index> &stroke, const unsigned int number,
                       std::set<Index> &chosen)
    {
      if (stroke.empty())
        return;
      const double begin  = rows[stroke.front()][Column::x];
      const double length = rows[stroke.back()][Column::x] - begin;
      for (unsigned int i = 0; i < number; ++i)
      {
        const double x     = begin + length * (i + 0.5) / number;
        const auto closest = [&](const Index a, const Index b)
        { return std::abs(rows[a][Column::x] - x) < std::abs(rows[b][Column::x] - x); };
        chosen.insert(*std::min_element(stroke.begin(), stroke.end(), closest));
      }
      for (const Column column : { Column::P, Column::largest_pressure })
        chosen.insert(*std::max_element(stroke.begin(), stroke.end(),
                                        [&](const Index a, const Index b) { return rows[a][column] < rows[b][column]; }));
    }

    DrivePoint to_drive_point(const Row &row)
    {
      return { row[Column::time], row[Column::x], row[Column::v] };
    }

    DrivePoint midpoint(const DrivePoint &from, DrivePoint to)
    {
      to.time = 0.5 * (from.time + to.time);
      to.x    = 0.5 * (from.x + to.x);
      return to;
    }

    /// Returns the equilibrium at `to`, through halved steps if there is none in a single one.
    Equilibrium slide_to(Model &model, const State &from, const DrivePoint &to, const QuasiStaticSettings &settings,
                         const unsigned int halves = 0)
    {
      if (auto next = solve_step(model, from, to, settings))
        return std::move(*next);
      if (halves == most_halves)
        throw AnalysisError("no equilibrium at x = " + mm(to.x));
      const auto middle = slide_to(model, from, midpoint(from.drive, to), settings, halves + 1);
      return slide_to(model, middle.state, to, settings, halves + 1);
    }

    double change(const double value, const double other)
    {
      return std::abs((other - value) / value);
    }

    double largest_change(const std::vector<Row> &samples, const std::vector<Row> &other, const Column column)
    {
      double result = 0.;
      for (std::size_t i = 0; i < samples.size(); ++i)
        result = std::max(result, std::abs(other[i][column] - samples[i][column]));
      return result / largest(samples, column);
    }

    // All samples near the peak are compared: a single one may agree by chance.
    constexpr double near_peak = 0.5; ///< least pressure of compared samples, over the largest

    /// Returns the root mean square of the pressure's relative changes near the peak. Each is scaled to the contact at the peak,
    /// by the cube of the faces in contact with which pressures converge.
    double pressure_change(const std::vector<Row> &samples, const std::vector<Row> &other)
    {
      const auto *const peak = find_largest_row(samples, [](const Row &row) { return row[Column::largest_pressure]; });
      std::vector<double> changes;
      for (std::size_t i = 0; peak != nullptr && i < samples.size(); ++i)
        if (const Row &row = samples[i]; row[Column::largest_pressure] >= near_peak * (*peak)[Column::largest_pressure])
        {
          const double width = row[Column::contact_width] / (*peak)[Column::contact_width];
          changes.push_back(change(row[Column::largest_pressure], other[i][Column::largest_pressure]) * std::pow(width, 3));
        }
      return root_mean_square(changes);
    }

    std::vector<Row> closed_form_rows(Scene scene, const double step)
    {
      scene.analysis.step = step;
      std::vector<Row> rows;
      run_closed_form(scene, [&](const Row &row) { rows.push_back(row); });
      return rows;
    }

    /// Returns the scene with a drive of constant speed over the same x, unless it locks so. Where a drive changes its speed,
    /// largest_speed_change sets the distance of the rows in place of Analysis/Step.
    Scene with_constant_speed(Scene scene)
    {
      const Drive drive = scene.drive;
      const bool falls  = drive.at(0.).x > 0.5 * (drive.minimum() + drive.maximum());
      const auto [from, to] =
          falls ? std::pair{ drive.maximum(), drive.minimum() } : std::pair{ drive.minimum(), drive.maximum() };
      scene.drive = Drive(DriveProfile::triangle, from, to, drive.peak_speed(), drive.reversals().empty() ? 0.5 : 1.);
      if (locking(scene))
        scene.drive = drive;
      return scene;
    }

    /// Returns the largest error of interpolating a row between its neighbours, over the column's peak.
    double interpolation_error(const std::vector<Row> &rows, const Column column)
    {
      double result = 0.;
      for (std::size_t i = 1; i + 1 < rows.size(); ++i)
        if (rows[i - 1][Column::v] * rows[i + 1][Column::v] > 0.)
          result = std::max(result, std::abs(distance_from_line(rows[i - 1], rows[i], rows[i + 1], column)));
      return result / largest(rows, column);
    }

    /// Returns the relative error of forces and, if `has_loop`, of the loop area with rows `step` apart [mm]. The trapezoidal
    /// rule has second order, so that its error is 4/3 of the difference to half the step.
    double estimate_error(const Scene &scene, const double step, const bool has_loop)
    {
      const auto halves  = closed_form_rows(scene, 0.5 * step);
      const double lines = std::max(interpolation_error(halves, Column::P), interpolation_error(halves, Column::Q));
      if (!has_loop)
        return lines;
      const double loop = relative_change("loop_area", halves, closed_form_rows(scene, step));
      return std::max(lines, 4. / 3. * loop);
    }
  } // namespace

  std::vector<Row> slide_samples(const std::vector<Row> &rows, const unsigned int number, const std::vector<double> &times)
  {
    const double largest_force = largest(rows, Column::P);
    std::set<Index> chosen;
    Index begin = 0;
    for (unsigned int stroke = 0; stroke < 2 && begin < rows.size(); ++stroke)
    {
      const auto [sliding, end] = stroke_from(rows, begin, largest_force);
      choose_evenly(rows, sliding, number, chosen);
      for (const Index i : sliding)
        if (contains(times, rows[i][Column::time]))
          chosen.insert(i);
      begin = end;
    }
    return mapped(chosen, [&](const Index i) { return rows[i]; });
  }

  std::vector<Row> passage_rows(const std::vector<Row> &rows)
  {
    Index turn = 1;
    while (turn < rows.size() && drive_direction(rows[turn][Column::v]) == drive_direction(rows[0][Column::v]))
      ++turn;
    if (turn >= rows.size())
      return {};
    const double x = rows[turn - 1][Column::x];
    const int back = drive_direction(rows[turn][Column::v]);
    Index last     = turn;
    for (const auto column : { Column::P, Column::Q })
    {
      const auto counts = moves_with_friction(rows, back, column);
      Index peak        = rows.size();
      for (Index i = turn; i < rows.size() && drive_direction(rows[i][Column::v]) == back &&
                           std::abs(rows[i][Column::x] - x) <= rows[i][Column::contact_width];
           ++i)
        if (counts[i] && (peak == rows.size() || std::abs(rows[i][column]) > std::abs(rows[peak][column])))
          peak = i;
      last = std::max(last, peak);
    }
    if (last - turn >= passage_limit || last == rows.size())
      return {};
    const Index end = std::min(last + 5, rows.size());
    return { rows.begin() + static_cast<std::ptrdiff_t>(turn) - 1, rows.begin() + static_cast<std::ptrdiff_t>(end) };
  }

  std::vector<Row> solve_at_samples(Model &model, const std::vector<Row> &samples, const double start,
                                    const QuasiStaticSettings &settings, const StepSink &sink)
  {
    std::vector<Row> result;
    if (samples.empty())
      return result;
    const DrivePoint first = to_drive_point(samples.front());
    State state            = settled(model, { 0., 0., std::abs(first.v) }, settings);
    if (first.v < 0.)
    {
      const double speed = std::abs(first.v);
      state              = slide_to(model, state, { start / speed, start, speed }, settings).state;
      state.drive        = { 0., start, first.v };
    }
    for (const Row &sample : samples)
    {
      const DrivePoint point = to_drive_point(sample);
      // During the passage through stick the slip speed, on which mu depends, is not that of the drive: take two steps.
      if (drive_direction(point.v) != drive_direction(state.drive.v))
        state = slide_to(model, state, midpoint(state.drive, point), settings).state;
      auto next = slide_to(model, state, point, settings);
      result.push_back(observed(model, next.state, next.found));
      for (const auto column : { Column::P_closed_form, Column::Q_closed_form, Column::theta_closed_form })
        result.back()[column] = sample[column];
      sink(next.state, result.back(), next.found);
      state = std::move(next.state);
    }
    return result;
  }

  std::vector<double> sample_times(const std::vector<Row> &rows)
  {
    return mapped(rows, [](const Row &row) { return row[Column::time]; });
  }

  std::vector<Row> rows_at(const std::vector<double> &times, const std::vector<Row> &rows)
  {
    return filtered(rows, [&](const Row &row) { return contains(times, row[Column::time]); });
  }

  std::vector<Row> drive_samples(const Drive &drive)
  {
    std::vector<double> ends = { 0. };
    for (const double time : drive.reversals())
      if (ends.size() < 3)
        ends.push_back(time);
    if (ends.size() < 3)
      ends.push_back(drive.duration());
    std::vector<Row> result;
    for (std::size_t stroke = 1; stroke < ends.size(); ++stroke)
      for (const double share : stroke == 1 ? std::vector{ 0.3, 0.7, 0.98 } : std::vector{ 0.08, 0.4, 0.8 })
        result.emplace_back(drive.at(ends[stroke - 1] + share * (ends[stroke] - ends[stroke - 1])));
    return result;
  }

  std::vector<Row> reversal_samples(const Drive &drive, const double distance)
  {
    constexpr unsigned int number = 10; // distances doubled from one to the next
    std::vector<Row> result;
    if (drive.reversals().empty())
      return result;
    const auto turn       = drive.at(drive.reversals().front(), Drive::Side::after);
    const double duration = distance / drive.peak_speed();
    if (turn.time + duration > (drive.reversals().size() > 1 ? drive.reversals()[1] : drive.duration()))
      return result;
    result.emplace_back(turn);
    for (unsigned int i = number; i-- > 0;)
      result.emplace_back(drive.at(turn.time + std::ldexp(duration, -static_cast<int>(i))));
    return result;
  }

  double compute_drive_work(const std::vector<Row> &samples)
  {
    double result = 0.;
    for (std::size_t i = 1; i < samples.size(); ++i)
      result +=
          0.5 * (samples[i - 1].drive_force() + samples[i].drive_force()) * (samples[i][Column::x] - samples[i - 1][Column::x]);
    return result;
  }

  double peak_change(const Column column, const std::vector<Row> &passage, const std::vector<Row> &other)
  {
    if (passage.empty() || other.empty())
      return 0.;
    const auto peak = [&](const std::vector<Row> &rows) {
      return std::abs(
          peak_between_rows(rows, column, moves_with_friction(rows, drive_direction(rows.back()[Column::v]), column)));
    };
    return std::abs(peak(other) - peak(passage)) / largest(passage, column);
  }

  double relative_change(const std::string &quantity, const std::vector<Row> &samples, const std::vector<Row> &other)
  {
    if (quantity == "loop_area")
      return change(compute_drive_work(samples), compute_drive_work(other));
    if (quantity == "largest_pressure" || contains(stress_names, quantity)) // which go with it
      return pressure_change(samples, other);
    static const std::map<std::string, Column> columns = { { "P", Column::P },
                                                           { "Q", Column::Q },
                                                           { "contact_width", Column::contact_width } };
    return largest_change(samples, other, columns.at(quantity));
  }

  double largest_row_spacing(const Scene &scene, const double error, const bool has_loop)
  {
    const Scene even = with_constant_speed(scene);
    double step      = 0.25 * (scene.drive.maximum() - scene.drive.minimum());
    // The error is proportional to step^2 for small steps.
    for (unsigned int i = 0; i < 8; ++i)
    {
      const double found = estimate_error(even, step, has_loop);
      if (found <= error)
        return step;
      step *= std::max(0.25, 0.95 * std::sqrt(error / found));
    }
    return step;
  }
} // namespace sprag
