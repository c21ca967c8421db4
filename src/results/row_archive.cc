// SPDX-License-Identifier: GPL-3.0-only
#include "results/row_archive.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Values most of which are 0 before the first and behind the last that is not: on a face where nothing touches.
    struct Sparse
    {
      std::vector<double> &values;
    };

    void serialise(Archive &archive, const Sparse sparse)
    {
      auto &values          = sparse.values;
      const auto is_nothing = [](const double value) { return value == 0. && !std::signbit(value); };
      const auto first      = std::find_if_not(values.begin(), values.end(), is_nothing);
      const auto end        = std::find_if_not(values.rbegin(), std::make_reverse_iterator(first), is_nothing).base();
      std::size_t size = values.size(), before = static_cast<std::size_t>(first - values.begin());
      std::vector<double> inside(first, end);
      archive(size, before, inside);
      if (!archive.reads())
        return;
      values.assign(size, 0.);
      std::copy(inside.begin(), inside.end(), values.begin() + static_cast<std::ptrdiff_t>(before));
    }
  } // namespace

  void serialise(Archive &archive, Row &row)
  {
    auto &[sensor_forces, across, values, second_values] = row;
    archive(sensor_forces, across, values, second_values);
  }

  void serialise(Archive &archive, FaceState &face)
  {
    auto &[time, x, pressure, traction, traction_across, pressure_2, traction_2, traction_across_2] = face;
    archive(time, x);
    for (auto *const values : { &pressure, &traction, &traction_across, &pressure_2, &traction_2, &traction_across_2 })
      serialise(archive, Sparse{ *values });
  }
} // namespace sprag
