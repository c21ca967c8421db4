// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "bar_on_cylinder.h"

namespace sprag
{
  /// Displacements of up to `size`, different at neighbouring nodes, and a small turn; the lever moved down by 0.01 mm and what
  /// the cylinder at x goes out of its way.
  inline dealii::Vector<double> pressed(const ElasticBody<2> &body, const InterfaceLayout &layout, const double size,
                                        const double x, const double phase)
  {
    dealii::Vector<double> displacements(layout.size());
    const auto n_lever = 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    for (unsigned int i = 0; i < layout.surface; ++i)
      displacements[i] = size * std::sin(1.7 * i + phase) - (i % 2 == 1 && i < n_lever ? 0.01 - rest_inclination * x : 0.);
    displacements[layout.rotation()] = 2e-5 * std::sin(phase);
    if (layout.sprung)
      displacements[layout.support()] = 1e-3 * std::cos(phase);
    return displacements;
  }

  /// A step of 1e-4 s from sliding at x = 1 mm to `x`, in which all displacements change by about half their `size` times
  /// `share`, and the cylinder turns by 0.002 times `share`.
  class PressedStep
  {
  public:
    PressedStep(FaceContact<2> &contact, const ElasticBody<2> &body, const InterfaceLayout &layout, const double size,
                const double x, const double share = 1., const double spectral_radius = 0.8)
        : weights(generalised_alpha(spectral_radius, 1e-4))
        , to{ 1e-4, x, (x - 1.) / 1e-4, 0., 0.002 * share }
        , end(pressed(body, layout, size, x, 0.3 + 0.5 * share))
    {
      accepted.drive = { 0., 1., 100. };
      begin.position = pressed(body, layout, size, 1., 0.3);
      contact.evaluate_sliding({ begin.position, accepted.drive, 100. }, found);
      accepted.contact = found.history();
    }

    InterfaceStep operator*() const
    {
      return { accepted.drive, accepted.contact, to, begin, end, rate, weights };
    }

    StepWeights weights;
    DrivePoint to;
    Motion accepted;
    FaceEvaluation<2> found; ///< where the step begins
    Kinematic begin;
    dealii::Vector<double> end;
    dealii::Vector<double> rate;
  };
} // namespace sprag
