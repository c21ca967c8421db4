#pragma once

#include "base/errors.h"
#include "model/model.h"
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
    State begin_step(const State &accepted, const DrivePoint &end) override
    {
      from           = accepted.drive.x;
      history_intact = history_intact && accepted.contact[0].traction[0] == from;
      State trial    = accepted;
      trial.drive    = end;
      return trial;
    }

    Unbalance evaluate(State &trial, const FrictionMode /*mode*/) override
    {
      q              = trial.coordinates[0];
      x              = trial.drive.x;
      history_intact = history_intact && trial.contact[0].traction[0] == from;
      value          = equation(q, x);
      return { std::abs(value.residual), 1. };
    }

    dealii::Vector<double> correction() override
    {
      if (fails(from, x))
        throw AnalysisError("no solution here");
      dealii::Vector<double> result(1);
      result[0] = -value.residual / value.derivative;
      return result;
    }

    std::string objection(const State &trial) const override
    {
      return objects(trial.drive.x);
    }

    void augment(State & /*trial*/) const override
    {
    }

    void remember(State &state) const override
    {
      state.contact.assign(1, {});
      state.contact[0].traction[0] = x;
    }

    void observe(const State & /*trial*/, Row &row) const override
    {
      row[Column::P]              = 0.;
      row[Column::F]              = friction(x);
      row[Column::Q]              = q;
      row[Column::friction_power] = 0.;
    }

  private:
    double q = 0., x = 0., from = 0.;
    Value value{};
  };
} // namespace sprag
