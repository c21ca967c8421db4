// SPDX-License-Identifier: GPL-3.0-only
#include "program/result_writer.h"

#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "base/system/memory.h"
#include "base/system/process_time.h"
#include "base/version.h"
#include "input/read.h"
#include "input/sections.h"
#include "program/run_options.h"
#include "report/console_summary.h"
#include "report/report.h"
#include "report/summary_lines.h"
#include "results/entries.h"
#include "scene/scene.h"

#include <petscversion.h>

#include <fstream>
#include <gmsh.h>
#include <iostream>

namespace sprag
{
  namespace
  {
    /// Returns the versions of program and libraries, and the time [s] and memory that the process has used.
    std::vector<Entry> process_entries(const PhaseTimer &timer)
    {
      std::vector<Entry> entries = { { "version", version() },
                                     { "deal.II", SPRAG_DEAL_II_VERSION },
                                     { "PETSc", std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) +
                                                    "." + std::to_string(PETSC_VERSION_SUBMINOR) },
                                     { "gmsh", GMSH_API_VERSION } };
      for (const auto &[name, phase] : timer.phases())
        entries.push_back({ "wall_time_" + name, phase.wall });
      for (const auto &[name, phase] : timer.phases())
        entries.push_back({ "cpu_time_" + name, phase.cpu });
      entries.push_back({ "cpu_time", PhaseTimer::cpu_seconds() });
      entries.push_back({ "peak_memory", peak_memory() / (1024. * 1024.) });
      return entries;
    }
  } // namespace

  void write_file(const std::string &path, const std::string &text)
  {
    std::ofstream stream(path);
    stream << text;
    stream.close();
    if (!stream)
      throw AnalysisError(path + " cannot be written");
  }

  ResultWriter::ResultWriter(const Scene &scene_, const RunOptions &options_, const std::vector<ColumnInfo> &columns,
                             const PhaseTimer *const timer_, const FacePoints &points)
      : scene(scene_)
      , options(options_)
      , timer(timer_)
  {
    if (options.in_memory != nullptr)
    {
      options.in_memory->found = {};
      return;
    }
    prepare_folder(scene, options);
    file.emplace(options.folder + "/result.h5", parameters_text(scene), points, columns);
  }

  void ResultWriter::keep(const Row &row)
  {
    if (scene.analysis.type == AnalysisType::quasi_static)
      options.in_memory->found.curve.push_back({ row[Column::x], row[Column::v], row[Column::P], row.drive_force() });
  }

  RunEnd ResultWriter::finish(const std::string &status, RunEnd end, Warnings &warnings)
  {
    describe_entries("entry", to_word(scene.analysis.type), end.summary);
    sprag::append(warnings, target_warnings(scene.accuracy, end.accuracy));
    if (options.in_memory != nullptr)
    {
      options.in_memory->found.summary = end.summary;
      return end;
    }
    end.summary.push_back(status_entry(status));
    if (!options.chosen.empty())
      end.meta.push_back({ "chosen_settings", options.chosen });
    sprag::append(end.meta, process_entries(timer != nullptr ? *timer : PhaseTimer()));
    describe_entries("fact", "", end.meta);
    const auto answer = answer_lines(scene.analysis.type, end.summary, end.answer);
    end.groups.push_back(answer);
    file->finish(end.summary, end.meta, warnings, end.groups, accuracy_entries(end.accuracy));
    if (options.verbose)
    {
      for (const auto &[label, text] : end.answer)
        summary_line(std::cout, label, text);
      print_summary(std::cout, end.summary);
      print_accuracy(std::cout, end.accuracy);
    }
    else if (!options.quiet)
      print_console_summary(std::cout, answer, end.accuracy, PhaseTimer::cpu_seconds(), wall_seconds());
    return end;
  }
} // namespace sprag
