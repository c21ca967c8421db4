// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"
#include "base/append.h"
#include "levers/prepared_scene.h"
#include "program/result_writer.h"
#include "report/report.h"
#include "run/analyses.h"
#include "run/briefs.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <cmath>
#include <fstream>
#include <iostream>

namespace sprag
{
  namespace
  {
    using Entries = std::vector<Entry>;

    /// Both files that a calibration writes are for runs with inertia.
    const std::string in_time = "Analysis/Type=transient";

    void write_scene(const std::string &file, const std::string &purpose, const Scene &scene)
    {
      std::ofstream stream(file);
      stream << "# " << purpose << '\n' << parameters_text(scene);
      stream.close();
      if (!stream)
        throw AnalysisError(file + " cannot be written");
    }

    Entries part_entries(const CalibratedParts &parts, const ReducedConstants &reduced)
    {
      Entries entries;
      if (parts.thickness)
        entries.push_back({ "leaf_thickness", *parts.thickness, "mm", "of the leaf spring, for the stiffness asked for" });
      if (parts.added && parts.scene.calibration.mass == AddedMass::tip)
        entries.push_back({ "tip_mass", *parts.added, "t", "at the tip, for the moment of inertia asked for" });
      else if (parts.added)
        entries.push_back({ "hub_inertia", *parts.added, "t mm^2", "at the hub, for the moment of inertia asked for" });
      entries.push_back({ "stiffness", reduced.stiffness, "N mm/rad", "k at rest" });
      entries.push_back({ "moment_of_inertia", reduced.moment_of_inertia, "t mm^2", "J about the pivot" });
      entries.push_back({ "bending_stiffness", reduced.bending.stiffness, "N mm^2", "EI of the beam that bends most like it" });
      entries.push_back({ "bending_error", reduced.bending.deflection_error, "1", "rms error of that beam's deflections" });
      entries.push_back({ "neutral_axis_offset", reduced.bending.neutral_axis_offset, "mm", "e_a of that beam" });
      const auto &law = reduced.contact.fit;
      entries.push_back({ "contact_stiffness", law.stiffness, "N/mm^n", "Contact/Stiffness" });
      entries.push_back({ "contact_exponent", law.exponent, "1", "Contact/Exponent" });
      entries.push_back({ "contact_error", law.rms_error, "1", "rms error of P of that law, relative" });
      return entries;
    }

    void add_frequencies(const std::string &name, const std::string &where, const std::array<std::vector<double>, 2> &found,
                         Entries &entries)
    {
      for (std::size_t i = 0; i < std::min(found[0].size(), found[1].size()); ++i)
      {
        const std::string number = std::to_string(i + 1);
        entries.push_back({ name + number, found[0][i], "Hz", "of the meshed lever " + where });
        entries.push_back({ name + number + "_beam", found[1][i], "Hz", "of the calibrated beam " + where });
        entries.push_back({ name + number + "_deviation", found[1][i] / found[0][i] - 1., "1", "of the beam from the mesh" });
      }
    }

    Entries disagreement_entries(const Disagreement &found)
    {
      Entries entries = { { "P_deviation", found.of_forces(0), "1",
                            "of the beam from the mesh in steady sliding, over the peak" },
                          { "Q_deviation", found.of_forces(1), "1", "the same of Q" } };
      add_frequencies("free_frequency_", "out of contact", found.free_frequencies, entries);
      add_frequencies("contact_frequency_", "in contact, without friction", found.contact_frequencies, entries);
      return entries;
    }
  } // namespace

  void run_calibration(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    require_folder(options);
    const auto parts      = calibrate_parts(scene);
    const auto reduced    = reduced_constants(parts.scene);
    const auto calibrated = variant(scene, joined(parts.overrides, { in_time, "Analysis/Model=condensed" }));
    const auto beam       = variant(scene, joined(joined(parts.overrides, reduced.overrides), { in_time }));
    const auto found      = compare(prepared(calibrated), prepared(beam));

    ResultWriter writer(scene, options, timer,
                        { { "x", "mm", "position of the cylinder" },
                          { "direction", "1", "1 forward, -1 backward" },
                          { "P", "N", "normal force of the meshed lever in steady sliding" },
                          { "P_beam", "N", "of the calibrated beam" },
                          { "Q", "N", "x-force of the meshed lever in steady sliding" },
                          { "Q_beam", "N", "of the calibrated beam" } });
    if (options.in_memory == nullptr)
    {
      write_scene(options.folder + "/calibrated.prm", "Calibrated parts, in time, condensed", calibrated);
      write_scene(options.folder + "/beam.prm", "The beam calibrated by their mesh, in time", beam);
    }
    for (const auto &point : found.sliding)
      writer.append(std::vector<double>{ point.x, point.direction, point.forces[0].P, point.forces[1].P, point.forces[0].Q,
                                         point.forces[1].Q });
    const auto summary = joined(part_entries(parts, reduced), disagreement_entries(found));
    const auto end     = writer.finish("completed", { summary }, warnings);
    if (options.quiet)
      return;
    if (options.verbose)
      print_summary(std::cout, end.summary);
    else
      print_brief_of_calibration(std::cout, end.summary);
    std::cout << "\nScenes: " << options.folder << "/calibrated.prm, " << options.folder << "/beam.prm\n";
  }
} // namespace sprag
