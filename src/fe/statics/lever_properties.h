// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"
#include "fe/contact/face_contact_point.h"
#include "laws/friction_law.h"
#include "laws/moment_law.h"
#include "results/columns.h"
#include "scene/analysis_settings.h"
#include "scene/apparatus.h"
#include "scene/discretisation_settings.h"
#include "scene/lever.h"

#include <functional>
#include <optional>

namespace sprag
{
  struct Device;

  /// The rotational spring at the hub.
  struct HubSpring
  {
    MomentLaw law;
    double rest = 0.; ///< inclination without moment [rad]
    double arm  = 1.; ///< length that turns a rotation into a movement [mm], > 0
  };

  /// Everything that makes a meshed lever but its mesh.
  struct LeverProperties
  {
    BodyProperties body;
    std::function<double(double)> ideal_theta;        ///< inclination that first guesses follow, over x [rad]
    std::function<LeverPoint(double, double)> centre; ///< of the cylinder over x and theta
    double radius = 0.; ///< R of an elastic cylinder, 0 if it turns with the lever, see FacePair [mm]
    HubSpring spring;
    std::optional<double> support_stiffness; ///< k_f of a sprung support [N/mm], > 0; none: it is rigid
    FrictionLaw friction;
    ContactSettings contact;
    std::optional<double> penalty_factor; ///< of an automatic penalty, see contact_penalties()
    double longest_face     = 0.;         ///< of a graded mesh, see contact_penalties() [mm]
    Solution solution       = Solution::automatic;
    double layer_thickness  = 0.; ///< [mm]
    double interface_offset = 0.; ///< e [mm]
    Cylinder cylinder{};          ///< in space
    Geometry geometry{};          ///< of the cylinder's path
    bool is_damper = false;       ///< whether the geometry is the damper's, see static_terms(); else another body on another path
  };

  /// Returns the properties of a single lever, or of the first of a pair as if it were alone.
  LeverProperties lever_properties(const Device &device);

  /// Returns the properties of the scene's lever, or of both of its full pair, each in its own (the second in mirrored) axes.
  std::vector<LeverProperties> all_lever_properties(const Device &device);

  /// Returns the beginning of a reason: the lever locks where it moves back with s <= mu e; empty elsewhere. The row holds s, mu
  /// and F. A lever that bends may stick there for a while and slide on.
  std::string check_locking(const Row &row, double interface_offset, const DrivePoint &drive);

  /// Returns that linear elasticity does not hold where the pressure exceeds half of Young's modulus of the friction face [MPa];
  /// empty elsewhere.
  std::string check_pressure(double pressure, double young_modulus);
} // namespace sprag
