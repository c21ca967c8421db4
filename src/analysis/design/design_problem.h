// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"
#include "input/sections.h"
#include "scene/design.h"

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A function to be minimised over the unit cube under constraints, all of which an evaluation finds together.
  struct BoxProblem
  {
    struct Evaluation
    {
      double objective = 0.;
      std::vector<double> constraints; ///< each <= 0 where it is kept
    };

    std::size_t dimension     = 0;
    std::size_t n_constraints = 0; ///< >= 1
    std::function<Evaluation(const std::vector<double> &)> evaluate;
  };

  /// Values of all quantities of a lever; NaN of what is not known.
  class DesignQuantities
  {
  public:
    DesignQuantities()
    {
      values.fill(std::numeric_limits<double>::quiet_NaN());
    }

    double &operator[](const DesignQuantity quantity)
    {
      return values[static_cast<std::size_t>(quantity)];
    }

    double operator[](const DesignQuantity quantity) const
    {
      return values[static_cast<std::size_t>(quantity)];
    }

  private:
    std::array<double, static_cast<std::size_t>(DesignQuantity::parameter)> values;
  };

  /// A rule that every lever keeps, whatever is demanded: it can be built and slides on the whole stroke.
  struct LeverRule
  {
    double violation = 0.; ///< of lengths over the largest of them; <= 0: kept
    std::string text;      ///< "the cylinder must not reach the pivot on the stroke"
  };

  /// Returns the first rule that the lever breaks, or the one that it comes closest to breaking. `has_length`: whether
  /// Lever/Length must reach beyond the contact.
  LeverRule hardest_rule(const Scene &scene, bool has_length);

  /// Returns the largest distance of forces from the best line through 0, over the largest force.
  double compute_nonlinearity(const std::vector<double> &x, const std::vector<double> &forces);

  /// Returns the largest size of some forces.
  double largest_magnitude(const std::vector<double> &forces);

  /// Returns the ratio of forces or slopes forward and back; infinite where the way back does not damp.
  double direction_ratio(double forward, double backward);

  /// Adds the quantities that follow from the representative slopes of one lever forward and back [N/mm].
  void add_slopes(const Scene &scene, double forward, double backward, DesignQuantities &quantities);

  /// Returns those quantities of a lever that keeps the rules which follow from the closed form on the stroke.
  DesignQuantities lever_quantities(const Scene &scene);

  /// Fills in what the table does on such levers, as far as the design asks for it: by one harmonic, and the offset by a run in
  /// time. A table without a motion of one harmonic within the levers' way has an infinite transmissibility, one whose levers end
  /// or lock an infinite offset.
  void add_table_quantities(const Scene &scene, const DesignSettings &design, DesignQuantities &quantities);

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
  double demand_violation(const Demand &demand, double value);

  /// Returns the value that a quantity or a free parameter has.
  double term_value(const DesignTerm &term, const Proposal &proposal);

  /// Returns the lever's parameters as overrides of the scene of the design, "Section/Name=value".
  std::vector<std::string> design_overrides(const Scene &design, const Proposal &lever);

  /// The levers of a scene between the bounds of its free parameters, by the closed form.
  class DesignProblem
  {
  public:
    /// Computes quantities that the closed form does not know, such as growth rates, from the scene of a lever.
    using Dear = std::function<void(const Scene &, DesignQuantities &)>;

    explicit DesignProblem(const Scene &scene);

    /// Makes the closed form meet from now on what a check model found of a lever: what is positive by a factor, the rest by a
    /// difference. `by_closed_form` is without earlier corrections.
    void correct(DesignQuantity quantity, double by_closed_form, double found);

    /// Returns a quantity without the corrections.
    double uncorrected(DesignQuantity quantity, double corrected) const;

    /// Margin by which demands are met, over their targets. It is larger where corrections are known to first order alone, and
    /// at most a quarter of a demand's tolerance.
    double room = 1e-7;

    /// Counted with every lever from now on; empty: nothing.
    Dear dear;

    /// Returns the lever at a place of the unit cube of bounds.
    Proposal at(const std::vector<double> &place) const;

    /// Returns the place of parameters, in the unit cube.
    std::vector<double> search_point(const std::vector<double> &parameters) const;

    /// Returns the scene with the lever's parameters, unchecked.
    const Scene &scene_at(const std::vector<double> &parameters) const;

    /// Returns whether levers are dear: what their table does takes a thousandth of a second, the rest a hundredth of that.
    bool is_dear() const;

    const DesignSettings &settings() const
    {
      return base.design;
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
    const Scene base;
    std::unique_ptr<SceneSettings> input; ///< whose scene the stores of the parameters write to
    std::vector<Parameter> free;
    DesignQuantities factors;     ///< NaN: 1
    DesignQuantities differences; ///< NaN: 0
    std::shared_ptr<std::size_t> count = std::make_shared<std::size_t>(0);
  };
} // namespace sprag
