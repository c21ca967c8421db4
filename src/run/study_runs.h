// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/study/study_points.h"
#include "analysis/study/study_results.h"
#include "run/in_memory.h"
#include "scene/scene.h"

#include <vector>

namespace sprag
{
  /// Throws InputError where no run of a study is possible, or not its reference.
  void require_possible_runs(const Scene &study);

  /// Carries out the runs of a study in this process, one at a time.
  class StudyRuns
  {
  public:
    explicit StudyRuns(const Scene &scene)
        : study(scene)
    {
    }

    /// Lists the points of the study, which are its runs; the reference, where there is one, comes behind them.
    const std::vector<StudyPoint> &points() const
    {
      return all_points;
    }

    /// Returns the number of runs with the reference.
    std::size_t size() const
    {
      return all_points.size() + (has_reference ? 1 : 0);
    }

    /// Carries out a run and returns what is kept of it, also where it fails or is refused. Throws what no run can help.
    StudyRecord run(std::size_t index);

    /// Groups those of the runs that share a mesh, so that one process makes it; the largest meshes first. Where there are fewer
    /// meshes than `processes` each run is a group of its own.
    std::vector<std::vector<std::size_t>> run_groups(const std::vector<std::size_t> &runs, unsigned int processes) const;

  private:
    const Scene study;
    const std::vector<StudyPoint> all_points = make_study_points(study.study);
    const bool has_reference                 = !study.study.reference_values.empty();
    InMemory in_memory                       = run_in_memory();

    Scene make_scene(std::size_t index) const;
    void carry_out_run(std::size_t index, StudyRecord &record);
  };
} // namespace sprag
