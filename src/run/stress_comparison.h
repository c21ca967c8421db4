// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/static_lever.h"
#include "run/stress_sample.h"

#include <optional>
#include <vector>

namespace sprag
{
  /// Relative changes of the largest stress in lever and layer between two models.
  struct StressChanges
  {
    double lever;
    double layer;
    bool is_at_edge; ///< whether the layer's is all but reached where the contact ends, see StressSample
  };

  /// Compares the largest stresses that a run found with those of another model in the same states.
  class StressComparison
  {
  public:
    /// The model must outlive the object.
    StressComparison(const StaticLever<2> &other, const std::vector<StressSample> &run);

    /// Looks at a state of the other model.
    void look_at(const State &state, const Row &row);

    /// Returns the largest changes over the states with at least half the largest stress, over that one: a single place may lie
    /// well by chance. None where no state of the run was looked at.
    std::optional<StressChanges> changes() const;

  private:
    struct Pair
    {
      StressSample run;
      StressSample other;
    };

    const StaticLever<2> &model;
    const std::vector<StressSample> samples;
    const BodyFields fields;
    std::vector<Pair> pairs;
  };

  /// Returns the times of states [s].
  std::vector<double> times_of(const std::vector<StressSample> &samples);
} // namespace sprag
