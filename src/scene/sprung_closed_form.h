// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/closed_form.h"
#include "scene/device.h"

namespace sprag
{
  /// The closed form on a pivot frame that a spring holds along x, without inertia: the cylinder is at x - u from the frame's
  /// origin, and k_f u = Q. It sticks to the lever as long as Q = k_f u stays between the forces of sliding either way, so that a
  /// reversal takes (Q+ - Q-) / k_f of travel.
  class SprungClosedForm
  {
  public:
    /// Begins without a state. `scene` must outlive the object.
    explicit SprungClosedForm(const Device &the_scene)
        : device(the_scene)
    {
    }

    /// Holds lever and pivot frame at the last position.
    struct State
    {
      ClosedFormState lever;      ///< at x - u
      double displacement   = 0.; ///< u of the frame along x [mm]
      double support_energy = 0.; ///< [N mm]
      bool sticks           = false;
      Work work; ///< since the start [N mm]
    };

    /// Begins in steady sliding at x at the speed v, whose sign is the direction.
    State start(double x, double v);

    /// Goes from the last position to x in one direction, while the speed changes evenly to v, whose sign is the direction.
    /// Throws AnalysisError where no position of the frame balances Q.
    const State &advance(double x, double v);

  private:
    ClosedFormState sliding(double relative, double v) const;
    double sliding_position(double x, double v) const;
    ClosedFormState sticking(double x, double relative) const;
    void set(double x, double relative, const ClosedFormState &lever);

    const Device &device;
    const double stiffness = device.support.stiffness; ///< k_f [N/mm]
    double relative        = 0.;                       ///< x - u
    double speed           = 0.;
    State state;
  };
} // namespace sprag
