#include "analysis/statics/newton.h"

namespace sprag
{
  namespace
  {
    constexpr double round_off = 5e-15; ///< of positions, over the size of the scene
  }

  NewtonResult solve_equilibrium(Model &model, State &trial, const bool stick_first)
  {
    if (stick_first)
    {
      model.evaluate(trial, FrictionMode::stick);
      trial.coordinates += model.correction();
    }
    double overlap      = 0.;
    const auto evaluate = [&](const dealii::Vector<double> & /*coordinates of trial*/)
    {
      const auto unbalance = model.evaluate(trial, FrictionMode::cone);
      overlap              = unbalance.overlap;
      return unbalance.norm;
    };
    return solve_by_newton(
        trial.coordinates, round_off * model.length_scale(), evaluate, [&] { return model.correction(); },
        [&](const dealii::Vector<double> &change) { return model.movement(change); }, [&] { return overlap; });
  }

  bool is_balanced(Model &model, const State &state)
  {
    State trial = model.begin_step(state, state.drive);
    model.evaluate(trial, FrictionMode::cone);
    return model.movement(model.correction()) <= round_off * model.length_scale();
  }
} // namespace sprag
