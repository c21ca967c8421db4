// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"
#include "base/ranges.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "program/result_writer.h"
#include "results/page_tables.h"
#include "run/run.h"
#include "scene/scene.h"

#include <cmath>
#include <iostream>

namespace sprag
{
  namespace
  {
    using Entries = std::vector<Entry>;

    /// Both files that a calibration writes are for runs with inertia.
    const std::string in_time = "Analysis/Type=transient";

    Entries part_entries(const CalibratedParts &parts, const ReducedConstants &reduced)
    {
      Entries entries;
      if (parts.thickness)
        entries.push_back({ "leaf_thickness", *parts.thickness });
      if (parts.added)
        entries.push_back({ parts.scene.calibration.mass == AddedMass::tip ? "tip_mass" : "hub_inertia", *parts.added });
      const auto &beam = reduced.bending;
      const auto &law  = reduced.contact.fit;
      append<Entry>(entries, { { "stiffness", reduced.stiffness },
                               { "moment_of_inertia", reduced.moment_of_inertia },
                               { "bending_stiffness", beam.stiffness },
                               { "bending_error", beam.deflection_error },
                               { "neutral_axis_offset", beam.neutral_axis_offset },
                               { "contact_stiffness", law.stiffness },
                               { "contact_exponent", law.exponent },
                               { "contact_error", law.rms_error } });
      return entries;
    }

    void add_frequencies(const std::string &name, const std::array<std::vector<double>, 2> &found, Entries &entries)
    {
      for (std::size_t i = 0; i < std::min(found[0].size(), found[1].size()); ++i)
      {
        const std::string numbered = name + std::to_string(i + 1);
        append<Entry>(entries, { { numbered, found[0][i] },
                                 { numbered + "_beam", found[1][i] },
                                 { numbered + "_deviation", found[1][i] / found[0][i] - 1. } });
      }
    }

    Entries disagreement_entries(const Disagreement &found)
    {
      Entries entries = { { "P_deviation", found.force_deviation(0) }, { "Q_deviation", found.force_deviation(1) } };
      add_frequencies("free_frequency_", found.free_frequencies, entries);
      add_frequencies("contact_frequency_", found.contact_frequencies, entries);
      return entries;
    }
  } // namespace

  void run_calibration(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto parts      = calibrate_parts(scene);
    const auto reduced    = reduced_constants(parts.scene);
    const auto calibrated = variant(scene, joined(parts.overrides, { in_time, "Analysis/Model=condensed" }));
    const auto beam       = variant(scene, joined(joined(parts.overrides, reduced.overrides), { in_time }));
    const auto found      = compare(prepared(calibrated), prepared(beam));

    ResultWriter writer(scene, options, page_columns("calibration", "x direction P P_beam Q Q_beam"));
    if (options.in_memory == nullptr)
    {
      write_file(options.folder + "/calibrated.prm", "# Calibrated parts, in time, condensed\n" + parameters_text(calibrated));
      write_file(options.folder + "/beam.prm", "# The beam calibrated by their mesh, in time\n" + parameters_text(beam));
    }
    for (const auto &point : found.sliding)
      writer.append(std::vector<double>{ point.x, point.direction, point.forces[0].P, point.forces[1].P, point.forces[0].Q,
                                         point.forces[1].Q });
    const auto summary = joined(part_entries(parts, reduced), disagreement_entries(found));
    writer.finish("completed", { summary }, warnings);
    if (!options.quiet)
      std::cout << "\nScenes: " << options.folder << "/calibrated.prm, " << options.folder << "/beam.prm\n";
  }
} // namespace sprag
