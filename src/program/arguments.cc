// SPDX-License-Identifier: GPL-3.0-only
#include "program/arguments.h"

#include "base/errors.h"
#include "base/pattern.h"
#include "base/ranges.h"
#include "base/shipped_file.h"
#include "base/system/file_content.h"
#include "base/text.h"
#include "base/version.h"
#include "input/read.h"
#include "input/sections.h"
#include "program/outcome.h"
#include "results/page_tables.h"
#include "scene/scene.h"

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <CLI/CLI.hpp>
#include <boost/algorithm/string/join.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    void declare(CLI::App &app, Arguments &arguments)
    {
      app.add_option("FILE.prm", arguments.file, "The scene: a parameter file; see params/README.md");
      app.add_option("--set", arguments.overrides, "\"Section/Name=value\": overrides a parameter of the file; may be repeated")
          ->allow_extra_args(false);
      auto *const new_file = app.add_option(
          "--new", arguments.new_file, "Write a scene of a device to begin with, asking for its values on a terminal, and stop");
      app.add_option("--from", arguments.shipped_scene, "Scene of sprag that --new copies, as model-a")->needs(new_file);
      app.add_option("--output", arguments.folder, "Folder for results; default output/NAME_OF_THE_FILE");
      app.add_flag("--overwrite", arguments.overwrite, "Replace whatever result is in that folder, and begin anew");
      app.add_flag("--validate", arguments.validate, "Check the file and stop");
      app.add_flag("--print-parameters{prm}", arguments.print_parameters,
                   "Print every parameter with its meaning and stop; =xml for parameter_gui of deal.II")
          ->check(CLI::IsMember({ "prm", "xml" }).description(""));
      auto *const quiet = app.add_flag("--quiet", arguments.quiet, "Print errors only");
      app.add_flag("--verbose", arguments.verbose, "Print every result that is in /summary")->excludes(quiet);
      app.add_flag("--trust-scripts", arguments.trust_scripts,
                   "Let a .geo in Mesh/File do all that you may, not only read its own folder; see meshes/README.md");
      app.add_option("--jobs", arguments.jobs, "Processes that work on a map or study; default: one a core")
          ->check(CLI::Range(1u, 4096u));
      app.set_help_flag(
          "-h,--help",
          "Print this help and stop; with SECTION, SECTION/NAME or the name of a result in place of FILE.prm, what that means");
      app.set_version_flag("--version", "sprag " + version());
      app.footer(
          "Exit status: 0 success, 1 the analysis failed or was interrupted (finished steps are kept), 2 bad input (nothing "
          "is written).");
    }

    /// Reports the mistakes that are found. Returns the exit status.
    template <class Work>
    int report_mistakes(const Work &work)
    {
      try
      {
        work();
        return success;
      }
      catch (const InputError &error)
      {
        return report_error(error);
      }
    }

    /// Returns the answer to a question on the terminal, a value that the parameter takes; the present one where there is none.
    std::string answer(const std::string &question, const Parameter &parameter, const std::string &present)
    {
      for (std::string typed;;)
        try
        {
          std::cout << question << " [" << present << "]: " << std::flush;
          if (!std::getline(std::cin, typed) || trim(typed).empty())
            return present;
          kept_value(parameter.rule, trim(typed));
          return escaped(trim(typed));
        }
        catch (const InputError &error)
        {
          report_error(error);
        }
    }

    /// Lists the parameters of friction laws for which --new asks.
    const std::map<std::string, std::vector<std::string>> law_parameters = {
      { "Coulomb", { "Coefficient" } },
      { "cork on aluminium", {} },
      { "Stribeck", { "Static coefficient", "Kinetic coefficient", "Stribeck speed" } },
      { "table", { "Table" } }
    };

    /// Returns lines that set the parameters of a friction law to values that are typed on the terminal.
    std::vector<std::string> ask_for_law(const std::vector<Parameter> &parameters, const std::string &law)
    {
      std::vector<std::string> lines;
      for (const auto &name : law_parameters.at(law))
      {
        const auto &parameter = *find_parameter(parameters, "Friction/" + name);
        const auto present    = name == "Table" ? "mu.csv" : trim(parameter.default_value + ' ' + parameter.rule.unit);
        lines.push_back("  set " + name + " = " + answer(full_name(parameter) + ", " + parameter.meaning, parameter, present));
      }
      return lines;
    }

    /// Returns a scene with the values that are typed on the terminal in place of its own.
    std::string ask_for_values(const std::string &scene)
    {
      SceneSettings settings;
      const auto parameters = scene_parameters(settings);
      std::istringstream lines(scene);
      std::string text, section, law;
      for (std::string line; std::getline(lines, line); text += line + '\n')
      {
        if (line.rfind("subsection ", 0) == 0)
          section = line.substr(line.find(' ') + 1) + '/';
        const auto equals = line.find(" = "), comment = line.find(" # ");
        const auto name             = section + trim(line.substr(0, equals)).substr(line.rfind("  set ", 0) == 0 ? 4 : 0);
        const auto *const parameter = find_parameter(parameters, name);
        if (parameter == nullptr)
          continue;
        if (name == "Friction/Coefficient" && law != "Coulomb")
        {
          line = boost::algorithm::join(ask_for_law(parameters, law), "\n");
          continue;
        }
        const auto typed =
            answer(name + ", " + line.substr(comment + 3), *parameter, trim(line.substr(equals + 3, comment - equals - 3)));
        line = line.substr(0, equals + 3) + typed + line.substr(comment);
        if (name == "Friction/Law")
          law = typed;
      }
      return text;
    }

    /// Copies a scene of the program to a new file, and asks for its values where there is a terminal and no scene is named.
    /// Returns the exit status.
    int write_new_scene(const Arguments &arguments)
    {
      namespace fs           = std::filesystem;
      const auto &name       = arguments.shipped_scene;
      const fs::path folder  = fs::path(shipped_file("params/own-device.prm")).parent_path();
      const fs::path shipped = folder / (name + ".prm");
      std::error_code error;
      std::vector<std::string> names;
      for (const auto &entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".prm")
          names.push_back(entry.path().stem());
      if (!contains(names, name))
        return report_error(
            InputError("--from " + name + ": there is no such scene" + did_you_mean(nearest(fs::path(name).stem(), names))));
      if (contains_match(read_whole_file(shipped.string(), 1 << 20), R"(\n\s*set [^#\n]*\.(csv|geo|msh)\b)"))
        return report_error(InputError("--from " + name + ": that scene reads files of its folder; copy it together with them"));
      const bool asks = name == Arguments().shipped_scene && ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0 &&
                        !fs::exists(arguments.new_file);
      const auto text = asks ? ask_for_values(read_whole_file(shipped.string(), 1 << 20)) : "";
      if (!fs::copy_file(shipped, arguments.new_file, error))
        return report_error(InputError("--new " + arguments.new_file + ": " + error.message() +
                                       (error == std::errc::file_exists ? "; no file is replaced, name another" : "")));
      if (asks)
        std::ofstream(arguments.new_file) << text;
      std::cout << arguments.new_file
                << (asks ? ": your device, to be run" : ": a copy of " + shipped.filename().string() + ", to be edited and run")
                << "\n";
      return asks ? report_mistakes([&] { read_scene(arguments.new_file); }) : success;
    }

    /// Words before a name, by the kinds of tables on pages that help_text() searches.
    const std::map<std::string, std::string> kinds_in_words = {
      { "entry", "/summary/" }, { "column", "column " }, { "fact", "/meta/" }, { "warning", "warning " }
    };

    /// Returns a cell in words: where a line of the console summary is printed, `!` marks headlines and `?` hides 0.
    std::string cell_in_words(std::string text)
    {
      std::string marks;
      for (; !text.empty() && (text.front() == '!' || text.front() == '?'); text.erase(0, 1))
        marks += text.front() == '!' ? ", a headline" : ", not if 0";
      return text + marks;
    }

    /// Writes what the pages say of an entry, column, fact or warning; empty where they have none of this name.
    std::string result_text(const std::string &name)
    {
      std::string text;
      for (const auto &[kind, heading, row] : page_places(name))
      {
        const auto words = kinds_in_words.find(kind);
        if (words == kinds_in_words.end())
          continue;
        const auto unit = row.cells.find("unit");
        text += words->second + name + (unit == row.cells.end() || unit->second.empty() ? "" : " [" + unit->second + ']') + '\n';
        for (const auto &line : split_lines(boost::erase_all_copy(heading.substr(3), "`"), 100))
          text += "  " + line + '\n';
        for (const auto &[column, cell] : row.cells)
          if (column != "unit" && !cell.empty())
            for (const auto &line : split_lines(column + ": " + cell_in_words(cell), 100))
              text += "  " + line + '\n';
      }
      return text;
    }

    /// Explains a name. Of a section, or of a parameter "Section/Name", it writes the parameters with their defaults and
    /// documentation; capitals do not matter, and "Name" stands for all parameters of that name that no result has. Of an entry
    /// or column of results, or of a warning, it writes the rows of the tables that are built into the program. Throws InputError
    /// with the nearest name where there is none.
    std::string help_text(const std::string &name)
    {
      SceneSettings defaults;
      std::vector<Parameter> found, namesakes;
      std::vector<std::string> names;
      for (const auto &parameter : scene_parameters(defaults))
      {
        if (boost::algorithm::iequals(parameter.name, name))
          namesakes.push_back(parameter);
        for (const auto &candidate : { parameter.section, full_name(parameter) })
          if (boost::algorithm::iequals(candidate, name))
            found.push_back(parameter);
        names.insert(names.end(), { parameter.section, full_name(parameter) });
      }
      const auto entry = name.substr(name.rfind('/') + 1);
      if (auto text = result_text(entry); found.empty() && !text.empty())
        return text;
      if (found.empty())
        found = namesakes;
      if (!found.empty())
        return parameters_text(found, { { "Time/Tolerance", number_text(defaults.scene.time.tolerance) } });
      for (const auto &table : page_tables())
        if (kinds_in_words.count(table.kind) > 0)
          for (const auto &[row, cells] : table.rows)
            names.push_back(row);
      throw InputError("--help " + name + ": there is no such section, parameter, result or warning" +
                       did_you_mean(nearest(name, names)));
    }

    /// Returns a message for each word that looks like an option and is none.
    std::vector<std::string> find_unknown_options(const CLI::App &app)
    {
      const auto names = mapped(app.get_options(), [](const CLI::Option *option) { return option->get_name(); });
      std::vector<std::string> messages;
      for (const auto &word : app.remaining())
        if (const auto name = word.substr(0, word.find('=')); name[0] == '-')
          messages.push_back(name + ": there is no such option" + did_you_mean(nearest(name, names)));
      return messages;
    }
  } // namespace

  std::optional<int> read_arguments(int argc, char **argv, Arguments &arguments)
  {
    CLI::App app("Finite-element contact of the linear friction damper of Yamaguchi & Yoshida");
    declare(app, arguments);
    try
    {
      app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp &help)
    {
      const auto &words = app.get_option("FILE.prm")->results();
      return words.empty() ? app.exit(help) : report_mistakes([&] { std::cout << help_text(words.front()); });
    }
    catch (const CLI::ExtrasError &error)
    {
      const auto unknown_options = find_unknown_options(app);
      return unknown_options.empty() ? app.exit(error), bad_input : report_error(InputError(unknown_options));
    }
    catch (const CLI::ParseError &error)
    {
      return app.exit(error) == 0 ? success : bad_input;
    }
    if (arguments.new_file.empty())
      return {};
    for (const auto *option : app.get_options([](const CLI::Option *each) { return each->count() > 0; }))
      if (const auto name = option->get_name(); name != "--new" && name != "--from")
        return report_error(InputError("--new goes with --from alone, not with " + name + ": type 'sprag --new " +
                                       arguments.new_file + "' and then 'sprag " + arguments.new_file + "' with other options"));
    return write_new_scene(arguments);
  }

  bool is_run(const Arguments &arguments)
  {
    return !arguments.validate && arguments.print_parameters.empty();
  }
} // namespace sprag
