// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "scene/discretisation_settings.h"
#include "scene/lever.h"

namespace sprag
{
  struct Device;

  /// Returns 2 for a full pair, else 1.
  unsigned int count_levers(const Device &device);

  /// Returns the device that a lever of a full pair stands in, in axes mirrored for the second (lever = 1): an offset of the
  /// cylinder is an offset of the pivot the other way, a tilt of its axis towards the first lever is one away from the second,
  /// friction, spring and contact are the lever's own. A single lever stands in the device itself.
  Device lever_device(const Device &device, unsigned int lever);

  // These parts are what differs in it, beside the tilt.
  Geometry lever_geometry(const Device &device, unsigned int lever);
  FrictionLaw lever_friction(const Device &device, unsigned int lever);

  /// Returns a lever's spring. On a free joint that is one of two alike which do what both do in series.
  RotationalSpring lever_spring(const Device &device, unsigned int lever);

  /// Returns the contact of a lever, the whole of whose stiffness is its own: that in stick as well.
  ContactSettings lever_contact(const Device &device, unsigned int lever);

  /// Returns the inclination of a lever without moment, which is that of ideal contact at x = 0 with the cylinder in the mirror
  /// plane [rad].
  double rest_inclination(const Device &device);

  /// Returns whether the levers of a full pair can swing together without a moment of their springs.
  bool swings(const Device &device);

  /// Returns whether that is another motion of springs and joint, with inertia of its own, than the one in which the levers
  /// mirror each other.
  bool swings_otherwise(const Device &device);

  /// Returns the device of a lever while both swing together. It has the inertia of leaf springs and joint in that motion, and
  /// the stiffness of the spring as it is, which the joint takes back.
  Device swinging_device(const Device &device);
} // namespace sprag
