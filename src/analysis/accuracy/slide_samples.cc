// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/slide_samples.h"

#include "base/errors.h"
#include "base/text.h"
#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  namespace
  {
    using Index = std::size_t;

    constexpr double all_slide         = 0.999; ///< share of mu P from which the whole contact is told to slide
    constexpr double pressed           = 0.02;  ///< of the largest P, from which a row counts
    constexpr unsigned int most_halves = 6;
    constexpr Index passage_limit      = 100; ///< rows

    bool slides(const Row &row, const double largest_force)
    {
      const double friction = std::abs(row[Column::friction_resultant]);
      return row[Column::v] != 0. && row[Column::P] > pressed * largest_force &&
             friction >= all_slide * row[Column::mu] * row[Column::normal_resultant];
    }

    /// The sliding rows of the stroke that begins at a row, and the row behind the stroke. Near its beginning they still remember
    /// what was before, until the contact has moved by its own width.
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

    void choose_evenly(const std::vector<Row> &rows, const std::vector<Index> &stroke, const unsigned int number,
                       std::set<Index> &chosen)
    {
      if (stroke.empty())
        return;
      const double begin = rows[stroke.front()][Column::x];
      const double way   = rows[stroke.back()][Column::x] - begin;
      for (unsigned int i = 0; i < number; ++i)
      {
        const double x     = begin + way * (i + 0.5) / number;
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

    DrivePoint half_way(const DrivePoint &from, DrivePoint to)
    {
      to.time = 0.5 * (from.time + to.time);
      to.x    = 0.5 * (from.x + to.x);
      return to;
    }

    Equilibrium slid_to(Model &model, const State &from, const DrivePoint &to, const QuasiStaticSettings &settings,
                        const unsigned int halves = 0)
    {
      if (auto next = solve_step(model, from, to, settings))
        return std::move(*next);
      if (halves == most_halves)
        throw AnalysisError("no equilibrium at x = " + mm(to.x));
      const auto middle = slid_to(model, from, half_way(from.drive, to), settings, halves + 1);
      return slid_to(model, middle.state, to, settings, halves + 1);
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
        if (std::find(times.begin(), times.end(), rows[i][Column::time]) != times.end())
          chosen.insert(i);
      begin = end;
    }
    std::vector<Row> result;
    for (const Index i : chosen)
      result.push_back(rows[i]);
    return result;
  }

  std::vector<Row> passage_rows(const std::vector<Row> &rows)
  {
    Index turn = 1;
    while (turn < rows.size() && drive_direction(rows[turn][Column::v]) == drive_direction(rows[0][Column::v]))
      ++turn;
    if (turn >= rows.size())
      return {};
    const auto has_turned = friction_has_turned(rows);
    const double x        = rows[turn - 1][Column::x];
    Index largest_P = turn, largest_Q = turn;
    for (Index i = turn; i < rows.size() && drive_direction(rows[i][Column::v]) == drive_direction(rows[turn][Column::v]) &&
                         std::abs(rows[i][Column::x] - x) <= rows[i][Column::contact_width];
         ++i)
    {
      if (!has_turned[largest_P] || rows[i][Column::P] > rows[largest_P][Column::P])
        largest_P = i;
      if (!has_turned[largest_Q] || std::abs(rows[i][Column::Q]) > std::abs(rows[largest_Q][Column::Q]))
        largest_Q = i;
    }
    const Index end = std::max(largest_P, largest_Q) + 1;
    if (!has_turned[end - 1] || end - turn > passage_limit)
      return {};
    return { rows.begin() + static_cast<std::ptrdiff_t>(turn) - 1, rows.begin() + static_cast<std::ptrdiff_t>(end) };
  }

  std::vector<Row> repeated(Model &model, const std::vector<Row> &samples, const double start,
                            const QuasiStaticSettings &settings, const StepSink &look)
  {
    std::vector<Row> result;
    if (samples.empty())
      return result;
    const DrivePoint first = to_drive_point(samples.front());
    State state            = settled(model, { 0., 0., std::abs(first.v) }, settings);
    if (first.v < 0.)
    {
      const double speed = std::abs(first.v);
      state              = slid_to(model, state, { start / speed, start, speed }, settings).state;
      state.drive        = { 0., start, first.v };
    }
    for (const Row &sample : samples)
    {
      const DrivePoint point = to_drive_point(sample);
      // On the way through stick the slip is not that of the drive, and mu depends on its speed.
      if (drive_direction(point.v) != drive_direction(state.drive.v))
        state = slid_to(model, state, half_way(state.drive, point), settings).state;
      auto next = slid_to(model, state, point, settings);
      result.push_back(observed(model, next.state, next.found));
      look(next.state, result.back(), next.found);
      state = std::move(next.state);
    }
    return result;
  }

  std::vector<double> sample_times(const std::vector<Row> &rows)
  {
    std::vector<double> result;
    for (const Row &row : rows)
      result.push_back(row[Column::time]);
    return result;
  }

  std::vector<Row> rows_at(const std::vector<double> &times, const std::vector<Row> &rows)
  {
    std::vector<Row> result;
    for (const Row &row : rows)
      if (std::find(times.begin(), times.end(), row[Column::time]) != times.end())
        result.push_back(row);
    return result;
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

  std::vector<Row> places_behind_reversal(const Drive &drive, const double distance)
  {
    constexpr unsigned int number = 10; // each twice as far from the reversal as the one before: it is turned soon
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
} // namespace sprag
