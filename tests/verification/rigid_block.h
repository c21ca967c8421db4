#pragma once

#include "analysis/statics/quasi_static.h"
#include "model/contact_step.h"
#include "scene/scene.h"
#include "support/small_model.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sprag
{
  /// A rigid block with n displacements under a load that follows the drive, pressed against one contact of 1 mm^2.
  template <int n>
  class RigidBlock : public SmallModel
  {
  public:
    struct Load
    {
      dealii::Tensor<1, n> force;      ///< [N]
      dealii::Tensor<2, n> derivative; ///< by the displacements [N/mm]
    };

    struct Properties
    {
      std::function<Load(const dealii::Tensor<1, n> &displacement, double x)> load;
      std::function<ContactKinematics<n>(const dealii::Tensor<1, n> &displacement)> contact;
      FrictionLaw friction;
      double penalty;             ///< normal and tangential [N/mm^3]
      Enforcement enforcement;    ///< augmented Lagrangian carries its multipliers from step to step
      dealii::Tensor<1, n> start; ///< displacement, touching [mm]
    };

    explicit RigidBlock(Properties block)
        : properties(std::move(block))
    {
    }

    State initial_state(const DrivePoint &drive) const override
    {
      State state;
      state.drive = drive;
      state.coordinates.reinit(n);
      for (int i = 0; i < n; ++i)
        state.coordinates[i] = properties.start[i];
      state.contact.resize(1);
      return state;
    }

    State begin_step(const State &accepted, const DrivePoint &end) override
    {
      start_time  = accepted.drive.time;
      slip_begin  = properties.contact(displacement(accepted)).slip;
      State trial = accepted;
      trial.drive = end;
      return trial;
    }

    Unbalance evaluate(State &trial, const FrictionMode mode) override
    {
      const auto u          = displacement(trial);
      const auto load       = properties.load(u, trial.drive.x);
      const double duration = trial.drive.time - start_time;
      point                 = properties.contact(u);
      StepContactLaw law;
      law.normal     = { properties.penalty, 1. };
      law.tangential = properties.penalty;
      law.friction   = properties.friction;
      law.weights.dt = duration;
      law.balance    = ForceBalance::end;
      law.mode       = duration > 0. ? mode : FrictionMode::stick;
      response       = step_response(sprag::step_to(point, slip_begin), trial.contact[0], law);
      external       = load.force;
      unbalance      = load.force + response.force;
      tangent        = load.derivative + response.tangent;
      rate           = duration > 0. ? (point.slip - slip_begin) / duration : 0.;
      return { unbalance.norm(), response.pressure / properties.penalty };
    }

    dealii::Vector<double> correction() override
    {
      const dealii::Tensor<1, n> change = -1. * (invert(tangent) * unbalance);
      dealii::Vector<double> result(n);
      for (int i = 0; i < n; ++i)
        result[i] = change[i];
      return result;
    }

    double penetration() const override
    {
      return response.pressure > 0. ? std::abs(point.gap) : 0.;
    }

    void augment(State &trial) const override
    {
      trial.contact[0].normal_multiplier = response.pressure;
      trial.contact[0].traction          = response.traction;
    }

    void remember(State &state) const override
    {
      state.contact.assign(1, {});
      state.contact[0].traction = response.traction;
      if (properties.enforcement == Enforcement::augmented_lagrangian)
        state.contact[0].normal_multiplier = response.pressure;
    }

    /// P and F are normal force and friction, Q is the load along the first displacement.
    void observe(const State & /*trial*/, Row &row) const override
    {
      row[Column::P]              = response.pressure;
      row[Column::F]              = response.traction[0];
      row[Column::Q]              = external[0];
      row[Column::penetration]    = penetration();
      row[Column::friction_power] = response.traction[0] * rate;
    }

  private:
    static dealii::Tensor<1, n> displacement(const State &state)
    {
      dealii::Tensor<1, n> result;
      for (int i = 0; i < n; ++i)
        result[i] = state.coordinates[i];
      return result;
    }

    const Properties properties;
    double start_time = 0., slip_begin = 0.; // of the step
    ContactKinematics<n> point;
    StepResponse<n> response;
    dealii::Tensor<1, n> external, unbalance;
    dealii::Tensor<2, n> tangent;
    double rate = 0.;
  };

  template <int n>
  std::vector<Row> run_block(const typename RigidBlock<n>::Properties &properties, const Drive &drive, const double step)
  {
    RigidBlock<n> block(properties);
    QuasiStaticSettings settings;
    settings.step                = step;
    settings.contact.enforcement = properties.enforcement;
    std::vector<Row> rows;
    run_quasi_static(block, drive, settings, [&](const State &, const Row &row) { rows.push_back(row); });
    return rows;
  }
} // namespace sprag
