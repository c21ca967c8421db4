// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "program/recorder.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Runs `steps` of a scene in time, which returns its report, and checks its energy ledger; then completes and finishes the
  /// record whatever happened, with these facts of the model.
  void record_steps(
      const Scene &scene, Recorder &recorder, PhaseTimer &timer, Warnings &warnings, const std::vector<Entry> &facts,
      const std::function<TransientReport()> &steps, const std::function<void()> &complete = [] {});

  /// Prints what a run in time models, unless quiet.
  void announce_model(const Scene &scene, const RunOptions &options);
} // namespace sprag
