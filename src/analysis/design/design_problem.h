// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"
#include "base/unknown.h"
#include "input/sections.h"
#include "scene/design.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A minimisation over the unit cube with inequality constraints; one evaluation returns objective and constraints.
  struct BoxProblem
  {
    /// Objective and constraints at one point.
    struct Evaluation
    {
      double objective = 0.;
      std::vector<double> constraints; ///< satisfied if <= 0
    };

    std::size_t dimension     = 0;
    std::size_t n_constraints = 0; ///< >= 1
    std::function<Evaluation(const std::vector<double> &)> evaluate;
  };

  /// Values of all quantities of a lever, NaN if unknown.
  class DesignQuantities
  {
  public:
    DesignQuantities()
    {
      values.fill(unknown);
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

  /// A condition for a lever that can be built and slides on the whole stroke, independent of the demands.
  struct LeverRule
  {
    double violation = 0.; ///< relative to a length of the rule; <= 0: satisfied
    std::string text;      ///< "the cylinder must not reach the pivot on the stroke"
  };

  /// Returns the rule with the largest violation. `has_length`: Lever/Length must be least_length().
  LeverRule hardest_rule(const Scene &scene, bool has_length);

  /// Returns max |F_i - c x_i| / max |F_i| with c = sum x_i F_i / sum x_i^2, the best line through 0.
  double compute_nonlinearity(const std::vector<double> &x, const std::vector<double> &forces);

  /// Returns the largest size of some forces.
  double largest_magnitude(const std::vector<double> &forces);

  /// Returns forward/-backward of forces or slopes; infinite for backward >= 0, where the return stroke does not damp.
  double direction_ratio(double forward, double backward);

  /// Adds the quantities that follow from the slopes C_Q of one lever forward and backward [N/mm], see scene/design.cc.
  void add_slopes(const Scene &scene, double forward, double backward, DesignQuantities &quantities);

  /// Returns the quantities that follow from the closed form, for a lever that satisfies the rules.
  DesignQuantities lever_quantities(const Scene &scene);

  /// Adds the quantities of the isolated table that the design asks for: by harmonic balance, the offset by a run in time. They
  /// are infinite if there is no periodic motion within the levers' reach, or if a lever reaches its end or locks.
  void add_table_quantities(const Scene &scene, const DesignSettings &design, DesignQuantities &quantities);

  /// A lever within the bounds, with its quantities.
  struct Proposal
  {
    std::vector<double> parameters; ///< values of the free parameters, in their order and units
    LeverRule rule;                 ///< the one with the largest violation
    DesignQuantities quantities;    ///< corrected, see DesignProblem::correct(); NaN if the nominal lever violates a rule
    std::vector<double> violations; ///< demand_violation() of each demand, the largest within Design/Tolerances
    std::vector<double> worst;      ///< value of each demand's quantity where its violation is largest
  };

  /// Returns by how much a value misses a demand, over the target (over the tolerance for a target of 0, over 100/s for growth
  /// rates); <= 0: met.
  double demand_violation(const Demand &demand, double value);

  /// Returns the one of two values that misses the demand by more; NaN counts as unknown.
  double worse(const Demand &demand, double first, double second);

  /// Returns the value of a quantity or a free parameter.
  double term_value(const DesignTerm &term, const Proposal &proposal);

  /// Returns all combinations of the bounds of Design/Tolerances, values in their order; none without tolerances.
  std::vector<std::vector<double>> tolerance_corners(const DesignSettings &design);

  /// Returns parameters with values as overrides of a scene, "Section/Name=value".
  std::vector<std::string> overrides(const std::vector<FreeParameter> &parameters, const std::vector<double> &values);

  /// Returns the lever's parameters as overrides of the scene of the design, "Section/Name=value".
  std::vector<std::string> design_overrides(const Scene &design, const Proposal &lever);

  /// The levers within the bounds of a design's free parameters, evaluated by the closed form with corrections by models.
  class DesignProblem
  {
  public:
    /// Adds expensive quantities that the closed form does not give, such as growth rates, to those of a lever's scene.
    using ExpensiveModel = std::function<void(const Scene &, DesignQuantities &)>;

    explicit DesignProblem(const Scene &scene);

    /// Corrects a quantity from now on to what a check model found: by the factor found/by_closed_form if both are positive, else
    /// by their difference. `corner`: 0 for the nominal values of Design/Tolerances, then their tolerance_corners().
    void correct(DesignQuantity quantity, double by_closed_form, double found, std::size_t corner = 0);

    /// Returns the quantities of a lever's scene by the closed form, uncorrected.
    DesignQuantities ideal_quantities(const Scene &scene) const;

    /// Returns the scene of a lever at a corner, see correct().
    const Scene &scene_at_corner(const std::vector<double> &parameters, std::size_t corner) const;

    /// Safety margin of the demands, over their targets; at most a quarter of a demand's tolerance. It is larger while
    /// corrections are known to first order only.
    double margin = 1e-7;

    /// Called for every lever evaluated from now on; empty: growth rates stay unknown.
    ExpensiveModel expensive_model;

    /// Returns the lever at a point of the unit cube of bounds.
    Proposal at(const std::vector<double> &place) const;

    /// Returns the point of the unit cube for values of the free parameters, in their units.
    std::vector<double> search_point(const std::vector<double> &parameters) const;

    /// Returns the scene with the lever's parameters, unchecked, and those of Design/Tolerances at their nominal values.
    const Scene &scene_at(const std::vector<double> &parameters) const;

    /// Returns whether an evaluation takes about 1 ms, with the isolated table or `expensive_model`; else it takes 10 us.
    bool is_expensive() const;

    const DesignSettings &settings() const
    {
      return base.design;
    }

    /// Returns the minimisation for an aim, or of the violation of the demand `omitted`, by its index, which is left out;
    /// `limit`: an additional demand. Demands of growth rates count only with `expensive_model`.
    BoxProblem box(const std::optional<DesignAim> &aim, const std::optional<std::size_t> &omitted = {},
                   const std::optional<Demand> &limit = {}) const;

    /// Returns the number of levers evaluated.
    std::size_t evaluations() const
    {
      return *count;
    }

  private:
    const Scene base;
    std::unique_ptr<SceneSettings> input;    ///< whose scene the stores of the parameters write to
    std::vector<Parameter> free, toleranced; ///< their default values are those of `base`
    std::vector<std::vector<double>> corners;

    /// Returns the corrected quantities of a lever that satisfies the rules.
    DesignQuantities corrected_quantities(const Scene &scene, std::size_t corner) const;

    struct Correction
    {
      DesignQuantities factors;     ///< NaN: 1
      DesignQuantities differences; ///< NaN: 0
    };

    std::vector<Correction> corrections; ///< see correct()
    std::shared_ptr<std::size_t> count = std::make_shared<std::size_t>(0);
  };
} // namespace sprag
