// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sprag
{
  // Strokes measured on runs of this program.

  struct Noise
  {
    double deviation   = 0.1; ///< of P and Q [N]
    double correlation = 0.;  ///< from a row to the next
  };

  /// Returns rows at equal times, lines between those of a run.
  inline std::vector<Row> at_equal_times(const std::vector<Row> &rows, const double spacing)
  {
    std::vector<Row> result;
    std::size_t i    = 1;
    const double end = rows.back()[Column::time];
    for (double time = rows.front()[Column::time]; time < end; time += spacing)
    {
      while (rows[i][Column::time] <= time)
        ++i;
      const double from = rows[i - 1][Column::time];
      const double part = (time - from) / (rows[i][Column::time] - from);
      Row row;
      for (const auto column : { Column::time, Column::x, Column::P, Column::Q })
        row[column] = (1. - part) * rows[i - 1][column] + part * rows[i][column];
      result.push_back(row);
    }
    return result;
  }

  /// Returns the stroke of the rows with normal noise on P and Q, forces behind x by a number of rows.
  inline MeasuredStroke measured(const std::vector<Row> &rows, const Noise &noise, const unsigned int seed,
                                 const std::size_t lag = 0)
  {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal(0., noise.deviation);
    MeasuredStroke stroke;
    stroke.channels         = { { MeasuredForce::normal, {} }, { MeasuredForce::drive, {} } };
    const double innovation = std::sqrt(1. - noise.correlation * noise.correlation);
    std::vector<double> state{ normal(generator), normal(generator) };
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      stroke.time.push_back(rows[i][Column::time]);
      stroke.x.push_back(rows[i][Column::x]);
      const Row &behind = rows[i - std::min(i, lag)];
      for (std::size_t channel = 0; channel < 2; ++channel)
      {
        stroke.channels[channel].values.push_back(behind[channel == 0 ? Column::P : Column::Q] + state[channel]);
        state[channel] = noise.correlation * state[channel] + innovation * normal(generator);
      }
    }
    return stroke;
  }

  /// Returns the stroke one way only, out.
  inline MeasuredStroke way_out(MeasuredStroke stroke)
  {
    const auto turn = std::max_element(stroke.x.begin(), stroke.x.end()) - stroke.x.begin();
    stroke.time.resize(turn);
    stroke.x.resize(turn);
    for (auto &channel : stroke.channels)
      channel.values.resize(turn);
    return stroke;
  }
} // namespace sprag
