// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/stroke_fit.h"

#include "base/errors.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double least_speed   = 0.02; ///< over the peak; below that friction may be in stick
    constexpr double end_of_stroke = 0.02; ///< of its length: there the drive slows down to turn
    constexpr double impossible    = 1e6;  ///< standard deviations

    /// Returns the second derivative of theta over x: theta_x = sin^2 th / ((R - e) cos th - h) [rad/mm^2].
    double curvature(const Geometry &geometry, const Kinematics &contact)
    {
      const double sine  = std::sin(contact.theta);
      const double arm   = geometry.cylinder_radius - geometry.interface_offset;
      const double below = arm * std::cos(contact.theta) - geometry.pivot_height;
      return contact.theta_x * sine * (2. * std::cos(contact.theta) * below + arm * sine * sine) / (below * below);
    }
  } // namespace

  StrokeFit::StrokeFit(const Scene &of_lever, const MeasuredMotion &of_cylinder, const LeverUnknowns &of_fit)
      : scene(of_lever)
      , motion(of_cylinder)
      , unknowns(of_fit)
      , inertia(identifies_by_model(scene) ? scene.lever.moment_of_inertia : 0.)
  {
  }

  std::vector<UsedValue> StrokeFit::used(const double window, const double lag) const
  {
    const auto &measured = scene.identification.measured;
    std::vector<UsedValue> result;
    for (std::size_t row = 0; row < measured.rows(); ++row)
    {
      const auto stroke = motion.stroke_at(row, lag);
      const auto place  = motion.at(row, lag, stroke);
      const bool slides =
          motion.covers(row, lag, stroke) && place.x > 0. && std::abs(place.v) > least_speed * motion.peak_speed();
      const double travel = motion.travel(row, lag, stroke);
      if (!slides || travel <= window || travel > (1. - end_of_stroke) * motion.length(stroke))
        continue;
      for (std::size_t channel = 0; channel < measured.channels.size(); ++channel)
        if (const double value = measured.channels[channel].values[row]; !std::isnan(value))
          result.push_back({ row, channel, stroke, value });
    }
    return result;
  }

  std::optional<StrokeFit::Slide> StrokeFit::slide(const IdentifiedLever &lever, const ModelCorrection &correction,
                                                   const std::size_t row, const std::size_t stroke) const
  {
    const auto place    = motion.at(row, lever.lag, stroke);
    const int direction = motion.strokes()[stroke].direction;
    const double v      = std::copysign(place.v, direction);
    const auto contact  = kinematics(lever.geometry, place.x);
    const double spring = lever.stiffness * (contact.theta - kinematics(lever.geometry, 0.).theta);
    const double moment = spring + inertia * curvature(lever.geometry, contact) * v * v;
    const auto state    = closed_form(lever.geometry, lever.friction, moment, contact, v);
    const double arm    = contact.s + direction * state.mu * lever.geometry.interface_offset;
    if (!(arm > 0.) || !std::isfinite(state.P) || state.mu < 0.)
      return std::nullopt;
    const auto more = correction(place.x, direction);
    return Slide{ state.P + more.P, state.Q + more.Q };
  }

  double StrokeFit::shown(const IdentifiedLever &lever, const Slide &slide, const std::size_t channel) const
  {
    const bool is_Q = scene.identification.measured.channels[channel].force == MeasuredForce::drive;
    return (is_Q ? slide.Q : slide.P) + lever.offsets[channel];
  }

  std::vector<double> StrokeFit::in_units(const std::vector<double> &scaled) const
  {
    std::vector<double> result;
    for (std::size_t i = 0; i < scaled.size(); ++i)
      result.push_back(unknowns.numbers()[i].scale * scaled[i]);
    return result;
  }

  std::vector<double> StrokeFit::residuals(const std::vector<double> &scaled, const std::vector<UsedValue> &values,
                                           const std::vector<double> &deviations, const ModelCorrection &correction,
                                           const std::vector<double> &weights) const
  {
    std::vector<double> result(values.size(), impossible);
    try
    {
      const auto lever = unknowns.lever(in_units(scaled));
      std::optional<Slide> of_row;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const auto &[row, channel, stroke, value] = values[i];
        if (i == 0 || row != values[i - 1].row)
          of_row = slide(lever, correction, row, stroke);
        if (of_row)
          result[i] = (value - shown(lever, *of_row, channel)) / deviations[channel];
        if (!weights.empty())
          result[i] *= std::sqrt(weights[i]);
      }
    }
    catch (const InputError &)
    {
      // No lever: a trial step that is refused for its large residuals.
    }
    return result;
  }
} // namespace sprag
