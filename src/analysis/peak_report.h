#pragma once

#include "results/result_file.h"
#include "results/warning.h"
#include "scene/scene.h"

#include <vector>

namespace sprag
{
  /// Adds the largest pressure on the friction face over a run of finite elements with x, direction and place; of a pair that of
  /// the lever where it is larger. Nothing for models without a face.
  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries);

  /// Error of the largest pressure to expect of a contact `elements` > 0 face sizes wide with displacements of a degree, over the
  /// pressure: 3/elements^2 (degree 1) or 0.8/elements^3, at most 1. Upper bounds of tests/benchmarks/pressure.py.
  double expected_pressure_error(double elements, unsigned int degree);

  /// Whether the built-in mesh is too coarse for the largest pressure of a run, by more than 5 % expected.
  Warnings coarse_contact_warnings(const Scene &scene, const std::vector<Row> &rows);
} // namespace sprag
