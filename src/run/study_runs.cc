// SPDX-License-Identifier: GPL-3.0-only
#include "run/study_runs.h"

#include "base/errors.h"
#include "base/phase_timer.h"
#include "base/progress.h"
#include "base/ranges.h"
#include "base/system/memory.h"
#include "estimate/choice.h"
#include "estimate/expected_cost.h"
#include "input/scene_key.h"
#include "program/resources.h"
#include "report/warnings.h"
#include "run/run.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <algorithm>
#include <map>
#include <new>

namespace sprag
{
  namespace
  {
    std::string describe_error(const InputError &error)
    {
      return boost::algorithm::join(error.messages, "; ");
    }
  } // namespace

  void require_possible_runs(const Scene &study)
  {
    if (!study.study.reference_values.empty())
      try
      {
        reference_scene(study);
      }
      catch (const InputError &error)
      {
        throw InputError(study.name + ".prm: Study/Reference is refused: " + describe_error(error));
      }
    std::string first;
    for (const auto &point : make_study_points(study.study))
      try
      {
        scene_at(study, point);
        return;
      }
      catch (const InputError &error)
      {
        first = first.empty() ? describe_error(error) : first;
      }
    throw InputError(study.name + ".prm: Study/Vary: every run is refused, the first one because of " + first);
  }

  Scene StudyRuns::make_scene(const std::size_t index) const
  {
    return index < all_points.size() ? scene_at(study, all_points[index]) : reference_scene(study);
  }

  StudyRecord StudyRuns::run(const std::size_t index)
  {
    StudyRecord record;
    record.run = index;
    reset_peak_memory();
    const auto saved   = [this] { return in_memory.dynamics->seconds_saved() + in_memory.meshes->seconds_saved(); };
    const double begin = monotonic_seconds(), cpu = PhaseTimer::cpu_seconds(), saved_before = saved();
    carry_out_run(index, record);
    record.cpu_spent   = PhaseTimer::cpu_seconds() - cpu;
    record.cpu_time    = record.cpu_spent + saved() - saved_before;
    record.wall_time   = monotonic_seconds() - begin;
    record.peak_memory = peak_memory() / (1024. * 1024.);
    return record;
  }

  void StudyRuns::carry_out_run(const std::size_t index, StudyRecord &record)
  {
    const auto ended = [&record](const RunOutcome outcome, const std::string &reason)
    {
      record.outcome = outcome;
      record.reason  = reason;
    };
    Warnings warnings;
    try
    {
      const auto [scene, choice] = resolved(make_scene(index));
      require_memory(scene);
      warnings = scene_warnings(scene);
      carry_out(scene, make_options(in_memory), warnings);
      check_warnings(scene, warnings);
      record.found = std::move(in_memory.found);
      record.work  = counted_work(scene, record.found.summary);
      if (choice)
        record.found.summary.push_back({ "chosen_settings", to_text(choice->settings), "", "that followed from Accuracy" });
      if (!has_reference)
        record.found.curve.clear();
    }
    catch (const InputError &error)
    {
      ended(RunOutcome::refused, describe_error(error));
    }
    catch (const std::bad_alloc &)
    {
      throw;
    }
    catch (const std::exception &error)
    {
      ended(RunOutcome::failed, error_message(error));
    }
    record.warnings = mapped(warnings, &Warning::name);
  }

  std::vector<std::vector<std::size_t>> StudyRuns::run_groups(const std::vector<std::size_t> &runs,
                                                              const unsigned int processes) const
  {
    struct SharedMesh
    {
      double size = 0.;
      std::vector<std::size_t> runs;
    };
    std::map<std::string, SharedMesh> by_mesh;
    for (const auto run : runs)
      try
      {
        const Scene scene = make_scene(run);
        // Runs without a mesh share nothing, and of others it is not known before the mesh is chosen.
        const bool shares = needs_mesh(scene) && !scene.accuracy.leaves_open();
        auto &group       = by_mesh[shares ? body_key(scene) : std::to_string(run)];
        group.size        = expected_size(scene).displacements;
        group.runs.push_back(run);
      }
      catch (const InputError &)
      {
        by_mesh[std::to_string(run)].runs.push_back(run);
      }
    std::vector<SharedMesh> groups;
    for (const auto &[key, group] : by_mesh)
      if (by_mesh.size() >= processes)
        groups.push_back(group);
      else
        for (const auto run : group.runs)
          groups.push_back({ group.size, { run } });
    std::stable_sort(groups.begin(), groups.end(),
                     [](const SharedMesh &a, const SharedMesh &b)
                     { return a.size > b.size || (a.size == b.size && a.runs.front() < b.runs.front()); });
    return mapped(groups, &SharedMesh::runs);
  }
} // namespace sprag
