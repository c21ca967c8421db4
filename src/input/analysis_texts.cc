// SPDX-License-Identifier: GPL-3.0-only
#include "input/analysis_texts.h"

#include "base/errors.h"
#include "base/parameters.h"
#include "base/ranges.h"
#include "base/table_file.h"
#include "base/text.h"
#include "base/units.h"
#include "base/unknown.h"
#include "scene/design.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace sprag
{
  namespace
  {
    const std::set<std::string> free_sections = { "Geometry",          "Lever",   "Friction layer",
                                                  "Rotational spring", "Contact", "Isolation" };
    const std::string free_friction           = "Friction/Factor";
    constexpr std::size_t most_toleranced     = 4; ///< whose bounds have 16 combinations

    bool can_be_free(const Parameter &parameter)
    {
      return is_number(parameter.rule) && parameter.rule.kind != Rule::Kind::integer &&
             (free_sections.count(parameter.section) > 0 || full_name(parameter) == free_friction);
    }

    /// Reads all texts; a mistake is reported against the parameter that is being read.
    struct DesignReader
    {
      DesignSettings &settings;
      const std::vector<Parameter> &declared;
      const ReportMistake &report;
      std::string reading    = {};
      mutable bool is_faulty = false;

      void mistake(const std::string &what) const
      {
        is_faulty = true;
        report("Design/" + reading, what);
      }

      void read()
      {
        reading = "Free";
        read_bounds(settings.free, settings.free_parameters);
        if (settings.free_parameters.empty() && !is_faulty)
          mistake("must name a parameter and its bounds: Section/Name = FROM ... TO");
        reading = "Tolerances";
        read_bounds(settings.tolerances, settings.toleranced);
        if (settings.toleranced.size() > most_toleranced)
          mistake("must name at most " + std::to_string(most_toleranced) + " parameters");
        reading = "Demands";
        for (const auto &part : split(settings.demands, ';'))
          read_demand(single_spaced(part));
        reading = "Aim";
        read_aim(single_spaced(settings.aim));
        reading = "Second aim";
        if (!settings.second_aim.empty())
          read_aim(single_spaced(settings.second_aim));
        reading = "Judges";
        read_models();
        check_models();
      }

      /// Returns numbers of a group converted to `unit`; NaN for a text that is no number. Reports a unit that does not fit and
      /// returns none.
      std::optional<std::vector<double>> numbers_in(const std::string &unit, const std::vector<std::string> &texts,
                                                    const std::string &what) const
      {
        Rule rule;
        rule.kind          = Rule::Kind::number;
        rule.unit          = unit == "1" ? "" : unit;
        std::string number = boost::algorithm::join(texts, " and ");
        try
        {
          std::vector<double> result;
          for (const auto &text : with_common_unit(rule, texts))
          {
            number = text;
            result.push_back(leading_number(text) ? leading_number(kept_value(rule, text))->value : unknown);
          }
          return result;
        }
        catch (const InputError &error)
        {
          mistake("'" + what + "': " + number + ' ' + error.what());
          return {};
        }
      }

      void read_bounds(const std::string &text, std::vector<FreeParameter> &bounds) const
      {
        for (const auto &part : split(text, ';'))
          if (!part.empty())
            read_bounded(part, bounds);
      }

      void read_bounded(const std::string &part, std::vector<FreeParameter> &bounds) const
      {
        const auto equals = part.find('='), dots = part.find("...");
        if (dots == std::string::npos || equals > dots)
          return mistake("'" + part + "' must have the form Section/Name = FROM ... TO");
        const auto name            = single_spaced(part.substr(0, equals));
        const Parameter *parameter = free_parameter(name);
        if (parameter == nullptr)
          return;
        const auto bound = numbers_in(parameter->rule.unit,
                                      { trim(part.substr(equals + 1, dots - equals - 1)), trim(part.substr(dots + 3)) }, name);
        if (!bound)
          return;
        const double from = bound->at(0), to = bound->at(1);
        if (std::isnan(from) || std::isnan(to))
          return mistake("'" + part + "' must have the form Section/Name = FROM ... TO");
        for (const double value : { from, to })
          if (const auto broken = violation(parameter->rule, number_text(value)))
            return mistake(name + " = " + number_text(value) + " " + *broken);
        if (!(from < to))
          return mistake(name + " must have bounds of which the second is larger");
        bounds.push_back({ name, from, to, parameter->rule.unit.empty() ? "1" : parameter->rule.unit });
      }

      const Parameter *free_parameter(const std::string &name) const
      {
        const auto names       = mapped(filtered(declared, can_be_free), full_name);
        const Parameter *found = find_parameter(declared, name);
        if (found == nullptr || !can_be_free(*found))
        {
          mistake("'" + name + "' is no parameter that can be free" + did_you_mean(nearest(name, names)));
          return nullptr;
        }
        const auto is_same = [&](const FreeParameter &other) { return other.name == name; };
        const auto is_in = [&](const std::vector<FreeParameter> &list) { return std::any_of(list.begin(), list.end(), is_same); };
        if (is_in(settings.free_parameters) || is_in(settings.toleranced))
        {
          mistake(name + " must be there once only");
          return nullptr;
        }
        return found;
      }

      std::optional<DesignTerm> parse_term(const std::string &name) const
      {
        if (const auto quantity = find_design_quantity(name))
          return DesignTerm{ *quantity, 0 };
        const auto &free = settings.free_parameters;
        for (std::size_t i = 0; i < free.size(); ++i)
          if (free[i].name == name)
            return DesignTerm{ DesignQuantity::parameter, i };
        const auto names = joined(mapped(design_quantities(), &DesignQuantityInfo::name), mapped(free, &FreeParameter::name));
        mistake("'" + name + "' is neither a quantity nor a free parameter" + did_you_mean(nearest(name, names)));
        return {};
      }

      void read_demand(const std::string &text)
      {
        const auto sign = text.find_first_of("<>=");
        if (text.empty())
          return;
        if (sign == std::string::npos)
          return mistake("'" + text + "' must have the form QUANTITY <= VALUE, >= VALUE or = VALUE +- TOLERANCE");
        const bool is_equal = text[sign] == '=';
        const auto behind   = text.find_first_not_of("=", sign + 1);
        const auto right    = behind == std::string::npos ? std::string() : text.substr(behind);
        const auto within   = right.find("+-");
        const auto term     = parse_term(trim(text.substr(0, sign)));
        if (!term)
          return;
        const auto &free = settings.free_parameters;
        const auto &unit =
            term->quantity == DesignQuantity::parameter ? free[term->parameter].unit : design_quantity_info(term->quantity).unit;
        const auto numbers = numbers_in(
            unit, { trim(right.substr(0, within)), within == std::string::npos ? "" : trim(right.substr(within + 2)) }, text);
        if (!numbers)
          return;
        const double target = numbers->at(0), margin = numbers->at(1);
        if (std::isnan(target) || (is_equal ? !(margin > 0.) : within != std::string::npos))
          return mistake("'" + text + "' must have " +
                         (is_equal ? "a value and a tolerance > 0 behind =: VALUE +- TOLERANCE" : "a single number at its end"));
        const auto kind = is_equal ? DemandKind::equal : text[sign] == '<' ? DemandKind::at_most : DemandKind::at_least;
        settings.demanded.push_back({ *term, kind, target, is_equal ? margin : 0., text });
      }

      void read_aim(const std::string &text)
      {
        const auto blank        = text.find(' ');
        const std::string sense = text.substr(0, blank);
        if (blank == std::string::npos || (sense != "minimise" && sense != "maximise"))
          return mistake("must be minimise QUANTITY or maximise QUANTITY");
        if (const auto term = parse_term(text.substr(blank + 1)))
          settings.aims.push_back({ *term, sense == "maximise", text });
      }

      void read_models()
      {
        const auto listed = split(settings.checks, ',');
        if (listed == std::vector<std::string>{ "none" })
          return;
        const auto models = enumerators<CheckModel>();
        const auto names  = words_in(models);
        for (const auto &[word, check_model] : models)
          if (contains(listed, word))
            settings.check_models.push_back(check_model);
        for (const auto &word : listed)
          if (!contains(names, word))
            mistake("'" + word + "' is no judge beside others" + did_you_mean(nearest(word, names)));
      }

      void check_models() const
      {
        const auto has = [&](const CheckModel model) { return contains(settings.check_models, model); };
        for (const auto &aim : settings.aims)
          if (aim.term.quantity == DesignQuantity::growth_rate)
            report(&aim == &settings.aims.front() ? "Design/Aim" : "Design/Second aim",
                   "can be any quantity but the growth rate, which can be demanded");
        if (asks_for(settings, DesignQuantity::growth_rate) && !has(CheckModel::beam))
          mistake("must have beam where a growth rate is asked for, which the closed form does not know");
        if (has(CheckModel::table) && !asks_for(settings, DesignQuantity::transmissibility) &&
            !asks_for(settings, DesignQuantity::relative_amplitude))
          mistake("table counts only where transmissibility or relative amplitude is asked for");
      }
    };

    const char *const loop_parameter = "Isolation/Loop table";
    const char *const base_parameter = "Isolation/Base table";

    void need_increasing(const Samples &samples, const std::string &name)
    {
      if (samples.at.size() < 4)
        throw InputError("must have at least 4 rows, has " + std::to_string(samples.at.size()));
      for (std::size_t i = 1; i < samples.at.size(); ++i)
        if (!(samples.at[i] > samples.at[i - 1]))
          throw InputError(row_label(i) + name + " " + number_text(samples.at[i]) + ": must be more than in the row before");
    }

    /// Splits the rows at the largest x into outward and return stroke. Of two rows there, between which Q jumps, each stroke has
    /// its own.
    DamperLoop make_loop(const std::vector<double> &x, const std::vector<double> &forces)
    {
      const auto largest = std::max_element(x.begin(), x.end()) - x.begin();
      const auto begin =
          largest + 1 < static_cast<std::ptrdiff_t>(x.size()) && x[largest + 1] == x[largest] ? largest + 1 : largest;
      const auto until = [&](const std::vector<double> &all)
      { return std::vector<double>(all.begin(), all.begin() + largest + 1); };
      const auto after = [&](const std::vector<double> &all) { return std::vector<double>(all.rbegin(), all.rend() - begin); };
      DamperLoop loop{ { until(x), until(forces) }, { after(x), after(forces) } };
      for (const auto &[stroke, samples] :
           { std::make_pair("on the way out: ", loop.out), std::make_pair("on the way back: ", loop.back) })
      {
        if (samples.at.size() < 4)
          throw InputError(std::string(stroke) + "must have at least 4 rows, has " + std::to_string(samples.at.size()) +
                           ": x grows from 0 to its largest value and falls to 0 again");
        for (std::size_t i = 1; i < samples.at.size(); ++i)
          if (!(samples.at[i] > samples.at[i - 1]))
            throw InputError(std::string(stroke) + "x = " + number_text(samples.at[i]) + " mm does not change steadily");
        if (samples.at.front() != 0.)
          throw InputError(std::string(stroke) + "x = " + number_text(samples.at.front()) + " mm: must be 0 at the end");
      }
      return loop;
    }

    /// Requires that the loop dissipates energy.
    void need_dissipation(const DamperLoop &loop)
    {
      double area = 0.;
      for (const auto &[samples, sign] : { std::make_pair(loop.out, 1.), std::make_pair(loop.back, -1.) })
        for (std::size_t i = 1; i < samples.at.size(); ++i)
          area += sign * 0.5 * (samples.at[i] - samples.at[i - 1]) * (samples.values[i] + samples.values[i - 1]);
      if (area < 0.)
        throw InputError("Q is larger on the way back than on the way out: the loop gives " + rounded_text(-area) +
                         " N mm a round and dissipates nothing");
    }

    /// Factor to mm/s^2, of a spectrum to its square per Hz. What the file says must not contradict the scene.
    double acceleration_factor(const std::string &chosen_unit, const NamedColumn &column, const bool is_spectrum)
    {
      const bool is_set         = !chosen_unit.empty();
      const double acceleration = is_set ? unit_factor(chosen_unit, "mm/s2") : 1.;
      const double scene_factor = is_spectrum ? acceleration * acceleration : acceleration;
      if (column.unit.empty() && !is_set)
        throw InputError(
            "the unit of the acceleration is not known: give Isolation/Base unit = mm/s2, cm/s2, m/s2 or g, or a "
            "header as " +
            std::string(is_spectrum ? "'frequency [Hz], density [(m/s2)^2/Hz]'" : "'time [s], acceleration [m/s2]'") +
            ", or in HDF5 the dataset's attribute unit");
      if (column.unit.empty())
        return scene_factor;
      const double file_factor = factor_to(is_spectrum ? "(mm/s2)^2/Hz" : "mm/s2", column);
      if (is_set && std::abs(file_factor / scene_factor - 1.) > 1e-9)
        throw InputError("column '" + column.name + "': its unit is " + column.unit + ", which Isolation/Base unit contradicts");
      return file_factor;
    }

    void need_spectrum(const Samples &spectrum)
    {
      for (std::size_t i = 0; i < spectrum.at.size(); ++i)
      {
        if (spectrum.at[i] < 0.)
          throw InputError(row_label(i) + "frequency " + number_text(spectrum.at[i]) + " Hz: must be >= 0");
        if (spectrum.values[i] < 0.)
          throw InputError(row_label(i) + "density " + number_text(spectrum.values[i]) +
                           ": must be >= 0, as no spectrum is negative");
      }
      if (*std::max_element(spectrum.values.begin(), spectrum.values.end()) == 0.)
        throw InputError("must have a density above 0");
    }

    void read_base(IsolationSettings &settings, UnusedColumns &unused)
    {
      const bool is_spectrum = settings.base == BaseMotionType::random;
      const auto table    = is_spectrum ? read_two_columns(settings.base_file, { "frequency", "freq", "f" }, { "density", "psd" })
                                        : read_two_columns(settings.base_file, { "time", "t" }, { "acceleration", "acc", "a" });
      const double factor = acceleration_factor(settings.unit, table.columns[1], is_spectrum);
      settings.base_table = { values_in(is_spectrum ? "Hz" : "s", table.columns[0]), table.columns[1].values };
      need_increasing(settings.base_table, is_spectrum ? "frequency" : "time");
      if (is_spectrum)
        need_spectrum(settings.base_table);
      else if (settings.base_table.at.front() != 0.)
        throw InputError("row 1: time " + number_text(settings.base_table.at.front()) + " s: must be 0");
      for (double &value : settings.base_table.values)
        value *= factor;
      unused[base_parameter] = table.unused;
    }

    void read_loop(IsolationSettings &settings, UnusedColumns &unused)
    {
      const auto table       = read_two_columns(settings.loop_file, { "x", "displacement", "position" }, { "Q", "force" });
      settings.loop          = make_loop(values_in("mm", table.columns[0]), values_in("N", table.columns[1]));
      unused[loop_parameter] = table.unused;
      need_dissipation(settings.loop);
    }

    /// Reads the files that the settings use, whose paths are absolute or empty, and reports what is wrong with them.
    void read_isolation_tables(IsolationSettings &settings, UnusedColumns &unused, const ReportMistake &report)
    {
      if (settings.damper == DamperType::loop)
        read_file(loop_parameter, settings.loop_file, report, [&] { read_loop(settings, unused); });
      if (settings.base == BaseMotionType::record ||
          (settings.base == BaseMotionType::random && settings.spectrum == BaseSpectrum::table))
        read_file(base_parameter, settings.base_file, report, [&] { read_base(settings, unused); });
    }
  } // namespace

  void read_file(const std::string &parameter, const std::string &file, const ReportMistake &report,
                 const std::function<void()> &read)
  {
    if (file.empty())
      return report(parameter, "must name a file");
    try
    {
      read();
    }
    catch (const InputError &error)
    {
      for (const auto &message : error.messages)
        report(parameter, message);
    }
  }

  void read_analysis_texts(Scene &scene, const std::vector<Parameter> &declared, const ReportMistake &report)
  {
    // A design may demand quantities of the isolated table.
    const auto type = scene.analysis.type;
    if (type == AnalysisType::isolation || type == AnalysisType::design)
      read_isolation_tables(scene.isolation, scene.unused_columns, report);
    if (type == AnalysisType::design)
      DesignReader{ scene.design, declared, report }.read();
    if (type == AnalysisType::identification)
      read_identification(scene.identification, scene.unused_columns, report);
  }
} // namespace sprag
