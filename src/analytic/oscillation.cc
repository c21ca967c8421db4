// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/oscillation.h"

#include "analytic/ringing.h"
#include "base/ranges.h"
#include "base/text.h"
#include "results/row_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace sprag
{
  namespace
  {
    constexpr unsigned window_periods  = 15;      ///< of a vibration that is slower
    constexpr double last_share        = 0.1;     ///< of the window, in which what is left counts
    constexpr double noise             = 1e-3;    ///< relative to the largest force
    constexpr double vibration_rms     = 0.08;    ///< over the largest P without inertia
    constexpr double vibration_open    = 0.01;    ///< of the time
    constexpr double vibration_stick   = 0.01;    ///< of the time in the last half of the window
    constexpr double moving_share      = 0.1;     ///< of the drive's largest speed, below which sticking is that of a rest
    constexpr double decayed_rms       = 0.012;   ///< over the largest P without inertia
    constexpr double passing_share     = 0.04;    ///< of the frequency
    constexpr double lasting_share     = 0.1;     ///< of the rms, left at the end
    constexpr double envelope_end      = 0.05;    ///< of its peak
    constexpr double slower            = 0.5;     ///< frequency of another vibration, over the first
    constexpr double coarsest_sampling = 1e-5;    ///< [s]
    constexpr double most_samples      = 1 << 17; ///< of a resampled signal

    struct Sample
    {
      double time       = 0.;
      double x          = 0.;
      double value      = 0.; ///< of the force
      double reference  = 0.; ///< its quasi-static value
      double difference = 0.;
    };

    using Samples = std::vector<Sample>;

    /// The rows from `begin` to `end` with numbers in both columns; of two at one instant, before and after a jump, the second.
    Samples collect_samples(const std::vector<Row> &rows, const Column column, const Column reference, const double begin,
                            const double end)
    {
      Samples result;
      for (const auto &row : rows)
      {
        const double time       = row[Column::time];
        const double difference = row[column] - row[reference];
        if (time < begin || time > end || !std::isfinite(difference))
          continue;
        if (!result.empty() && time <= result.back().time)
          result.pop_back();
        result.push_back({ time, row[Column::x], row[column], row[reference], difference });
      }
      return result;
    }

    Samples later_than(const Samples &samples, const double time)
    {
      const auto first = std::find_if(samples.begin(), samples.end(), [time](const Sample &s) { return s.time >= time; });
      return { first, samples.end() };
    }

    Samples up_to(const Samples &samples, const double time)
    {
      return { samples.begin(), std::find_if(samples.begin(), samples.end(), [time](const Sample &s) { return s.time > time; }) };
    }

    double largest_reference(const Samples &samples)
    {
      return largest(samples, [](const Sample &sample) { return sample.reference; });
    }

    double noise_in(const Samples &samples)
    {
      return noise * std::max(largest_reference(samples), largest(samples, [](const Sample &sample) { return sample.value; }));
    }

    /// Returns the mean over time of `mean_between`, the mean between two successive samples.
    template <typename Mean>
    double mean(const Samples &samples, const Mean &mean_between)
    {
      double integral = 0., length = 0.;
      for (std::size_t i = 1; i < samples.size(); ++i)
      {
        const double duration = samples[i].time - samples[i - 1].time;
        integral += duration * mean_between(samples[i - 1], samples[i]);
        length += duration;
      }
      return length > 0. ? integral / length : unknown;
    }

    double rms(const Samples &samples)
    {
      return std::sqrt(
          mean(samples, [](const Sample &a, const Sample &b)
               { return (a.difference * a.difference + a.difference * b.difference + b.difference * b.difference) / 3.; }));
    }

    double open_share(const Samples &samples)
    {
      const auto is_open = [](const Sample &sample) { return sample.value == 0. ? 0.5 : 0.; };
      return mean(samples, [&](const Sample &a, const Sample &b) { return is_open(a) + is_open(b); });
    }

    /// The first sample whose difference has another sign than the one before, those later than `latest` left out.
    double first_crossing(const Samples &samples, const double latest)
    {
      for (std::size_t i = 1; i < samples.size() && samples[i].time < latest; ++i)
        if (samples[i].difference * samples[i - 1].difference <= 0.)
          return samples[i].time;
      return latest;
    }

    /// `samples` from the turning point on. `sliding`: when friction slides in the new direction at the latest [s].
    double overshoot(const Samples &samples, const double window_begin, const double sliding)
    {
      const double scale  = largest_reference(later_than(samples, window_begin));
      const double excess = largest(later_than(samples, first_crossing(samples, sliding)), [](const auto &sample)
                                    { return std::max(0., std::copysign(1., sample.reference) * sample.difference); });
      return scale > 0. ? excess / scale : unknown;
    }

    /// Slope at samples[i] of the parabola through it and its neighbours.
    double slope_at(const Samples &samples, const std::size_t i)
    {
      const auto secant = [&](const std::size_t j)
      { return (samples[j + 1].difference - samples[j].difference) / (samples[j + 1].time - samples[j].time); };
      if (i == 0)
        return secant(0);
      if (i + 1 == samples.size())
        return secant(i - 1);
      const double before = samples[i].time - samples[i - 1].time;
      const double after  = samples[i + 1].time - samples[i].time;
      return (secant(i - 1) * after + secant(i) * before) / (before + after);
    }

    /// The cubic through samples i and i + 1 with the slopes there.
    double interpolated(const Samples &samples, const std::size_t i, const double time)
    {
      const double h = samples[i + 1].time - samples[i].time;
      const double t = (time - samples[i].time) / h;
      const double u = 1. - t;
      return u * u * (1. + 2. * t) * samples[i].difference + t * t * (1. + 2. * u) * samples[i + 1].difference +
             h * t * u * (u * slope_at(samples, i) - t * slope_at(samples, i + 1));
    }

    double median_step(const Samples &samples)
    {
      std::vector<double> steps;
      for (std::size_t i = 1; i < samples.size(); ++i)
        steps.push_back(samples[i].time - samples[i - 1].time);
      const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
      std::nth_element(steps.begin(), middle, steps.end());
      return *middle;
    }

    Signal resampled(const Samples &samples)
    {
      const double length  = samples.back().time - samples.front().time;
      const double step    = std::min(coarsest_sampling, median_step(samples));
      const double n_steps = std::clamp(std::ceil(length / step), 1., most_samples - 1.);
      Signal signal{ length / n_steps, {} };
      std::size_t before = 0;
      for (unsigned int i = 0; i <= n_steps; ++i)
      {
        const double time = std::min(samples.front().time + i * signal.step, samples.back().time);
        while (before + 2 < samples.size() && samples[before + 1].time < time)
          ++before;
        signal.values.push_back(interpolated(samples, before, time));
      }
      return signal;
    }

    Ringing detect_ringing(const Samples &window)
    {
      return window.size() < 2 ? Ringing{} : ringing(resampled(window), noise_in(window));
    }

    /// The last sample farther off its value without inertia than `little`.
    Samples::const_reverse_iterator last_beyond(const Samples &samples, const double little)
    {
      return std::find_if(samples.rbegin(), samples.rend(),
                          [little](const Sample &sample) { return std::abs(sample.difference) > little; });
    }

    double extent(const Samples &from_reversal, const double x)
    {
      const double peak = largest(from_reversal, [](const Sample &sample) { return sample.difference; });
      const auto last   = last_beyond(from_reversal, std::max(envelope_end * peak, noise_in(from_reversal)));
      return last == from_reversal.rend() ? 0. : std::abs(last->x - x);
    }

    /// Returns how long a force takes to meet its value without inertia twice in each of the periods, or to decay by the last
    /// tenth.
    double vibration_length(const Samples &from_reversal)
    {
      unsigned crossings = 0;
      for (std::size_t i = 1; i < from_reversal.size(); ++i)
        if (from_reversal[i].difference * from_reversal[i - 1].difference < 0. && ++crossings == 2 * window_periods)
          return from_reversal[i].time - from_reversal.front().time;
      const auto last = last_beyond(from_reversal, decayed_rms * largest_reference(from_reversal));
      return crossings == 0 || last == from_reversal.rend() ? 0. : (last->time - from_reversal.front().time) / (1. - last_share);
    }

    /// `least`: P that never counts [N].
    Verdict classify(const Oscillation &oscillation, const double least)
    {
      if (std::isnan(oscillation.rms))
        return Verdict::unknown;
      if (oscillation.rms > vibration_rms * oscillation.scale && oscillation.open_share > vibration_open)
        return Verdict::vibrates;
      if (oscillation.stick_share > vibration_stick)
        return Verdict::sticks_and_slips;
      if (std::isfinite(oscillation.passing_frequency))
        return Verdict::elements_pass;
      const bool little = oscillation.rms_end <= std::max(decayed_rms * oscillation.scale, least);
      if (little && oscillation.open_share == 0.)
        return Verdict::decays;
      return !little && oscillation.growth_rate > 0. ? Verdict::grows : Verdict::rings;
    }

    /// Mean speed of the centre of pressure along the lever between two times, which is not that of sliding; NaN without contact.
    double speed_along(const std::vector<Row> &rows, const double begin, const double end)
    {
      const auto counts = [=](const Row &row)
      { return row[Column::time] >= begin && row[Column::time] <= end && std::isfinite(row[Column::s]); };
      const auto first = std::find_if(rows.begin(), rows.end(), counts);
      const auto last  = std::find_if(rows.rbegin(), rows.rend(), counts);
      if (first == rows.end())
        return unknown;
      return std::abs(((*last)[Column::s] - (*first)[Column::s]) / ((*last)[Column::time] - (*first)[Column::time]));
    }

    double passing_frequency(const Oscillation &oscillation, const double speed, const double face_size)
    {
      if (!(oscillation.rms_end > lasting_share * oscillation.rms))
        return unknown;
      for (const double elements : { 1., 2. })
        if (const double passing = elements * speed / face_size;
            std::abs(oscillation.frequency - passing) < passing_share * passing)
          return passing;
      return unknown;
    }

    /// Share of the time between two times in which friction sticks in contact while the drive moves; 0 unless it comes to stick
    /// twice, as friction that is regularised is less than in sliding for good; NaN without steps.
    double stick_share(const std::vector<Row> &rows, const double begin, const double end)
    {
      const double least_speed = moving_share * largest(rows, Column::v);
      double sum = 0., stuck = 0.;
      unsigned int phases = 0;
      bool was_stuck      = true;
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i - 1][Column::time] >= begin && rows[i][Column::time] <= end)
        {
          const double step   = rows[i][Column::time] - rows[i - 1][Column::time];
          const bool moves    = std::abs(rows[i][Column::v]) > least_speed;
          const bool is_stuck = moves && rows[i][Column::P] > 0. && sticks(rows[i]);
          phases += is_stuck && !was_stuck ? 1 : 0;
          was_stuck = is_stuck;
          sum += step;
          stuck += is_stuck ? step : 0.;
        }
      return !(sum > 0.) ? unknown : phases > 1 ? stuck / sum : 0.;
    }

    /// Returns when friction slides again behind the first stick between two times, `begin` without such [s].
    double find_sliding(const std::vector<Row> &rows, const double begin, const double end)
    {
      bool was_stuck = false;
      for (const auto &row : rows)
        if (row[Column::time] > begin && row[Column::time] <= end)
        {
          const bool is_stuck = row[Column::P] > 0. && sticks(row);
          if (was_stuck && !is_stuck)
            return row[Column::time];
          was_stuck = is_stuck;
        }
      return begin;
    }

    /// P that never counts [N].
    double negligible(const std::vector<Row> &rows)
    {
      const auto finite_P = [](const Row &row)
      { return std::isfinite(row[Column::P_quasi_static]) ? row[Column::P_quasi_static] : 0.; };
      return noise * largest(rows, finite_P);
    }

    void add_normal_force(Oscillation &oscillation, const Samples &after_turn, const Ringing &found, const double sliding,
                          const std::vector<Row> &rows, const double face_size)
    {
      const Samples after_reversal = later_than(after_turn, oscillation.window_begin);
      const Samples window         = up_to(after_reversal, oscillation.window_end);
      if (window.size() < 2)
        return;
      oscillation.frequency   = found.frequency;
      oscillation.growth_rate = found.growth_rate;
      oscillation.overshoot_P = overshoot(up_to(after_turn, oscillation.window_end), oscillation.window_begin, sliding);
      oscillation.open_share  = open_share(window);
      oscillation.rms         = rms(window);
      const double last_tenth = oscillation.window_end - last_share * (oscillation.window_end - oscillation.window_begin);
      oscillation.rms_end     = rms(later_than(window, last_tenth));
      oscillation.stick_share =
          stick_share(rows, 0.5 * (oscillation.window_begin + oscillation.window_end), oscillation.window_end);
      oscillation.extent = extent(after_reversal, oscillation.x);
      oscillation.scale  = largest_reference(window);
      if (face_size > 0.)
        oscillation.passing_frequency =
            passing_frequency(oscillation, speed_along(rows, oscillation.window_begin, oscillation.window_end), face_size);
      oscillation.verdict = classify(oscillation, negligible(rows));
    }

    void add_force_along_x(const Samples &after_turn, const double sliding, const double begin, const double end, double &excess,
                           double &frequency, double &distance)
    {
      const Samples window = later_than(up_to(after_turn, end), begin);
      if (window.size() < 2)
        return;
      excess    = overshoot(up_to(after_turn, end), begin, sliding);
      frequency = detect_ringing(window).frequency;
      distance  = rms(window);
    }

    unsigned int rank(const Verdict verdict)
    {
      constexpr std::array<Verdict, 7> by_rank = { { Verdict::unknown, Verdict::decays, Verdict::rings, Verdict::elements_pass,
                                                     Verdict::sticks_and_slips, Verdict::grows, Verdict::vibrates } };
      return static_cast<unsigned int>(std::find(by_rank.begin(), by_rank.end(), verdict) - by_rank.begin());
    }

    bool is_worse(const Oscillation &a, const Oscillation &b)
    {
      constexpr double round_off = 1e-6;
      return rank(a.verdict) != rank(b.verdict) ? rank(a.verdict) > rank(b.verdict) : a.rms > (1. + round_off) * b.rms;
    }

    Oscillation oscillation_at(const std::vector<Row> &rows, const DrivePoint &turn, const double reversal_duration,
                               const double next_reversal, const double face_size)
    {
      Oscillation result;
      result.time           = turn.time;
      result.x              = turn.x;
      result.window_begin   = turn.time + reversal_duration / 2.;
      const double end      = std::min(next_reversal, rows.empty() ? turn.time : rows.back()[Column::time]);
      const auto after      = collect_samples(rows, Column::P, Column::P_quasi_static, turn.time, end);
      const auto window_end = [&](const Column force, const Column reference)
      {
        const auto from_reversal = later_than(collect_samples(rows, force, reference, turn.time, end), result.window_begin);
        const double length      = std::max(least_window, vibration_length(from_reversal));
        return std::max(std::min(result.window_begin + length, end), result.window_begin);
      };
      const auto window      = [&](const double until) { return up_to(later_than(after, result.window_begin), until); };
      result.window_end      = window_end(Column::P, Column::P_quasi_static);
      double support_end     = largest(rows, Column::support_displacement) > 0.
                                   ? window_end(Column::Q_support, Column::Q_quasi_static)
                                   : result.window_end;
      support_end            = std::max(support_end, result.window_end);
      auto ringing           = detect_ringing(window(result.window_end));
      result.first_frequency = ringing.frequency;
      // P may ring fast at first and vibrate with a slow support for long.
      if (support_end > result.window_end)
      {
        const auto whole        = window(support_end);
        const auto last_tenth   = later_than(whole, (1. - last_share) * support_end + last_share * result.window_begin);
        const auto long_ringing = detect_ringing(whole);
        const bool lasts        = rms(last_tenth) > decayed_rms * largest_reference(whole);
        const bool is_slow      = ringing.frequency * (result.window_end - result.window_begin) < window_periods;
        if (lasts && (is_slow || long_ringing.frequency < slower * ringing.frequency))
        {
          result.window_end = support_end;
          ringing           = long_ringing;
        }
      }
      const double sliding = std::max(result.window_begin, find_sliding(rows, turn.time, result.window_end));
      add_normal_force(result, after, ringing, sliding, rows, face_size);
      add_force_along_x(collect_samples(rows, Column::Q, Column::Q_quasi_static, turn.time, end), sliding, result.window_begin,
                        result.window_end, result.overshoot_Q, result.frequency_Q, result.rms_Q);
      add_force_along_x(collect_samples(rows, Column::Q_support, Column::Q_quasi_static, turn.time, end), sliding,
                        result.window_begin, support_end, result.overshoot_Q_support, result.frequency_Q_support,
                        result.rms_Q_support);
      return result;
    }
  } // namespace

  Warnings element_passing_warnings(const std::vector<Oscillation> &oscillations, const double face_size)
  {
    const auto found = std::find_if(oscillations.begin(), oscillations.end(),
                                    [](const Oscillation &each) { return std::isfinite(each.passing_frequency); });
    if (found == oscillations.end())
      return {};
    return { make_warning("element_passing", { mm(found->x), rounded_text(found->frequency), mm(face_size),
                                               rounded_text(found->passing_frequency) }) };
  }

  std::vector<Oscillation> oscillations(const std::vector<Row> &rows, const Drive &drive, const double face_size)
  {
    const auto &turns     = drive.reversals();
    const double duration = drive.reversal_duration();
    const auto second     = count_levers(rows) == 2 ? lever_rows(rows, 1) : std::vector<Row>();
    std::vector<Oscillation> result;
    for (std::size_t i = 0; i < turns.size(); ++i)
    {
      const double next = i + 1 < turns.size() ? turns[i + 1] - duration / 2. : drive.duration();
      const auto found  = [&](const std::vector<Row> &lever)
      { return oscillation_at(lever, drive.at(turns[i], Drive::Side::after), duration, next, face_size); };
      result.push_back(found(rows));
      if (second.empty())
        continue;
      result.back().lever = 1.;
      if (auto other = found(second); is_worse(other, result.back()))
      {
        other.lever   = 2.;
        result.back() = other;
      }
    }
    return result;
  }

  Swing largest_swing(const std::vector<Row> &rows, const std::vector<Oscillation> &reversals, const double reversal_duration)
  {
    if (count_levers(rows) == 2)
    {
      const auto first  = largest_swing(lever_rows(rows, 0), reversals, reversal_duration);
      const auto second = largest_swing(lever_rows(rows, 1), reversals, reversal_duration);
      return second.size > first.size ? second : first;
    }
    const auto is_behind_reversal = [&](const double time)
    {
      return std::any_of(reversals.begin(), reversals.end(),
                         [&](const Oscillation &found)
                         { return time >= found.time - 0.5 * reversal_duration && time <= found.window_end; });
    };
    Swing result;
    std::optional<double> extreme; // the last one
    double before = unknown, direction = 0.;
    for (const auto &row : rows)
    {
      const double difference = row[Column::P] - row[Column::P_quasi_static];
      if (!std::isfinite(difference) || is_behind_reversal(row[Column::time]))
      {
        extreme.reset();
        before    = unknown;
        direction = 0.;
        continue;
      }
      const double change = difference - before;
      if (change * direction < 0.)
      {
        if (extreme && 0.5 * std::abs(before - *extreme) > result.size)
          result = { 0.5 * std::abs(before - *extreme), row[Column::x], 0. };
        extreme = before;
      }
      if (change != 0. && std::isfinite(change))
        direction = change;
      before = difference;
    }
    result.scale = largest(rows, Column::P_quasi_static);
    return result;
  }

  std::vector<Entry> swing_entries(const Swing &swing)
  {
    constexpr double least     = 0.05; ///< over the largest P without inertia
    std::vector<Entry> entries = { { "swing_P", swing.size } };
    if (swing.size > least * swing.scale)
      entries.push_back({ "vibration", "P swings by " + rounded_text(swing.size) + " N to either side at x = " + mm(swing.x) });
    return entries;
  }

  std::vector<Entry> oscillation_entries(const std::vector<Oscillation> &oscillations)
  {
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < oscillations.size(); ++i)
    {
      const auto &found        = oscillations[i];
      const std::string prefix = "reversal_" + std::to_string(i + 1) + '_';
      append<Entry>(entries, { { prefix + "verdict", enumerator_name(found.verdict) },
                               { prefix + "time", found.time },
                               { prefix + "x", found.x },
                               { prefix + "frequency", found.frequency },
                               { prefix + "frequency_Q", found.frequency_Q },
                               { prefix + "frequency_Q_support", found.frequency_Q_support },
                               { prefix + "growth_rate", found.growth_rate },
                               { prefix + "open_share", found.open_share },
                               { prefix + "stick_share", found.stick_share },
                               { prefix + "overshoot_P", found.overshoot_P },
                               { prefix + "overshoot_Q", found.overshoot_Q },
                               { prefix + "overshoot_Q_support", found.overshoot_Q_support },
                               { prefix + "rms", found.rms },
                               { prefix + "rms_end", found.rms_end },
                               { prefix + "P_scale", found.scale },
                               { prefix + "passing_frequency", found.passing_frequency },
                               { prefix + "rms_Q", found.rms_Q },
                               { prefix + "rms_Q_support", found.rms_Q_support },
                               { prefix + "extent", found.extent } });
      if (std::isfinite(found.lever))
        entries.push_back({ prefix + "lever", found.lever });
    }
    return entries;
  }
} // namespace sprag
