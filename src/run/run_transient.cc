// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient.h"
#include "base/ranges.h"
#include "base/text.h"
#include "estimate/dynamic_accuracy.h"
#include "levers/dynamics.h"
#include "program/recorder.h"
#include "results/entries.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/run.h"
#include "scene/analysis_use.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>

namespace sprag
{
  namespace
  {
    void announce(const std::vector<GrowingMode> &modes, const Scene &scene, const RunOptions &options)
    {
      if (options.quiet || modes.empty())
        return;
      const auto fastest = std::max_element(modes.begin(), modes.end(),
                                            [](const GrowingMode &a, const GrowingMode &b) { return a.frequency < b.frequency; });
      std::cout << "Grows:        a vibration of the slide, by " << rounded_text(fastest->growth_rate) << " 1/s at "
                << rounded_text(fastest->frequency) << " Hz at x = " << rounded_text(fastest->x) << " mm; steps of up to "
                << rounded_text(longest_step(modes, scene.time.spectral_radius)) << " s follow it\n"
                << std::flush;
    }

    std::vector<Entry> meshed_entries(const MeshedDynamics &lever, const Body &body)
    {
      std::vector<Entry> entries = { { "degrees_of_freedom", static_cast<double>(body.n_dofs()) },
                                     { "coordinates", static_cast<double>(lever.n_coordinates) },
                                     { "face_points", static_cast<double>(body.friction_face().points.size()) },
                                     { "penalty", lever.penalties.normal },
                                     { "tangential_penalty", lever.penalties.tangential },
                                     { "density_factor", lever.density_factor },
                                     { "moment_of_inertia", lever.moment_of_inertia },
                                     { "lever_mass", lever.total_mass },
                                     { "basis_from_cache", lever.basis_from_cache ? 1. : 0. },
                                     { "basis_cpu_time", lever.basis_cpu_seconds } };
      for (std::size_t i = 0; i < std::min<std::size_t>(5, lever.frequencies.size()); ++i)
        entries.push_back({ "frequency_" + std::to_string(i + 1), lever.frequencies[i] });
      return entries;
    }

    void announce(const MeshedDynamics &lever, const Body &body, const Scene &scene, const RunOptions &options)
    {
      if (options.quiet)
        return;
      std::cout << "Mesh:         " << body.n_dofs() << " displacements, " << lever.n_coordinates
                << " coordinates; densities times " << lever.density_factor << " to meet J; free lever at";
      for (std::size_t i = 0; i < std::min<std::size_t>(3, lever.frequencies.size()); ++i)
        std::cout << ' ' << lever.frequencies[i];
      std::cout << " Hz\n";
      if (scene.analysis.model == ModelType::condensed)
        std::cout << "Basis:        " << (lever.basis_from_cache ? "from the cache, saves " : "made in ")
                  << lever.basis_cpu_seconds << " s" << (lever.message.empty() ? "" : "; " + lever.message) << '\n';
      std::cout << std::flush;
    }

    FieldRecorder::Displacements recovery(const MeshedDynamics &lever, const unsigned int levers)
    {
      const auto displacements = [&lever, levers](const FieldSource &source)
      {
        Motion motion;
        motion.coordinates.position = source.coordinates;
        motion.face_force           = source.face_force;
        std::vector<dealii::Vector<double>> result;
        for (unsigned int i = 0; i < levers; ++i)
          result.push_back(lever.elastic_displacement(motion, i));
        return result;
      };
      return [displacements](const std::vector<FieldSource> &sources) { return mapped(sources, displacements); };
    }
  } // namespace

  void run_transient_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto maker    = dynamics_maker(options);
    auto &timer         = maker->timer();
    const auto dynamics = maker->make(scene);
    auto &model         = dynamics.model();
    const Body *body    = dynamics.lever ? dynamics.lever->body.get() : nullptr;
    // A model of its own finds them, condensed for finite elements, which find the lowest vibrations alone.
    const auto growing = growing_modes(maker->make(with_condensed_lever(scene)).model(), scene.drive);
    Checkpoint checkpoint(scene, options);
    Recorder recorder(scene, options, &timer, model.face_points(), &checkpoint);
    announce_model(scene, options);
    if (body != nullptr)
      announce(dynamics.meshed, *body, scene, options);
    announce(growing, scene, options);
    append(warnings, hidden_vibration_warnings(growing, scene.time));
    std::optional<FieldRecorder> fields;
    const bool is_meshed = dynamics.lever || dynamics.solid;
    if (is_meshed && scene.output.fields != FieldOutput::none)
    {
      fields.emplace(scene, shown_body(scene, dynamics), recovery(dynamics.meshed, count_levers(scene)), options.folder, timer);
      checkpoint.add_part([&](Archive &archive) { fields->serialise_progress(archive); });
    }
    else if (is_meshed)
      recorder.stress = no_stress_peaks("Output/Fields = none");

    // In three dimensions the face is kept beside the frames, too.
    constexpr double solid_faces = 100.;
    double next_face             = 0.; // [s]
    checkpoint.add_part([&](Archive &archive) { archive(next_face); });
    const auto write = [&](const Motion &motion, const Row &row)
    {
      recorder.record(row);
      const bool is_due = dynamics.solid && row[Column::time] >= next_face;
      if (is_due)
        next_face += scene.drive.duration() / solid_faces;
      if (!fields && !is_due)
        return;
      const auto face    = model.face_state(motion);
      const auto source  = [&] { return FieldSource{ motion.coordinates.position, {}, motion.face_force }; };
      const bool is_kept = fields && fields->record(row, face, source);
      if (is_kept || is_due)
        recorder.record(face);
    };
    const auto hand_on = [&](const Motion &motion, const Row &row) { checkpoint.hand_on([&] { write(motion, row); }); };
    bool is_complete   = false;
    record_steps(
        scene, recorder, timer, warnings, body != nullptr ? meshed_entries(dynamics.meshed, *body) : std::vector<Entry>(),
        [&]
        {
          const auto report = run_transient(model, scene.drive, transient_settings(scene, growing), hand_on, &checkpoint);
          is_complete       = true;
          return report;
        },
        [&]
        {
          if (is_complete && estimates_errors(scene, options))
          {
            const PhaseTimer::Scope scope(timer, "accuracy");
            recorder.accuracy = transient_accuracy(scene, dynamics.meshed, recorder.recorded(), *maker);
          }
          if (fields)
            recorder.stress = fields->finish();
        });
  }
} // namespace sprag
