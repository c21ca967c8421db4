// SPDX-License-Identifier: GPL-3.0-only
#include "base/append.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "base/text.h"
#include "program/result_writer.h"
#include "run/analyses.h"
#include "run/identification_report.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace sprag
{
  namespace
  {
    void write(const std::string &file, const std::string &text)
    {
      std::ofstream stream(file);
      stream << text;
      stream.close();
      if (!stream)
        throw AnalysisError(file + " cannot be written");
    }

    /// The scene with what was found, without inertia by the closed form, and its friction's table. Returns what keeps the values
    /// from being a scene, empty where nothing does.
    std::string write_scene(const Scene &scene, const RunOptions &options, const LeverUnknowns &unknowns,
                            const Identification &found)
    {
      const auto folder = std::filesystem::absolute(options.folder);
      std::vector<double> values;
      for (const auto &one : found.found)
        values.push_back(one.value);
      std::string table;
      if (const auto rows = unknowns.friction_rows(values); !rows.empty())
      {
        table            = (folder / "identified-friction.csv").string();
        std::string text = "speed [mm/s], mu\n";
        for (const auto &[speed, mu] : rows)
          text += number_text(speed) + ", " + number_text(mu) + '\n';
        write(table, text);
      }
      try
      {
        const auto identified = variant(scene, joined(unknowns.overrides(found.lever, table),
                                                      { "Analysis/Type=quasi-static", "Analysis/Model=closed form" }));
        write(folder / "identified.prm",
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
    PhaseTimer timer;
    require_folder(options);
    const MeasuredMotion motion(scene);
    const LeverUnknowns unknowns(scene, motion);
    const StrokeFit fit(scene, motion, unknowns);
    const auto &measured = scene.identification.measured;
    ResultWriter writer(scene, options, timer, identification_columns(measured));
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
          for (const auto &warning : identification_warnings(scene, found))
            warnings.push_back(warning);
          if (options.in_memory == nullptr)
            no_scene = write_scene(scene, options, unknowns, found);
          writer.finish(status, { identification_summary(scene, found), {}, identification_groups(found) }, warnings);
          if (!options.quiet)
            print_identification(std::cout, scene, found);
        });
    if (!no_scene.empty())
      throw AnalysisError("The values found are no scene, identified.prm is not written: " + no_scene);
    if (!options.quiet && options.in_memory == nullptr)
      std::cout << "\nScene: " << options.folder << "/identified.prm\n";
  }
} // namespace sprag
