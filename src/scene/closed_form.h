#pragma once

#include "scene/scene.h"

#include <optional>

namespace sprag
{
  // The damper with a massless rigid lever and ideal contact: Yamaguchi & Yoshida eqs. 4-12 and 20-25.

  /// Ideal contact of cylinder and friction interface at a position x.
  struct Kinematics
  {
    double theta;   ///< absolute inclination [rad], eq. 9: (l-x) sin th + h cos th = R - e
    double s;       ///< pivot to contact point along the lever [mm], eq. 8
    double theta_x; ///< dth/dx = sin th / s [rad/mm]
  };

  /// Requires x with the contact point on the lever's side of the pivot, see pivot_contact().
  Kinematics
  kinematics(const Geometry &geometry, double x);

  struct ClosedFormState
  {
    Kinematics contact;
    double     v_rel; ///< sliding speed of the cylinder along the lever, v cos th - e dth/dt [mm/s], signed
    double     mu;
    double     P; ///< along n [N], eq. 5 with J = 0
    double     F; ///< on the lever along -d [N], eq. 4
    double     Q; ///< along x [N], eq. 6
  };

  /// State at x while moving at v [mm/s], v != 0 for a direction. Infinite or negative forces where s + sgn(v) mu e <= 0.
  ClosedFormState
  closed_form(const Scene &scene, double x, double v);

  /// Representative slope C_Q = dQ/dx at x = 0 [N/mm], eqs. 10-12 (with the sign of dth/dx mended), sign = +1 or -1.
  double
  representative_slope(const Geometry &geometry, double spring_stiffness, double coefficient, int sign);

  /// C_Q R l / k, eqs. 20-22.
  double
  dimensionless_slope(const Geometry &geometry, double coefficient, int sign);

  /// The geometry with h = 0 and the given e/R and th0 [rad] (R = 1 mm), eq. 23; none where the cylinder reaches the pivot, l <= R.
  std::optional<Geometry>
  geometry_of_inclination(double offset_ratio, double inclination);

  /// th0 above which the backward stroke no longer damps, atan mu [rad], eq. 25.
  double
  critical_inclination(double coefficient);

  /// Smallest x at which the cylinder touches the pivot: (l-x)^2 + h^2 = R^2 [mm].
  double
  pivot_contact(const Geometry &geometry);

  /// First position on the drive at which the moving-back lever locks, s <= mu e with the scene's mu(v).
  struct Locking
  {
    double x;
    double s;
    double mu;
  };

  /// None if the whole drive is free of it.
  std::optional<Locking>
  locking(const Scene &scene);

  /// Integral of Q dx over the drive, whole cycles [N mm]; equals the friction work.
  double
  loop_area(const Scene &scene);
} // namespace sprag
