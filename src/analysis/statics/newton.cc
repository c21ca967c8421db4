#include "analysis/statics/newton.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    constexpr unsigned int maximum_iterations = 40;
    constexpr unsigned int maximum_halvings   = 6;
    constexpr double relative_tolerance       = 1e-7;
    constexpr double round_off                = 5e-15; ///< of positions, over the size of the scene

    struct SearchResult
    {
      State state;
      Unbalance unbalance;
      bool full;
    };

    /// Halves the correction until the unbalance falls; takes the shortest one if it never does.
    SearchResult line_search(Model &model, const State &from, const Unbalance &unbalance,
                             const dealii::Vector<double> &correction, const State &accepted)
    {
      SearchResult result{ from, unbalance, false };
      double share = 1.;
      for (unsigned int i = 0; i <= maximum_halvings; ++i, share *= 0.5)
      {
        result.state.coordinates = from.coordinates;
        result.state.coordinates.add(share, correction);
        result.unbalance = model.evaluate(result.state, accepted, FrictionMode::cone);
        result.full      = i == 0;
        if (result.unbalance.norm < (1. - 1e-3 * share) * unbalance.norm)
          break;
      }
      return result;
    }
  } // namespace

  NewtonResult solve_equilibrium(Model &model, State &trial, const State &accepted, const bool stick_first)
  {
    auto unbalance = model.evaluate(trial, accepted, stick_first ? FrictionMode::stick : FrictionMode::cone);
    for (unsigned int iteration = 1; iteration <= maximum_iterations; ++iteration)
    {
      const auto correction = model.correction();
      const double movement = model.movement(correction);
      if (movement <= relative_tolerance * unbalance.overlap + round_off * model.length_scale())
      {
        trial.coordinates += correction;
        model.evaluate(trial, accepted, FrictionMode::cone);
        return { true, iteration };
      }
      if (iteration == 1 && stick_first)
      {
        trial.coordinates += correction;
        unbalance = model.evaluate(trial, accepted, FrictionMode::cone);
        continue;
      }
      auto next = line_search(model, trial, unbalance, correction, accepted);
      trial     = std::move(next.state);
      unbalance = next.unbalance;
    }
    return { false, maximum_iterations };
  }

  bool is_balanced(Model &model, const State &state)
  {
    model.evaluate(state, state, FrictionMode::cone);
    return model.movement(model.correction()) <= round_off * model.length_scale();
  }
} // namespace sprag
