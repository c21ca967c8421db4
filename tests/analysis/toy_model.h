// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "model/step/model.h"
#include "support/small_model.h"

#include <cmath>
#include <functional>

namespace sprag
{
  /// One coordinate q with the equilibrium equation residual(q, x) = 0, without contact. What it can be asked to do wrong is
  /// decided by the tests.
  class ToyModel : public SmallModel
  {
  public:
    struct Value
    {
      double residual;
      double derivative;
    };

    std::function<Value(double q, double x)> equation = [](double at, double drive) { return Value{ drive - at, -1. }; };
    std::function<bool(double from, double to)> fails = [](double, double) { return false; }; ///< whether a step has no solution
    std::function<std::string(double x)> objects      = [](double) { return std::string(); };
    std::function<double(double x)> friction          = [](double) { return 0.; }; ///< F, whatever it sticks to

    bool history_intact = true; ///< whether every trial began at the accepted history

    State initial_state(const DrivePoint &drive) const override
    {
      State state;
      state.drive = drive;
      state.coordinates.reinit(1);
      state.contact.resize(1);
      state.contact[0].traction[0] = drive.x; // as a mark
      return state;
    }

    // Trial states must start from the accepted one, untouched by whatever was rejected before.
    Step begin_step(const State &accepted, const DrivePoint &end) override
    {
      history_intact = history_intact && accepted.contact[0].traction[0] == accepted.drive.x;
      Step step{ accepted, accepted.drive, {}, {}, {} };
      step.trial.drive = end;
      return step;
    }

    Evaluation evaluate(Step &step, const FrictionMode /*mode*/) override
    {
      history_intact = history_intact && step.trial.contact[0].traction[0] == step.start.x;
      const Found found{ step.start.x, step.trial.drive.x, step.trial.coordinates[0],
                         equation(step.trial.coordinates[0], step.trial.drive.x) };
      return { std::abs(found.value.residual), 1., found };
    }

    dealii::Vector<double> correction(const Evaluation &evaluation) override
    {
      const auto &[from, x, q, value] = found_in(evaluation);
      if (fails(from, x))
        throw AnalysisError("no solution here");
      dealii::Vector<double> result(1);
      result[0] = -value.residual / value.derivative;
      return result;
    }

    std::string check_validity(const State &state, const Evaluation &) const override
    {
      return objects(state.drive.x);
    }

    void augment(const Evaluation &, State & /*trial*/) const override
    {
    }

    void store_history(const Evaluation &evaluation, State &state) const override
    {
      state.contact.assign(1, {});
      state.contact[0].traction[0] = found_in(evaluation).x;
    }

    void observe(const State & /*state*/, const Evaluation &evaluation, Row &row) const override
    {
      row[Column::P]              = 0.;
      row[Column::F]              = friction(found_in(evaluation).x);
      row[Column::Q]              = found_in(evaluation).q;
      row[Column::friction_power] = 0.;
    }

  private:
    struct Found
    {
      double from, x, q;
      Value value;
    };

    static const Found &found_in(const Evaluation &evaluation)
    {
      return std::any_cast<const Found &>(evaluation.model_data);
    }
  };
} // namespace sprag
