#pragma once

#include "results/columns.h"
#include "scene/scene.h"

#include <functional>

namespace sprag
{
  /// The closed form along the scene's drive, in steps of at most Analysis/Step; at every reversal two rows, before and after.
  /// The rows of a full pair are those of both levers.
  /// Works are integrated within each step, see work_between(). Requires a drive free of locking().
  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink);
} // namespace sprag
