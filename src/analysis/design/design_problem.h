// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/design/lever_quantities.h"
#include "analysis/design/optimisation.h"
#include "base/parameters.h"
#include "scene/sections.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A lever within the bounds and what it does.
  struct Proposal
  {
    std::vector<double> parameters; ///< in the order of the free ones, in their units
    LeverRule rule;                 ///< that it is closest to breaking
    DesignQuantities quantities;    ///< NaN where it breaks one; with the corrections
    std::vector<double> violations; ///< of the demands, scaled: by how much each is missed over its target; <= 0: met
  };

  /// Returns by how much a quantity misses a demand, over the target or, where that is 0, the scale of the quantity; <= 0 where
  /// it is met.
  double violation_of(const Demand &demand, double value);

  /// Returns the value that a quantity or a free parameter has.
  double value_of(const DesignTerm &term, const Proposal &proposal);

  /// Returns the lever's parameters as overrides of the scene of the design, "Section/Name=value".
  std::vector<std::string> overrides_of(const Scene &design, const Proposal &lever);

  /// The levers of a scene between the bounds of its free parameters, by the closed form.
  class DesignProblem
  {
  public:
    /// Computes quantities that the closed form does not know, such as growth rates, from the scene of a lever.
    using Dear = std::function<void(const Scene &, DesignQuantities &)>;

    explicit DesignProblem(const Scene &scene);

    /// Makes the closed form meet from now on what a judge found of a lever: what is positive by a factor, the rest by a
    /// difference. `by_closed_form` is without earlier corrections.
    void correct(DesignQuantity quantity, double by_closed_form, double found);

    /// Returns a quantity without the corrections.
    double uncorrected(DesignQuantity quantity, double corrected) const;

    /// By how much demands are to be kept, over their targets: more where corrections are known to first order alone. Of a demand
    /// with a tolerance it is at most a quarter of that.
    double room = 1e-7;

    /// Counted with every lever from now on; empty: nothing.
    Dear dear;

    /// Returns the lever at a place of the unit cube of bounds.
    Proposal at(const std::vector<double> &place) const;

    /// Returns the place of parameters, in the unit cube.
    std::vector<double> place_of(const std::vector<double> &parameters) const;

    /// Returns the scene with the lever's parameters, unchecked.
    const Scene &scene_at(const std::vector<double> &parameters) const;

    /// Returns whether levers are dear: what their table does takes a thousandth of a second, the rest a hundredth of that.
    bool is_dear() const;

    const DesignSettings &settings() const
    {
      return given.design;
    }

    /// Returns the search for what makes `aim` best, or without one for any lever, under those of the demands that are known:
    /// of growth rates where there is a `dear`. `spared`: a demand that does not count; `limit`: one more that does.
    BoxProblem box(const std::optional<DesignAim> &aim, const std::optional<std::size_t> &spared = {},
                   const std::optional<Demand> &limit = {}) const;

    /// Returns how often levers were computed.
    std::size_t evaluations() const
    {
      return *count;
    }

  private:
    const Scene given;
    std::unique_ptr<SceneSettings> input; ///< whose scene the stores of the parameters write to
    std::vector<Parameter> free;
    std::vector<DesignQuantity> asked;
    DesignQuantities factors;     ///< NaN: 1
    DesignQuantities differences; ///< NaN: 0
    std::shared_ptr<std::size_t> count = std::make_shared<std::size_t>(0);
  };
} // namespace sprag
