// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/identification.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "base/text.h"
#include "base/unknown.h"
#include "input/analysis_texts.h"
#include "input/read.h"
#include "program/result_writer.h"
#include "report/summary_lines.h"
#include "results/page_tables.h"
#include "results/result_file.h"
#include "results/row_statistics.h"
#include "run/run.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iosfwd>
#include <iostream>
#include <ostream>
#include <set>
#include <vector>

namespace sprag
{
  namespace
  {
    std::string to_word(const ForceChannel &channel)
    {
      return word_for(force_words(), channel.force);
    }

    /// Least share of independent values in residuals that are noise of sensors.
    constexpr double least_independent = 0.3;
    constexpr double least_deviation   = 1e-3; ///< smaller residuals, over the largest force, are round-off

    /// Returns true if residuals are correlated as those of a model that does not fit the measurement.
    bool is_not_followed(const ForceChannel &channel, const ChannelNoise &noise)
    {
      const double peak = largest(channel.values, [](const double value) { return value; });
      return noise.effective_rows() < least_independent * noise.rows && noise.deviation > least_deviation * peak;
    }

    /// Returns what to do about forces that are exchanged or have the wrong sign, empty where there are none. A lever presses,
    /// and friction gives no work back: P is positive, and Q no larger on the way back than on the way out, in the mean.
    std::string mistaken_force(const Scene &scene, const StrokeFit &fit, const Identification &found)
    {
      /// Returns the mean of a force on the way out (1) or back (-1); NaN without values.
      const auto mean = [&](const MeasuredForce force, const int direction)
      {
        double sum = 0., number = 0.;
        for (const auto &value : found.used)
          if (scene.identification.measured.channels[value.channel].force == force &&
              fit.motion.strokes()[value.stroke].direction * direction > 0)
          {
            sum += value.value;
            ++number;
          }
        return sum / number;
      };
      const double P_out = mean(MeasuredForce::normal, 1), P_back = mean(MeasuredForce::normal, -1);
      const double Q_out = mean(MeasuredForce::drive, 1), Q_back = mean(MeasuredForce::drive, -1);
      if (P_out * P_back < 0. && Q_out * Q_back > 0.)
        return "Exchange P and Q: as measured, P turns with the motion and Q does not.";
      if (P_out < 0. || P_back < 0.)
        return "Turn the sign of P: as measured, the lever pulls at the cylinder.";
      return Q_out < Q_back ? "Turn the sign of Q: as measured, friction gives work back to the drive." : "";
    }

    /// Prepends the unknowns that would explain the residuals to a remedy; what mistaken_force() says replaces it.
    std::string another_remedy(const std::string &remedy, const Identification &found, const std::string &mistaken)
    {
      if (!mistaken.empty())
        return mistaken;
      const auto named = mapped(found.more, [](const auto &more)
                                { return more.name + " (by about " + with_unit(more.change, more.unit) + ")"; });
      return (named.empty() ? "" : "Check " + boost::algorithm::join(named, " or ") + ", which would explain the residuals. ") +
             remedy;
    }

    std::vector<ColumnInfo> identification_columns(const MeasuredStroke &measured)
    {
      std::string names = measured.time.empty() ? "x v direction used" : "time x v direction used";
      for (const auto &channel : measured.channels)
      {
        const auto word = to_word(channel);
        names += ' ' + word + ' ' + word + "_fitted " + word + "_residual";
      }
      return page_columns("identification", names);
    }

    /// Returns the rows of the columns, one a row of the measurement.
    std::vector<std::vector<double>> identification_rows(const MeasuredStroke &measured, const StrokeFit &fit,
                                                         const Identification &found)
    {
      std::set<std::size_t> used;
      for (const auto &value : found.used)
        used.insert(value.row);
      std::vector<std::vector<double>> result;
      const double lag = found.lever.lag;
      for (std::size_t row = 0; row < measured.rows(); ++row)
      {
        const auto stroke = fit.motion.stroke_at(row, lag);
        const auto place  = fit.motion.at(row, lag, stroke);
        std::vector<double> values;
        if (!measured.time.empty())
          values.push_back(measured.time[row]);
        const double direction = fit.motion.strokes()[stroke].direction;
        values.insert(values.end(), { place.x, place.v, direction, used.count(row) > 0 ? 1. : 0. });
        const bool is_known = fit.motion.covers(row, lag, stroke) && place.x >= 0.;
        const auto slide    = is_known ? fit.slide(found.lever, found.correction, row, stroke) : std::nullopt;
        for (std::size_t channel = 0; channel < measured.channels.size(); ++channel)
        {
          const double computed_force = slide ? fit.computed_force(found.lever, *slide, channel) : unknown;
          const double value          = measured.channels[channel].values[row];
          values.insert(values.end(), { value, computed_force, value - computed_force });
        }
        result.push_back(values);
      }
      return result;
    }

    std::vector<Entry> identification_summary(const Scene &scene, const Identification &found)
    {
      std::vector<Entry> result;
      for (const auto &[number, value, deviation, low, high] : found.found)
        append<Entry>(result, { { number.name, value, number.unit, number.meaning },
                                { number.name + "_low", low, number.unit },
                                { number.name + "_high", high, number.unit },
                                { number.name + "_deviation", deviation, number.unit } });
      result.push_back({ "theta0", kinematics(found.lever.geometry, 0.).theta });
      const auto &channels = scene.identification.measured.channels;
      for (std::size_t i = 0; i < channels.size(); ++i)
      {
        const auto word = to_word(channels[i]);
        append<Entry>(result, { { "noise_" + word, found.noise[i].deviation },
                                { "values_" + word, found.noise[i].rows },
                                { "effective_values_" + word, found.noise[i].effective_rows() } });
      }
      const auto &known = found.uncertainty;
      append<Entry>(result, { { "reversal_window", found.window },
                              { "degrees_of_freedom", known.freedom },
                              { "rounds", static_cast<double>(found.rounds) },
                              { "indistinct", boost::algorithm::join(known.indistinct, " ") },
                              { "weak", boost::algorithm::join(known.weak, " ") } });
      return result;
    }

    /// Returns the group /identification: names, values, deviations, correlation and singular values with their directions.
    std::vector<Group> identification_groups(const Identification &found)
    {
      const auto n         = found.found.size();
      const auto &known    = found.uncertainty;
      const auto value     = [](const FoundNumber &one) { return one.value; };
      const auto deviation = [](const FoundNumber &one) { return one.deviation; };
      const auto scale     = [](const FoundNumber &one) { return one.number.scale; };
      const auto column    = [](const std::string &name) { return page_column("identification", name); };
      Group group{ "identification",
                   { make_dataset(found.found, column("values"), value),
                     make_dataset(found.found, column("deviations"), deviation),
                     make_dataset(found.found, column("scales"), scale),
                     { column("correlation"), known.correlation, { n, n } },
                     { column("singular_values"), known.singular.values, {} },
                     { column("directions"), known.singular.directions, { n, n } } } };
      group.texts = { make_texts(found.found, "names", "of the unknowns",
                                 [](const FoundNumber &one) { return one.number.name; }) };
      return { group };
    }

    /// Returns the warnings that follow from what was found.
    Warnings identification_warnings(const Scene &scene, const StrokeFit &fit, const Identification &found)
    {
      Warnings warnings;
      std::vector<std::string> not_followed;
      const auto &channels = scene.identification.measured.channels;
      for (std::size_t i = 0; i < channels.size(); ++i)
        if (const auto &noise = found.noise[i]; is_not_followed(channels[i], noise))
          not_followed.push_back(formatted("%.0f", noise.rows) + " values of " + to_word(channels[i]) + " are worth " +
                                 formatted("%.0f", noise.effective_rows()) + " independent ones");
      if (!not_followed.empty())
      {
        auto warning   = make_warning("model_does_not_follow", { boost::algorithm::join(not_followed, ", ") });
        warning.remedy = another_remedy(warning.remedy, found, mistaken_force(scene, fit, found));
        warnings.push_back(warning);
      }
      const auto &indistinct = found.uncertainty.indistinct;
      if (!indistinct.empty())
        warnings.push_back(make_warning("indistinct_unknowns", { boost::algorithm::join(indistinct, " ") }));
      if (found.window_is_full)
        warnings.push_back(make_warning("long_vibration"));
      if (!found.converged)
        warnings.push_back(make_warning("not_converged", { std::to_string(found.rounds) }));
      return warnings;
    }

    /// Returns the lines of /answer: the unknowns with their intervals, the noise, what is left out and what is weak.
    std::vector<AnswerLine> identification_lines(const Scene &scene, const Identification &found)
    {
      std::vector<AnswerLine> lines;
      for (const auto &one : found.found)
        lines.push_back({ one.number.name, with_unit(one.value, "") + " +- " + formatted("%.2g", one.high - one.value) +
                                               (one.number.unit == "1" ? "" : " " + one.number.unit) });
      const auto &channels = scene.identification.measured.channels;
      for (std::size_t i = 0; i < channels.size(); ++i)
        lines.push_back({ "noise of " + to_word(channels[i]),
                          with_unit(found.noise[i].deviation, "N") + ", " + formatted("%.0f", found.noise[i].rows) +
                              " values worth " + formatted("%.0f", found.noise[i].effective_rows()) + " independent ones" });
      lines.push_back({ "left out", mm(found.window) + " behind the beginning and each reversal" +
                                        (scene.identification.window ? "" : ", from the data") });
      for (const auto &sentence : found.uncertainty.weak)
        lines.push_back({ "weak", sentence });
      lines.push_back({ "+-", "half of the interval of " + formatted("%.4g", 100. * scene.identification.confidence) + " %" });
      return lines;
    }

    /// Writes a quasi-static scene of the closed form with the identified values, and its friction table. Returns why the values
    /// make no valid scene; empty if they do.
    std::string write_scene(const Scene &scene, const RunOptions &options, const LeverUnknowns &unknowns,
                            const Identification &found)
    {
      const auto folder = std::filesystem::absolute(options.folder);
      std::filesystem::remove(folder / "identified.prm"); // of a run before
      std::string table;
      if (const auto rows = unknowns.friction_rows(mapped(found.found, &FoundNumber::value)); !rows.empty())
      {
        table            = (folder / "identified-friction.csv").string();
        std::string text = "speed [mm/s], mu\n";
        for (const auto &[speed, mu] : rows)
          text += number_text(speed) + ", " + number_text(mu) + '\n';
        write_file(table, text);
      }
      try
      {
        auto numbers = found.found;
        for (auto &one : numbers)
          if (one.number.name == "rest" && one.low <= 0.) // no clearance where the data admit none, as a scene asks for
          {
            one.value = std::min(one.value, 0.);
            one.high  = std::min(one.high, 0.);
          }
        const auto values = mapped(numbers, &FoundNumber::value);
        const auto ranges = unknowns.ranges(values, mapped(numbers, &FoundNumber::low), mapped(numbers, &FoundNumber::high));
        const auto identified =
            variant(scene, joined(unknowns.overrides(unknowns.lever(values), table),
                                  { "Analysis/Type=quasi-static", "Analysis/Model=closed form", "Stability/Ranges=" + ranges }));
        write_file(folder / "identified.prm",
                   "# What was identified from " + scene.identification.table + '\n' + parameters_text(identified));
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return {};
    }
  } // namespace

  void run_identification(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const MeasuredMotion motion(scene);
    const LeverUnknowns unknowns(scene, motion);
    const StrokeFit fit(scene, motion, unknowns);
    const auto &measured = scene.identification.measured;
    ResultWriter writer(scene, options, identification_columns(measured));
    Identification found;
    std::string no_scene;
    finish_in_any_case(
        [&]
        {
          found = identify(scene, motion, unknowns);
          end_if_interrupted();
        },
        [&](const std::string &status)
        {
          if (found.found.empty())
            return void(writer.finish(status, {}, warnings));
          for (const auto &row : identification_rows(measured, fit, found))
            writer.append(row);
          append(warnings, identification_warnings(scene, fit, found));
          if (options.in_memory == nullptr)
            no_scene = write_scene(scene, options, unknowns, found);
          writer.finish(
              status,
              { identification_summary(scene, found), {}, identification_groups(found), {}, identification_lines(scene, found) },
              warnings);
        });
    if (!no_scene.empty())
      throw AnalysisError("The values found are no scene, identified.prm is not written: " + no_scene);
    if (!options.quiet && options.in_memory == nullptr)
      std::cout << "\nScene: " << options.folder << "/identified.prm\n";
  }
} // namespace sprag
