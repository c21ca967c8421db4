// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "model/contact/contact_step.h"
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

    Step begin_step(const State &accepted, const DrivePoint &end) override
    {
      Step step{ accepted, accepted.drive, {}, accepted.coordinates, {} };
      step.trial.drive = end;
      return step;
    }

    Evaluation evaluate(Step &step, const FrictionMode mode) override
    {
      const auto u            = displacement(step.trial.coordinates);
      const auto load         = properties.load(u, step.trial.drive.x);
      const double duration   = step.trial.drive.time - step.start.time;
      const double slip_begin = properties.contact(displacement(step.displacements)).slip;
      Found found;
      found.point = properties.contact(u);
      StepContactLaw law;
      law.normal         = { properties.penalty, 1. };
      law.slip.stiffness = properties.penalty;
      law.slip.friction  = properties.friction;
      law.weights.dt     = duration;
      law.balance        = ForceBalance::end;
      law.mode           = duration > 0. ? mode : FrictionMode::stick;
      found.response     = step_response(sprag::step_to(found.point, slip_begin), step.trial.contact[0], law);
      found.external     = load.force;
      found.residual     = load.force + found.response.force;
      found.tangent      = load.derivative + found.response.tangent;
      found.rate         = duration > 0. ? (found.point.slip - slip_begin) / duration : 0.;
      return { found.residual.norm(), found.response.pressure / properties.penalty, found };
    }

    dealii::Vector<double> correction(const Evaluation &evaluation) override
    {
      const auto &found                 = found_in(evaluation);
      const dealii::Tensor<1, n> change = -1. * (invert(found.tangent) * found.residual);
      dealii::Vector<double> result(n);
      for (int i = 0; i < n; ++i)
        result[i] = change[i];
      return result;
    }

    double penetration(const Evaluation &evaluation) const override
    {
      const auto &found = found_in(evaluation);
      return found.response.pressure > 0. ? std::abs(found.point.gap) : 0.;
    }

    void augment(const Evaluation &evaluation, State &trial) const override
    {
      const auto &response               = found_in(evaluation).response;
      trial.contact[0].normal_multiplier = response.pressure;
      trial.contact[0].traction          = response.traction;
    }

    void store_history(const Evaluation &evaluation, State &state) const override
    {
      const auto &response = found_in(evaluation).response;
      state.contact.assign(1, {});
      state.contact[0].traction = response.traction;
      if (properties.enforcement == Enforcement::augmented_lagrangian)
        state.contact[0].normal_multiplier = response.pressure;
    }

    /// P and F are normal force and friction, Q is the load along the first displacement.
    void observe(const State & /*state*/, const Evaluation &evaluation, Row &row) const override
    {
      const auto &found           = found_in(evaluation);
      row[Column::P]              = found.response.pressure;
      row[Column::F]              = found.response.traction[0];
      row[Column::Q]              = found.external[0];
      row[Column::penetration]    = penetration(evaluation);
      row[Column::friction_power] = found.response.traction[0] * found.rate;
    }

  private:
    struct Found
    {
      ContactKinematics<n> point;
      StepResponse<n> response;
      dealii::Tensor<1, n> external, residual;
      dealii::Tensor<2, n> tangent;
      double rate = 0.;
    };

    static const Found &found_in(const Evaluation &evaluation)
    {
      return std::any_cast<const Found &>(evaluation.model_data);
    }

    static dealii::Tensor<1, n> displacement(const dealii::Vector<double> &coordinates)
    {
      dealii::Tensor<1, n> result;
      for (int i = 0; i < n; ++i)
        result[i] = coordinates[i];
      return result;
    }

    const Properties properties;
  };

  template <int n>
  std::vector<Row> run_block(const typename RigidBlock<n>::Properties &properties, const Drive &drive, const double step)
  {
    RigidBlock<n> block(properties);
    QuasiStaticSettings settings;
    settings.step                = step;
    settings.contact.enforcement = properties.enforcement;
    std::vector<Row> rows;
    run_quasi_static(block, drive, settings, [&](const State &, const Row &row, const Evaluation &) { rows.push_back(row); });
    return rows;
  }
} // namespace sprag
