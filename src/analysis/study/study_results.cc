// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_results.h"

#include "base/least_squares.h"
#include "base/text.h"
#include "base/unknown.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace sprag
{
  namespace
  {
    double to_number(const std::string &value)
    {
      const auto number = leading_number(value);
      return number && number->rest.empty() ? number->value : unknown;
    }

    /// Sizes of elements and steps, and tolerances of steps: what makes results exact by being small.
    bool is_size(const std::string &parameter)
    {
      using boost::algorithm::ends_with;
      return ends_with(parameter, "/Face size") || ends_with(parameter, "/Step") || ends_with(parameter, "/Tolerance");
    }

    /// NaN where one of them is.
    std::vector<double> largest_errors(const std::vector<MeasuredErrors> &measured)
    {
      std::vector<double> largest = measured.front().errors;
      for (const auto &[measure, errors, front, recommended] : measured)
        for (std::size_t row = 0; row < errors.size(); ++row)
          if (std::isnan(errors[row]) || errors[row] > largest[row])
            largest[row] = errors[row];
      return largest;
    }

    /// Returns true if a run has sizes of at most those of another and equal other settings.
    bool is_as_refined(const StudySettings &study, const StudyPoint &run, const StudyPoint &other)
    {
      for (std::size_t i = 0; i < run.size(); ++i)
      {
        const auto &values = study.varied[i].values;
        const bool smaller = is_size(study.varied[i].name) && to_number(values[run[i]]) <= to_number(values[other[i]]);
        if (run[i] != other[i] && !smaller)
          return false;
      }
      return true;
    }

    /// The largest error of each run and of those that are finer, so that none is taken for exact that is so by chance; NaN where
    /// one of them has none.
    std::vector<double> lasting_errors(const StudySettings &study, const std::vector<StudyPoint> &rows,
                                       const std::vector<double> &errors)
    {
      std::vector<double> lasting = errors;
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t finer = 0; finer < rows.size(); ++finer)
          if (is_as_refined(study, rows[finer], rows[row]) && !std::isnan(lasting[row]) && !(errors[finer] <= lasting[row]))
            lasting[row] = errors[finer];
      return lasting;
    }

    void assess(const StudySettings &study, const std::vector<StudyPoint> &rows, const std::vector<double> &costs,
                MeasuredErrors &measured)
    {
      measured.front     = pareto_front(costs, measured.errors);
      const auto lasting = lasting_errors(study, rows, measured.errors);
      for (std::size_t i = 0; i < recommended_accuracies.size(); ++i)
        measured.recommended[i] = cheapest_within(recommended_accuracies[i], costs, lasting);
    }

    /// CPU times differ from one study to the next, so that they rank runs only where the work is not counted.
    bool is_counted(const StudyRecords &records)
    {
      return std::none_of(records.begin(), records.end(),
                          [](const auto &run)
                          { return run.second.outcome == RunOutcome::completed && std::isnan(run.second.work); });
    }

    /// The settings of a point but for one parameter.
    std::string others_text(const StudySettings &study, const StudyPoint &point, const std::size_t left_out)
    {
      std::string text;
      for (std::size_t i = 0; i < point.size(); ++i)
        if (i != left_out)
          text += (text.empty() ? "" : ", ") + study.varied[i].name + " = " + study.varied[i].values[point[i]];
      return text;
    }

    struct SizesAndErrors
    {
      std::vector<double> sizes, errors;
    };

    /// Adds the order of each measure's error over one parameter, for each combination of the others.
    void add_orders(const StudySettings &study, const std::vector<StudyPoint> &rows, const std::size_t parameter,
                    StudyTrade &trade)
    {
      for (const auto &measured : trade.measured)
      {
        std::map<std::string, SizesAndErrors> by_others;
        for (std::size_t row = 0; row < rows.size(); ++row)
        {
          auto &series = by_others[others_text(study, rows[row], parameter)];
          series.sizes.push_back(to_number(study.varied[parameter].values[rows[row][parameter]]));
          series.errors.push_back(measured.errors[row]);
        }
        for (const auto &[others, pairs] : by_others)
          if (const double order = observed_order(pairs.sizes, pairs.errors); !std::isnan(order))
            trade.orders.push_back({ measured.measure.name, study.varied[parameter].name, others, order });
      }
    }
  } // namespace

  std::string settings_text(const StudySettings &study, const StudyPoint &point)
  {
    return others_text(study, point, point.size());
  }

  StudyTrade compute_trade(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records)
  {
    StudyTrade trade;
    const auto reference = records.find(points.size());
    if (reference == records.end() || reference->second.outcome != RunOutcome::completed)
      return trade;
    const Comparable &expected = reference->second.found;
    for (const auto &measure : make_measures(study.type, expected))
      trade.measured.push_back({ measure, {}, {}, {} });
    if (trade.measured.empty())
      return trade;
    std::vector<double> costs;
    std::vector<StudyPoint> rows;
    for (const auto &[run, record] : records)
      if (run < points.size())
      {
        const bool completed = record.outcome == RunOutcome::completed;
        const auto errors    = completed ? compute_errors(study.type, record.found, expected) : std::vector<double>();
        for (std::size_t i = 0; i < trade.measured.size(); ++i)
          trade.measured[i].errors.push_back(completed ? errors[i] : unknown);
        costs.push_back(completed ? (is_counted(records) ? record.work : record.cpu_time) : unknown);
        rows.push_back(points[run]);
      }
    for (std::size_t i = 0; i < study.varied.size(); ++i)
      if (is_size(study.varied[i].name))
        add_orders(study, rows, i, trade);
    if (trade.measured.size() > 1)
      trade.measured.push_back({ { "all", "largest of the errors" }, largest_errors(trade.measured), {}, {} });
    for (auto &measured : trade.measured)
      assess(study, rows, costs, measured);
    return trade;
  }

  std::vector<bool> pareto_front(const std::vector<double> &costs, const std::vector<double> &errors)
  {
    const auto beats = [&](const std::size_t other, const std::size_t run)
    {
      return costs[other] <= costs[run] && errors[other] <= errors[run] &&
             (costs[other] < costs[run] || errors[other] < errors[run]);
    };
    std::vector<bool> front;
    for (std::size_t run = 0; run < costs.size(); ++run)
    {
      bool best = std::isfinite(costs[run]) && std::isfinite(errors[run]);
      for (std::size_t other = 0; best && other < costs.size(); ++other)
        best = !beats(other, run);
      front.push_back(best);
    }
    return front;
  }

  std::optional<std::size_t> cheapest_within(const double accuracy, const std::vector<double> &costs,
                                             const std::vector<double> &errors)
  {
    std::optional<std::size_t> found;
    for (std::size_t run = 0; run < costs.size(); ++run)
      if (errors[run] <= accuracy && std::isfinite(costs[run]) && (!found || costs[run] < costs[*found]))
        found = run;
    return found;
  }

  double observed_order(const std::vector<double> &sizes, const std::vector<double> &errors)
  {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (sizes[i] > 0. && errors[i] > 0. && std::isfinite(sizes[i]) && std::isfinite(errors[i]))
      {
        x.push_back(std::log(sizes[i]));
        y.push_back(std::log(errors[i]));
      }
    const bool enough = std::set<double>(x.begin(), x.end()).size() >= 3;
    return enough ? fitted_line(x, y).slope : unknown;
  }

  /// Attributes are left out: no study uses those of its runs.
  void serialise(Archive &archive, Entry &entry)
  {
    bool is_text = std::holds_alternative<std::string>(entry.value);
    archive(entry.name, entry.unit, entry.description, is_text);
    if (archive.reads() && is_text)
      entry.value = std::string();
    std::visit([&](auto &value) { archive(value); }, entry.value);
  }

  void serialise(Archive &archive, StudyRecord &record)
  {
    auto &[run, outcome, reason, cpu_time, cpu_spent, work, wall_time, peak_memory, warnings, found] = record;
    archive(run, outcome, reason, cpu_time, cpu_spent, work, wall_time, peak_memory, warnings, found.summary, found.curve);
  }
} // namespace sprag
