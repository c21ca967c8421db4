// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "scene/drive.h"
#include "scene/lever.h"

#include <functional>
#include <optional>

namespace sprag
{
  struct Device;

  // The damper with a massless rigid lever and ideal contact: Yamaguchi & Yoshida eqs. 4-12 and 20-25.

  /// Ideal contact of cylinder and friction interface at a position x.
  struct Kinematics
  {
    double theta;   ///< absolute inclination [rad], eq. 9: (l-x) sin th + h cos th = R - e
    double s;       ///< pivot to contact point along the lever [mm], eq. 8
    double theta_x; ///< dth/dx = sin th / s [rad/mm]
  };

  /// Solves eqs. 8 and 9. Requires an x with the contact point on the lever's side of the pivot, see pivot_contact().
  Kinematics kinematics(const Geometry &geometry, double x);

  /// Returns the material sliding speed of the cylinder along the lever, v cos th - e dth/dt [mm/s], signed.
  double sliding_speed(const Geometry &geometry, double x, double v);

  /// Holds contact, sliding speed and forces of the closed form at one position of the drive.
  struct ClosedFormState
  {
    Kinematics contact;
    double v_rel; ///< sliding_speed()
    double mu;    ///< by the speed that the law refers to
    double P;     ///< along n [N], eq. 5 with J = 0
    double F;     ///< on the lever along -d [N], eq. 4
    double Q;     ///< along x [N], eq. 6
  };

  /// Returns the state at x while moving at v [mm/s]; of a zero the sign is the direction. Forces are infinite or negative where
  /// s + sgn(v) mu e <= 0.
  ClosedFormState closed_form(const Device &device, double x, double v);

  /// Returns the state of any lever with a contact that is known, which a moment presses on the cylinder [N mm].
  ClosedFormState closed_form(const Geometry &geometry, const FrictionLaw &friction, double moment, const Kinematics &contact,
                              double v);

  /// Returns the representative slope C_Q = dQ/dx at x = 0 [N/mm], eqs. 10-12 (with the sign of dth/dx mended), sign = +1 or -1.
  /// It is NaN where the lever locks at x = 0.
  double representative_slope(const Geometry &geometry, double spring_stiffness, double coefficient, int sign);

  /// Returns the dimensionless slope C_Q R l / k, eqs. 20-22.
  double dimensionless_slope(const Geometry &geometry, double coefficient, int sign);

  /// Returns the smallest x at which the cylinder touches the pivot: (l-x)^2 + h^2 = R^2 [mm]. Requires |h| <= R, as it never
  /// does otherwise.
  double pivot_contact(const Geometry &geometry);

  /// A place of the drive at which the lever locks while moving back, s <= mu e with the scene's mu(v).
  struct Locking
  {
    double x;
    double s;
    double mu;
  };

  /// Finds the first instant of the drive at which the lever locks, to 0.1 mm; none if the whole drive is free of it.
  std::optional<Locking> locking(const Device &device);

  /// Holds the work of the drive and the part that friction dissipates.
  struct Work
  {
    double drive    = 0.; ///< integral of Q dx [N mm]
    double friction = 0.; ///< integral of F v_rel dt [N mm]
  };

  /// Integrates the work done from one instant of the drive to another, to 1e-11 where mu(v) is smooth and 1e-8 across its
  /// joints, or to the rounding of the time over the time between them.
  Work work_between(const Device &device, double begin, double end);

  /// Integrates the work of any lever by its state over time.
  Work work_between(const Drive &drive, const std::function<ClosedFormState(const DrivePoint &)> &state_at, double begin,
                    double end);
} // namespace sprag
