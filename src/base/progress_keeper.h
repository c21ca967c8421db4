// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"

#include <functional>

namespace sprag
{
  /// Serialises the state from which an analysis resumes.
  using ProgressSerialiser = std::function<void(Archive &)>;

  /// Keeps the progress of a long analysis, so that a run that was killed resumes there.
  class ProgressKeeper
  {
  public:
    virtual ~ProgressKeeper() = default;

    /// Restores the progress at which an earlier run ended; returns false where there is none. Is to be called before the first
    /// step.
    virtual bool take_up(const ProgressSerialiser &progress) = 0;

    /// Is to be called after each accepted step, once the step is recorded. Throws AnalysisError when the run is interrupted.
    virtual void accept_step(const ProgressSerialiser &progress) = 0;

    /// Is to be called after the last step, as what follows may take long, too.
    virtual void end_steps(const ProgressSerialiser &progress) = 0;
  };
} // namespace sprag
