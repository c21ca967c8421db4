// SPDX-License-Identifier: GPL-3.0-only
#include "input/read.h"

#include "base/errors.h"
#include "base/local_regression.h"
#include "base/ranges.h"
#include "base/table_file.h"
#include "base/text.h"
#include "input/analysis_texts.h"
#include "input/check.h"
#include "input/own_units.h"
#include "input/section.h"
#include "input/sections.h"
#include "input/variation.h"
#include "scene/analysis_use.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

namespace sprag
{
  namespace
  {
    /// Automatic face size of runs that report pressures. In time cells of 0.5 mm tilt under the stiffer penalty, and P is 2 %
    /// off where the contact is 1.3 mm wide.
    constexpr double driven_face_size = 0.25; ///< [mm]

    /// Faces across the contact, by degree, with which the largest pressure is within 1 %.
    constexpr double enough_faces[] = { 5., 4. };

    /// Augmentations are cheap where the lever is factorised once. Chords of degree 1 need soft contact to follow a circle.
    Enforcement automatic_enforcement(const Scene &scene)
    {
      return is_factorised_once(scene) && scene.mesh.degree == 2 && !scene.contact.penalty ? Enforcement::augmented_lagrangian
                                                                                           : Enforcement::penalty;
    }

    /// Sets the face size, the number of faces in contact and the enforcement of contact of the scene that are read from its
    /// other settings where they are left to the program.
    void make_discretisation(SceneSettings &settings)
    {
      Scene &scene                = settings.scene;
      const bool is_static        = scene.analysis.type == AnalysisType::quasi_static;
      const bool is_driven        = is_static || scene.analysis.type == AnalysisType::transient;
      scene.mesh.face_size        = settings.face_size.value_or(is_driven ? driven_face_size : scene.mesh.face_size);
      const double enough         = enough_faces[scene.mesh.degree == 1 ? 0 : 1];
      scene.mesh.faces_in_contact = settings.faces_in_contact.value_or(is_static ? enough : 0.);
      scene.contact.enforcement   = settings.enforcement.value_or(automatic_enforcement(scene));
    }

    /// Returns the parameters that were given or chosen, without those left at their defaults.
    ParameterValues set_values(const Scene &scene)
    {
      ParameterValues result;
      for (const auto &name : scene.specified)
        result[name] = scene.parameters->at(name);
      for (const auto &[name, before] : scene.chosen)
        result[name] = scene.parameters->at(name);
      return result;
    }

    std::vector<std::string> names_in(const std::vector<std::string> &overrides)
    {
      return mapped(overrides, [](const auto &text) { return trim(text.substr(0, text.find('='))); });
    }

    /// Reports the mistakes met on the way to a scene against the parameters they come from.
    class SceneReader
    {
    public:
      SceneReader(const std::function<Settings(const std::vector<Parameter> &)> &read, const std::string &folder,
                  const std::map<std::string, std::string> &chosen = {})
          : parameters(scene_parameters(input))
          , settings(read(parameters))
      {
        input.scene.folder = folder;
        input.scene.chosen = chosen;
      }

      Scene scene()
      {
        convert_own_units();
        for (const auto &parameter : parameters)
          if (parameter.name == material_parameter)
            use_material(parameter.section, full_name(parameter));
        store();
        make_drive();
        make_friction();
        read_analysis_texts(input.scene, parameters, reporter());
        check_unused();
        check();
        check_ranges();
        read_study();
        read_dimension();
        read_accuracy();
        if (!settings.mistakes.empty())
          throw InputError(settings.mistakes);
        input.scene.name       = std::filesystem::path(settings.file).stem().string();
        input.scene.parameters = std::make_shared<const ParameterValues>(values());
        return input.scene;
      }

    private:
      SceneSettings input;
      std::vector<Parameter> parameters;
      Settings settings;
      std::set<std::string> filled_in; ///< names of the parameters whose values are those of a material

      ParameterValues values() const
      {
        ParameterValues result;
        for (const auto &parameter : parameters)
          result.emplace(full_name(parameter), parameter.default_value);
        for (const auto &[name, setting] : settings.specified)
          result[name] = setting.value;
        return result;
      }

      std::string setting_value(const std::string &name) const
      {
        const auto found = settings.specified.find(name);
        return found != settings.specified.end() ? found->second.value : find_parameter(parameters, name)->default_value;
      }

      /// Until all was read, some units are not known.
      void convert_own_units()
      {
        const auto look_up = [this](const std::string &name) { return setting_value(name); };
        for (const auto &parameter : parameters)
          if (depends_on_others(parameter.rule))
            convert(parameter,
                    [&](const std::string &text)
                    {
                      const auto number = number_text(in_own_unit(parameters, parameter, text, look_up));
                      return kept_value(parameter.rule, number);
                    });
        for (const std::string name : { "Stability/Critical", "Stability/Ranges" })
          convert(*find_parameter(parameters, name),
                  [&](const std::string &text) { return ranges_in_own_units(parameters, text, look_up); });
      }

      void convert(const Parameter &parameter, const std::function<std::string(const std::string &)> &converted)
      {
        const auto found = settings.specified.find(full_name(parameter));
        if (found == settings.specified.end())
          return;
        try
        {
          if (const auto value = converted(found->second.value); value != found->second.value)
            found->second = { found->second.place, value, found->second.value };
        }
        catch (const InputError &broken)
        {
          report(found->first, broken.what());
          settings.specified.erase(found);
        }
      }

      /// Fills in the values of a section's material that the section does not set; one of --set replaces those of the file too.
      void use_material(const std::string &section, const std::string &names_it)
      {
        const auto named = settings.specified.find(names_it);
        if (named == settings.specified.end())
          return;
        const auto [place, material, written] = named->second;
        bool is_idle                          = material != "none";
        for (const auto &[name, text] : value_for(materials(), material))
          if (const auto *parameter = find_parameter(parameters, section + '/' + name))
          {
            const auto value = kept_value(parameter->rule, text);
            const auto own   = settings.specified.find(full_name(*parameter));
            const bool fills = own == settings.specified.end() || (place == "--set" && own->second.place != "--set");
            is_idle          = is_idle && !fills && leading_number(own->second.value)->value != leading_number(value)->value;
            if (fills)
            {
              settings.specified[full_name(*parameter)] = { names_it, value, "that of " + material };
              filled_in.insert(full_name(*parameter));
            }
          }
        if (is_idle)
          report(names_it, "has no effect, as this section sets other constants");
      }

      void store()
      {
        for (const auto &parameter : parameters)
          if (const auto found = settings.specified.find(full_name(parameter)); found != settings.specified.end())
          {
            auto written = found->second.written;
            if (parameter.rule.kind == Rule::Kind::file && std::filesystem::path(found->second.value).is_relative())
              written = found->second.value;
            if (parameter.rule.kind == Rule::Kind::file || found->first == "Condensed/Cache")
              resolve(found->second.value);
            parameter.store(found->second.value);
            if (input.scene.chosen.count(found->first) == 0 && filled_in.count(found->first) == 0)
            {
              input.scene.specified.insert(found->first);
              if (found->second.place == "--set")
                input.scene.by_option.insert(found->first);
            }
            if (!written.empty())
              input.scene.written.emplace(found->first, written);
          }
        input.scene.slope.maximum_inclination = input.maximum_inclination * M_PI / 180.;
        make_time_tolerance();
        make_model();
        make_discretisation(input);
      }

      /// The analysis of the scene, or that of the runs of a study.
      AnalysisType run_type() const
      {
        const auto type = input.scene.analysis.type;
        return type == AnalysisType::study ? input.scene.study.type : type;
      }

      /// Until it is chosen, the model is the dearest that a choice may end at. Under a table levers are those of the closed form
      /// unless another model is given, and so is the lever of a measured stroke; the printed parameters then give it.
      void make_model()
      {
        Scene &scene                     = input.scene;
        scene.accuracy.is_dimension_open = !input.dimension;
        scene.analysis.dimension         = input.dimension.value_or(2);
        const auto type                  = run_type();
        const bool is_closed             = type == AnalysisType::isolation || type == AnalysisType::identification;
        if (is_closed && settings.specified.count("Analysis/Model") == 0)
        {
          scene.analysis.model                       = ModelType::closed_form;
          settings.specified["Analysis/Model"].value = "closed form";
          return;
        }
        const bool is_static         = type == AnalysisType::quasi_static;
        scene.accuracy.is_model_open = !input.model;
        scene.analysis.model         = input.model.value_or(is_static ? ModelType::finite_element : ModelType::condensed);
      }

      void read_dimension()
      {
        const auto type = run_type();
        if (!input.dimension && type != AnalysisType::quasi_static && type != AnalysisType::stability &&
            type != AnalysisType::transient)
          report("Analysis/Dimension", "auto is for Analysis/Type = quasi-static, stability and transient");
      }

      /// Reads the requested accuracy. Rules that depend on the model or on a target are left to each run of a study.
      void read_accuracy()
      {
        AccuracySettings &accuracy = input.scene.accuracy;
        const auto possible        = accuracy_quantities(run_type());
        const bool is_study        = input.scene.analysis.type == AnalysisType::study;
        if (accuracy.is_model_open && !accuracy.chooses_settings() && !is_study)
          report("Analysis/Model", "auto needs Accuracy/Target or Accuracy/Budget");
        const bool is_model_chosen = input.scene.chosen.count("Analysis/Model") > 0;
        if (accuracy.chooses_settings() && !possible.empty() && follows_formulas(input.scene) && !is_study && !is_model_chosen)
          report("Analysis/Model", "must be auto or a model that solves for the contact where an accuracy is asked for");
        if (accuracy.chooses_settings() && possible.empty())
          report(accuracy.target > 0. ? "Accuracy/Target" : "Accuracy/Budget",
                 "counts only along the drive and for held slides, where errors are told");
        if (accuracy.chooses_settings() && !input.scene.output.errors)
          report("Output/Errors", "off needs Accuracy/Target = 0 and Accuracy/Budget = 0, which count by these errors");
        accuracy.quantities = quantities_meant(accuracy.quantity, run_type());
        const bool is_read  = accuracy.chooses_settings() || !input.dimension; // which is chosen by them
        for (const auto &name : accuracy.quantities)
          if (is_read && !contains(possible, name))
            report("Accuracy/Quantity", "'" + name + "' is none of " + boost::algorithm::join(possible, ", "));
      }

      /// The printed parameters give a step, so that they must give the tolerance too.
      void make_time_tolerance()
      {
        const double by_step                       = settings.specified.count("Time/Step") > 0 ? 0. : input.scene.time.tolerance;
        input.scene.time.tolerance                 = input.time_tolerance.value_or(by_step);
        settings.specified["Time/Tolerance"].value = number_text(input.scene.time.tolerance);
      }

      void make_drive()
      {
        const DriveSettings &drive = input.drive;
        if (drive.profile == DriveProfile::table)
          return use_table("Drive/Table", drive.table, { { "time", "t" }, "s" }, { { "x", "position", "displacement" }, "mm" },
                           [&](const auto &times, const auto &positions)
                           { input.scene.drive = Drive(times, smoothed(times, positions)); });
        if (drive.stroke > drive.start)
          input.scene.drive = Drive(drive.profile, drive.start, drive.stroke, drive.speed, drive.cycles, reversal_duration());
        else if (!is_invalid("Drive/Stroke") && !is_invalid("Drive/Start"))
          report("Drive/Stroke", "must be more than Start = " + mm(drive.start));
      }

      /// A fit below the lowest row would be a drive that goes farther back than was measured.
      std::vector<double> smoothed(const std::vector<double> &times, const std::vector<double> &positions) const
      {
        const double width = input.drive.smoothing;
        const bool grows   = std::is_sorted(times.begin(), times.end());
        if (width == 0. || !grows || positions.empty())
          return positions;
        auto result         = locally_fitted(times, positions, width);
        const double lowest = *std::min_element(positions.begin(), positions.end());
        for (double &x : result)
          x = std::max(x, lowest);
        return result;
      }

      void make_friction()
      {
        FrictionCurve &law = input.scene.friction.law;
        if (input.friction.law != FrictionChoice::table)
          law = input.friction.curve();
        else
          use_table("Friction/Table", input.friction.table, { { "speed", "velocity", "v" }, "mm/s" },
                    { { "mu", "coefficient", "friction", "\u00B5", "\u03BC" }, "" },
                    [&law](const auto &speeds, const auto &coefficients) { law = TabulatedFriction(speeds, coefficients); });
      }

      void check()
      {
        for (const auto &violation : violations(input.scene))
        {
          const auto known = [this](const auto &name) { return !is_invalid(name); };
          if (known(violation.parameter) && std::all_of(violation.others.begin(), violation.others.end(), known))
            report(violation.parameter, violation.rule);
        }
      }

      void check_ranges()
      {
        const Scene &scene = input.scene;
        if (is_invalid("Analysis/Type"))
          return;
        if (scene.analysis.type == AnalysisType::map)
        {
          check_range("Map/First parameter", scene.map.first);
          check_range("Map/Second parameter", scene.map.second);
          if (scene.map.first.name == scene.map.second.name)
            report("Map/Second parameter", "must be another than First parameter");
        }
        const auto check_list = [this](const std::string &parameter, const auto &ranges, const std::string &besides)
        {
          if (!ranges)
            return report(parameter, "must be " + besides + " or a list of SECTION/NAME FROM TO separated by semicolons");
          for (const auto &range : *ranges)
            check_range(parameter, range);
        };
        if (scene.analysis.type == AnalysisType::stability || scene.analysis.type == AnalysisType::map)
        {
          const auto ranges = uncertain_ranges(scene);
          check_list("Stability/Ranges", ranges, "none");
          std::set<std::string> names;
          for (const auto &range : ranges.value_or(std::vector<ParameterRange>()))
            if (!names.insert(range.name).second)
              report("Stability/Ranges", range.name + " must be there once only");
            else if (range.name == "Stability/Position")
              report("Stability/Ranges", range.name + " is no constant: Stability/Position = auto judges the whole stroke");
          if (names.size() > 10)
            report("Stability/Ranges", "must be at most 10 parameters, as all combinations of their ends are judged");
          if (settings.mistakes.empty())
            check_ends(ranges.value_or(std::vector<ParameterRange>()));
        }
        if (scene.analysis.type == AnalysisType::stability)
          check_list("Stability/Critical", critical_searches(scene), "auto, none");
      }

      void read_study()
      {
        if (is_invalid("Analysis/Type") || input.scene.analysis.type != AnalysisType::study)
          return;
        StudySettings &study   = input.scene.study;
        const auto varied      = parse_variation(study.vary, parameters, input.scene.folder, true);
        const auto reference   = parse_variation(study.reference, parameters, input.scene.folder, false);
        study.varied           = varied.parameters;
        study.reference_values = reference.parameters;
        for (const auto &mistake : varied.mistakes.empty() ? combination_mistakes(study) : varied.mistakes)
          report("Study/Vary", mistake);
        for (const auto &mistake : joined(reference.mistakes, reference_mistakes(study)))
          report("Study/Reference", mistake);
        keep_paths("Study/Vary", study.vary, study.varied);
        keep_paths("Study/Reference", study.reference, study.reference_values);
      }

      /// Keeps absolute paths in the text, as resolve() does.
      void keep_paths(const std::string &parameter, std::string &text, const std::vector<VariedParameter> &read)
      {
        const auto is_file = [this](const VariedParameter &varied)
        { return find_parameter(parameters, varied.name)->rule.kind == Rule::Kind::file; };
        if (std::any_of(read.begin(), read.end(), is_file))
          settings.specified[parameter].value = text = variation_text(read);
      }

      /// The parameter must be one of a number, and both ends keep its rule.
      void check_range(const std::string &parameter, const ParameterRange &range)
      {
        const auto numeric = [](const Parameter &p)
        { return p.rule.kind == Rule::Kind::number || p.rule.kind == Rule::Kind::number_or_auto; };
        const auto candidates      = filtered(parameters, numeric);
        const auto parameter_found = find_parameter(candidates, range.name);
        if (parameter_found == nullptr)
          return report(parameter, range.name + " is no parameter with a number" +
                                       did_you_mean(nearest(range.name, mapped(candidates, full_name))));
        if (!counts(*parameter_found))
          return report(parameter, range.name + " counts only with " + parameter_found->choice + " = " + parameter_found->chosen +
                                       (parameter_found->section == "Friction" ? "; Friction/Factor multiplies any law" : ""));
        for (const double value : { range.from, range.to })
          if (const auto broken = violation(parameter_found->rule, number_text(value)))
            return report(parameter, range.name + " = " + number_text(value) + " " + *broken);
        if (range.from == range.to)
          report(parameter, range.name + " must have a range, not " + number_text(range.from) + " alone");
      }

      /// The scene must be valid with all combinations of the ends.
      void check_ends(const std::vector<ParameterRange> &ranges)
      {
        const SceneSettings kept = input;
        for (unsigned int corner = 0; corner < 1u << ranges.size() && settings.mistakes.empty(); ++corner)
        {
          std::string ends;
          for (std::size_t i = 0; i < ranges.size(); ++i)
          {
            const double value = (corner >> i & 1u) == 0 ? ranges[i].from : ranges[i].to;
            find_parameter(parameters, ranges[i].name)->store(number_text(value));
            ends += (i == 0 ? "with " : ", ") + ranges[i].name + " = " + rounded_text(value);
          }
          make_drive();
          for (const auto &violation : violations(input.scene))
            report("Stability/Ranges", ends + ": " + violation.parameter + ' ' + violation.rule);
          input = kept;
        }
      }

      /// A default beside a choice given in the same place passes: so do the printed parameters.
      void check_unused()
      {
        for (const auto &parameter : parameters)
        {
          const auto name  = full_name(parameter);
          const auto found = settings.specified.find(name);
          if (counts(parameter) || found == settings.specified.end() || found->second.value.empty() || is_invalid(name))
            continue;
          const auto chosen    = settings.specified.find(parameter.choice);
          const auto by_option = [](const Setting &setting) { return setting.place == "--set"; };
          const bool chosen_as_well =
              chosen != settings.specified.end() && (by_option(chosen->second) || !by_option(found->second));
          if (found->second.value != parameter.default_value || !chosen_as_well)
            report(name, "counts only with " + parameter.choice + " = " + parameter.chosen);
        }
      }

      bool counts(const Parameter &parameter) const
      {
        if (parameter.choice.empty() || is_invalid(parameter.choice))
          return true;
        return setting_value(parameter.choice) == parameter.chosen;
      }

      /// 0 wherever it does not count or does not fit.
      double reversal_duration()
      {
        const DriveSettings &drive = input.drive;
        if (input.scene.analysis.type != AnalysisType::transient || drive.profile != DriveProfile::triangle)
          return 0.;
        const double largest = Drive::largest_reversal_duration(drive.start, drive.stroke, drive.speed, drive.cycles);
        if (drive.reversal <= largest)
          return drive.reversal;
        const std::vector<std::string> others = { "Analysis/Type", "Drive/Profile", "Drive/Start",
                                                  "Drive/Stroke",  "Drive/Speed",   "Drive/Cycles" };
        if (std::none_of(others.begin(), others.end(), [this](const auto &name) { return is_invalid(name); }))
          report("Drive/Reversal duration", "must be at most " + rounded_text((1. - 5e-6) * largest) +
                                                " s, or the ramps of speed do not fit into the shortest stroke");
        return 0.;
      }

      struct TableColumn
      {
        ColumnNames names;
        std::string unit; ///< that its values are wanted in
      };

      void use_table(const std::string &parameter, const std::string &file, const TableColumn &first, const TableColumn &second,
                     const std::function<void(const std::vector<double> &, const std::vector<double> &)> &use)
      {
        read_file(parameter, file, reporter(),
                  [&]
                  {
                    const auto table = read_two_columns(file, first.names, second.names);
                    use(values_in(first.unit, table.columns[0]), values_in(second.unit, table.columns[1]));
                    input.scene.unused_columns[parameter] = table.unused;
                  });
      }

      /// The printed parameters hold absolute paths, so that they can be read back from anywhere.
      void resolve(std::string &path) const
      {
        if (!path.empty())
          path = (std::filesystem::path(input.scene.folder) / path).lexically_normal().string();
      }

      void report(const std::string &parameter, const std::string &rule)
      {
        add_mistake(settings, parameters, parameter, rule);
        settings.invalid.insert(parameter);
      }

      ReportMistake reporter()
      {
        return [this](const auto &name, const auto &rule) { report(name, rule); };
      }

      bool is_invalid(const std::string &parameter) const
      {
        return settings.invalid.count(parameter) > 0;
      }
    };

    Scene changed(const Scene &scene, const std::vector<std::string> &overrides, const std::map<std::string, std::string> &chosen)
    {
      const auto read = [&](const auto &declared)
      {
        auto settings = override_settings(scene.name + ".prm", set_values(scene), overrides, declared);
        for (const auto &name : scene.by_option)
          settings.specified[name].place = "--set";
        return settings;
      };
      Scene result = SceneReader(read, scene.folder, chosen).scene();
      for (const auto &[name, text] : scene.written)
        if (result.specified.count(name) > 0 && result.parameters->at(name) == scene.parameters->at(name))
          result.written.emplace(name, text);
      return result;
    }
  } // namespace

  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides)
  {
    return SceneReader([&](const auto &declared) { return read_settings(file, overrides, declared); },
                       std::filesystem::absolute(file).parent_path().string())
        .scene();
  }

  Scene variant(const Scene &scene, const std::vector<std::string> &overrides)
  {
    auto chosen = scene.chosen;
    for (const auto &name : names_in(overrides))
      chosen.erase(name);
    return changed(scene, overrides, chosen);
  }

  Scene with_chosen(const Scene &scene, const std::vector<std::string> &overrides)
  {
    auto chosen = scene.chosen;
    for (const auto &name : names_in(overrides))
      chosen.emplace(name, scene.parameters->at(name));
    return changed(scene, overrides, chosen);
  }

  std::string parameters_text(const Scene &scene)
  {
    SceneSettings defaults;
    if (!scene.parameters)
      return {};
    const auto parameters = scene_parameters(defaults);
    auto values           = *scene.parameters;
    for (const auto &[name, before] : scene.chosen)
      values[name] = before;
    std::set<std::string> open; // an auto that was chosen no longer counts as specified
    for (const auto &parameter : parameters)
    {
      const auto name    = full_name(parameter);
      const bool is_auto = values[name] == "auto";
      const bool is_read = scene.specified.count(name) > 0 || (is_auto && scene.chosen.count(name) > 0);
      if (!is_read || (is_auto && parameter.default_value == "auto"))
        open.insert(name);
    }
    return parameters_text(parameters, values, scene.written, open);
  }

  std::string specified_parameters_text(const Scene &scene)
  {
    SceneSettings defaults;
    const auto specified = filtered(scene_parameters(defaults),
                                    [&](const auto &parameter) { return scene.specified.count(full_name(parameter)) > 0; });
    return parameters_text(specified, *scene.parameters, scene.written);
  }

  std::string default_parameters_text()
  {
    return parameters_text(SceneReader([](const auto &) { return Settings(); }, {}).scene());
  }
} // namespace sprag
