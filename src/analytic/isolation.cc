// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/isolation.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace sprag
{
  namespace
  {
    /// State at the end of a period of the base: z, z'/(2 pi f) and the largest |z| of that period [mm].
    struct Instant
    {
      double z, rate_over_frequency, amplitude;
    };

    /// Decides whether the motion repeats, from the states at the ends of the base's periods.
    struct SteadyState
    {
      const std::vector<Instant> &instants;
      const double tolerance; ///< distance to the steady state, over the amplitude

      /// Returns the distance [mm] between the states at an instant and some periods earlier.
      double change(const std::size_t instant, const unsigned int periods) const
      {
        const auto &now = instants[instant], &before = instants[instant - periods];
        return std::hypot(now.z - before.z, now.rate_over_frequency - before.rate_over_frequency);
      }

      /// Extrapolates geometrically: with changes c_i and q = c_i/c_(i-1) the remaining distance is c_i q/(1 - q).
      bool repeats(const std::size_t instant, const unsigned int periods) const
      {
        constexpr double round_off = 1e-13;
        const double last = change(instant, periods), before = change(instant - periods, periods);
        const double amplitude = instants[instant].amplitude;
        if (last <= round_off * amplitude)
          return true;
        const double ratio = last / before;
        return ratio < 1. && last * ratio / (1. - ratio) <= tolerance * amplitude && last <= 1e3 * tolerance * amplitude;
      }

      /// Returns the shortest period that divides `repeating` and leaves a small change: an oscillating decay seems to repeat
      /// after several periods before it does after one.
      unsigned int shortest(const unsigned int repeating) const
      {
        const std::size_t last = instants.size() - 1;
        for (unsigned int p = 1; p < repeating; ++p)
          if (repeating % p == 0 && change(last, p) <= 4. * tolerance * instants[last].amplitude)
            return p;
        return repeating;
      }

      /// Returns after how many periods, at most 8, the motion repeats at the last two instants; none where it does not.
      std::optional<unsigned int> periods() const
      {
        constexpr unsigned int most = 8;
        for (unsigned int p = 1; p <= most && 2 * p + 2 <= instants.size(); ++p)
          if (repeats(instants.size() - 1, p) && repeats(instants.size() - 2, p))
            return shortest(p);
        return {};
      }
    };

    /// One period of a harmonic base: largest |z''_table| and |z|, integrals of the table's acceleration a (a^2, a cos wt,
    /// a sin wt) and number of stops.
    struct Period
    {
      double peak, displacement, square, cosine, sine;
      unsigned int stops;
    };

    /// Integrals of the squared accelerations of table and base, from the start of a run to the end of a section.
    struct Section
    {
      double square, base_square;
    };

    constexpr unsigned int random_sections = 13; ///< the first, in which the start dies out, does not count

    /// Returns the half-width of the 95 % interval of the ratio of root mean squares by the jackknife,
    /// t sqrt((n - 1)/n sum_i (r_i - mean)^2), with r_i the ratio without part i of n, each of so many sections, the first aside.
    double half_interval(const std::vector<Section> &ends, const std::size_t sections)
    {
      const std::size_t parts = (ends.size() - 1) / sections;
      const auto &first = ends.front(), &last = ends[parts * sections];
      std::vector<double> without;
      double mean = 0.;
      for (std::size_t i = 0; i < parts; ++i)
      {
        const auto &before = ends[i * sections], &end = ends[(i + 1) * sections];
        const double square      = last.square - first.square - (end.square - before.square);
        const double base_square = last.base_square - first.base_square - (end.base_square - before.base_square);
        without.push_back(std::sqrt(square / base_square));
        mean += without.back() / static_cast<double>(parts);
      }
      const double squares  = sum_over(without, [mean](const double ratio) { return std::pow(ratio - mean, 2); });
      const auto n          = static_cast<double>(parts);
      const double quantile = boost::math::quantile(boost::math::students_t(n - 1.), 0.975);
      return quantile * std::sqrt((n - 1.) / n * squares);
    }

    /// State from which an interrupted run resumes, beside its findings and the table.
    struct SolverState
    {
      std::size_t rows           = 1;
      unsigned int periods_ended = 0;
      unsigned int period_stops  = 0;
      bool has_ended             = false;
      std::vector<Instant> instants;  ///< at the ends of periods
      std::vector<Period> periods;    ///< the last 8
      std::vector<Section> sections;  ///< finished ones
      std::vector<double> last_turns; ///< z of the last two [mm]
      double square           = 0.;   ///< integral of the table's squared acceleration over finished periods
      double largest_energy   = 0.;
      double largest_residual = 0.;
    };

    SPRAG_SERIALISE(SolverState, rows, ended, stops, has_ended, instants, periods, sections, turns, square, energy, residual)

    /// Appends an item and drops the first one if there are more than `largest_size`.
    template <class Item>
    void append_limited(const Item &item, const std::size_t largest_size, std::vector<Item> &items)
    {
      items.push_back(item);
      if (items.size() > largest_size)
        items.erase(items.begin());
    }

    /// Runs a table to its end: stops at rows, ends of periods and of sections, and collects the findings.
    struct IsolationRun
    {
      const Scene &scene;
      IsolatedTable &motion;
      IsolationFindings &found;
      const RecordTable &record;
      const TableKeeper *const keeper;
      const IsolationSettings &settings = scene.isolation;
      const bool is_harmonic            = settings.base == BaseMotionType::harmonic;
      const double between_rows         = output_step(settings);
      SolverState solver                = {};

      void run()
      {
        if (keeper == nullptr || !keeper->progress.take_up(progress()))
        {
          update_extremes();
          write(false);
        }
        while (motion.state().time < settings.duration && !solver.has_ended)
        {
          const double row = static_cast<double>(solver.rows) * between_rows;
          const double end = period_end(), section = section_end();
          advance_to(std::min({ settings.duration, record ? row : settings.duration, end, section }));
          if (motion.state().time >= row)
            ++solver.rows;
          if (motion.state().time == end)
            end_period();
          if (motion.state().time == section)
            solver.sections.push_back({ motion.state().square, motion.state().base_square });
          accept_step();
        }
        if (keeper != nullptr)
          keeper->progress.end_steps(progress());
      }

      void conclude()
      {
        update_extremes();
        const auto &state = motion.state();
        found.time        = state.time;
        found.rests       = motion.rests();
        found.base_work   = state.base_work;
        found.dissipated  = state.dissipated;
        if (motion.rests())
          set_residual({ state.z, state.z });
        else if (solver.last_turns.size() == 2 && state.time > base_motion(settings).end)
          set_residual(solver.last_turns);
        solver.square += state.square;
        found.rms_acceleration = state.time > 0. ? std::sqrt(solver.square / state.time) : 0.;
        found.energy_residual  = solver.largest_energy > 0. ? solver.largest_residual / solver.largest_energy : 0.;
        if (is_harmonic)
          compute_period_ratios();
        else if (motion.largest_base_acceleration() > 0.)
        {
          found.peak           = motion.largest_acceleration() / motion.largest_base_acceleration();
          const auto &sections = solver.sections;
          const Section start  = sections.size() > 1 ? sections.front() : Section{ 0., 0. };
          found.rms            = std::sqrt((state.square - start.square) / (state.base_square - start.base_square));
          if (sections.size() == random_sections)
          {
            // Single sections are many, pairs and triples hang together less.
            const double half = std::max({ half_interval(sections, 1), half_interval(sections, 2), half_interval(sections, 3) });
            found.rms_low     = std::max(0., found.rms - half);
            found.rms_high    = found.rms + half;
          }
        }
      }

      /// The table comes to rest between its last two turns.
      void set_residual(const std::vector<double> &turns)
      {
        found.residual_offset    = 0.5 * (turns[0] + turns[1]);
        found.residual_amplitude = 0.5 * std::abs(turns[1] - turns[0]);
      }

      void check_energy() const
      {
        const double most = scene.analysis.maximum_residual;
        if (most > 0. && !(found.energy_residual <= most))
          throw AnalysisError("The energy ledger leaves " + rounded_text(found.energy_residual) +
                              " of the largest energy open, more than Analysis/Maximum energy residual = " + rounded_text(most) +
                              ". Try a smaller Isolation/Tolerance");
      }

      double period_end() const
      {
        return is_harmonic ? (solver.periods_ended + 1) / settings.base_frequency : std::numeric_limits<double>::infinity();
      }

      double section_end() const
      {
        return settings.base == BaseMotionType::random
                   ? std::min(1., static_cast<double>(solver.sections.size() + 1) / random_sections) * settings.duration
                   : std::numeric_limits<double>::infinity();
      }

      ProgressSerialiser progress()
      {
        return [this](Archive &archive)
        {
          archive(found, solver);
          keeper->serialise_table(archive);
        };
      }

      /// Ends an interrupted run here; findings and table must be complete up to this instant.
      void accept_step()
      {
        if (keeper != nullptr)
          keeper->progress.accept_step(progress());
        else
          end_if_interrupted();
      }

      void write(const bool is_before) const
      {
        if (record)
          record(motion, is_before);
      }

      void update_extremes()
      {
        const auto &state          = motion.state();
        const double largest       = std::max({ std::abs(state.base_work), state.dissipated, motion.energy() });
        solver.largest_energy      = std::max(solver.largest_energy, largest);
        solver.largest_residual    = std::max(solver.largest_residual, std::abs(motion.energy_residual()));
        found.largest_displacement = std::max(found.largest_displacement, motion.largest_displacement());
        found.largest_acceleration = std::max(found.largest_acceleration, motion.largest_acceleration());
      }

      void advance_to(const double until)
      {
        do
        {
          record_event(motion.advance(until));
          if (motion.state().time < until)
            accept_step();
        } while (motion.state().time < until);
        update_extremes();
        write(false);
      }

      void record_event(const TableEvent event)
      {
        if (event == TableEvent::none)
          return;
        const bool turns = event == TableEvent::turn || event == TableEvent::stop;
        if (turns)
        {
          ++found.turns;
          append_limited(motion.state().z, 2, solver.last_turns);
          write(true);
        }
        if (event == TableEvent::stop)
        {
          ++found.stops;
          ++solver.period_stops;
        }
        update_extremes();
        write(false);
      }

      void end_period()
      {
        const auto &state = motion.state();
        append_limited(Period{ motion.largest_acceleration(), motion.largest_displacement(), state.square, state.cosine,
                               state.sine, solver.period_stops },
                       8, solver.periods);
        solver.square += state.square;
        solver.instants.push_back({ state.z, state.rate / (2. * M_PI * settings.base_frequency), motion.largest_displacement() });
        ++solver.periods_ended;
        solver.period_stops = 0;
        motion.reset_period();
        const auto repeats = SteadyState{ solver.instants, periodic_tolerance(scene) }.periods();
        if (repeats && !found.is_steady)
          found.steady_from = state.time;
        found.is_steady  = repeats.has_value();
        found.periods    = repeats.value_or(1);
        solver.has_ended = repeats && settings.end == IsolationEnd::steady_state;
      }

      /// Averages over the periods after which the motion repeats, T long in all; a_base = X w^2: fundamental =
      /// 2/T |(int a cos wt, int a sin wt)| / a_base, rms = sqrt(2/T int a^2) / a_base.
      void compute_period_ratios()
      {
        found.periods = std::min<unsigned int>(found.periods, static_cast<unsigned int>(solver.periods.size()));
        if (found.periods == 0)
          return;
        Period sum{};
        for (auto period = solver.periods.end() - found.periods; period != solver.periods.end(); ++period)
        {
          sum.peak         = std::max(sum.peak, period->peak);
          sum.displacement = std::max(sum.displacement, period->displacement);
          sum.square += period->square;
          sum.cosine += period->cosine;
          sum.sine += period->sine;
          sum.stops += period->stops;
        }
        const double w = 2. * M_PI * settings.base_frequency, base = settings.base_amplitude * w * w;
        const double time        = found.periods / settings.base_frequency;
        found.relative_amplitude = sum.displacement;
        found.peak               = sum.peak / base;
        found.fundamental        = 2. / time * std::hypot(sum.cosine, sum.sine) / base;
        found.rms                = std::sqrt(2. * sum.square / time) / base;
        found.stops_a_period     = static_cast<double>(sum.stops) / found.periods;
      }
    };
  } // namespace

  double periodic_tolerance(const Scene &scene)
  {
    constexpr double displacement_error = 0.2; // over the tolerance of steps in time: a thousandth of its peak at the default
    return std::max(scene.isolation.periodic_tolerance,
                    isolates_by_model(scene) ? displacement_error * scene.time.tolerance : 0.);
  }

  double output_step(const IsolationSettings &settings)
  {
    if (settings.output_step)
      return *settings.output_step;
    const double natural   = 2. * M_PI * std::sqrt(settings.mass / settings.stiffness);
    const auto base        = base_motion(settings);
    const double base_step = std::min(0.01 * natural, 0.1 * base.shortest_period);
    // A recorded base motion needs rows at its own spacing to show its whole spectrum.
    const bool is_record = settings.base == BaseMotionType::record && !base.kinks.empty();
    return is_record ? std::min(base_step, base.kinks.back() / static_cast<double>(base.kinks.size())) : base_step;
  }

  void run_isolation(const Scene &scene, IsolatedTable &table, IsolationFindings &findings, const RecordTable &record,
                     const TableKeeper *const keeper)
  {
    IsolationRun run{ scene, table, findings, record, keeper };
    try
    {
      run.run();
    }
    catch (const AnalysisError &)
    {
      run.conclude();
      throw;
    }
    run.conclude();
    run.check_energy();
  }

  void run_isolation(const Scene &scene, IsolationFindings &findings, const RecordTable &record)
  {
    const auto &settings = scene.isolation;
    const auto table =
        make_table_motion(isolation_system(scene), settings.initial_displacement, settings.initial_velocity, settings.tolerance);
    run_isolation(scene, *table, findings, record);
  }
} // namespace sprag
