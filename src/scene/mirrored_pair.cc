// SPDX-License-Identifier: GPL-3.0-only
#include "scene/mirrored_pair.h"

#include "scene/closed_form.h"
#include "scene/scene.h"

namespace sprag
{
  unsigned int count_levers(const Device &device)
  {
    return device.pair.type == PairType::full ? 2 : 1;
  }

  Device lever_device(const Device &device, const unsigned int lever)
  {
    Device result   = device;
    result.geometry = lever_geometry(device, lever);
    result.friction = lever_friction(device, lever);
    result.spring   = lever_spring(device, lever);
    result.contact  = lever_contact(device, lever);
    if (lever == 1)
      result.cylinder.tilt = -result.cylinder.tilt;
    return result;
  }

  Geometry lever_geometry(const Device &device, const unsigned int lever)
  {
    Geometry result = device.geometry;
    if (count_levers(device) == 2)
      result.pivot_height -= (lever == 0 ? 1. : -1.) * device.pair.cylinder_offset;
    return result;
  }

  FrictionLaw lever_friction(const Device &device, const unsigned int lever)
  {
    FrictionLaw result = device.friction;
    if (lever == 1)
      result.factor *= device.pair.friction_ratio;
    return result;
  }

  RotationalSpring lever_spring(const Device &device, const unsigned int lever)
  {
    RotationalSpring result = device.spring;
    const double ratio      = device.pair.spring_ratio;
    if (swings(device))
      result.ratio *= 2. * ratio / (1. + ratio);
    else if (lever == 1)
      result.ratio *= ratio;
    return result;
  }

  ContactSettings lever_contact(const Device &device, const unsigned int lever)
  {
    ContactSettings result = device.contact;
    const double ratio     = lever == 1 ? device.pair.contact_ratio : 1.;
    result.stiffness *= ratio;
    if (result.tangential_stiffness)
      *result.tangential_stiffness *= ratio;
    return result;
  }

  double rest_inclination(const Device &device)
  {
    return kinematics(device.geometry, 0.).theta;
  }

  bool swings(const Device &device)
  {
    return device.pair.type == PairType::full && device.pair.joint == SpringJoint::free;
  }

  bool swings_otherwise(const Device &device)
  {
    return swings(device) && device.spring.swing;
  }

  Device swinging_device(const Device &device)
  {
    Device result = device;
    if (!device.spring.swing)
      return result;
    result.lever.moment_of_inertia += device.spring.swing->inertia - device.spring.behaviour.inertia;
    result.spring.behaviour = *device.spring.swing;
    result.spring.swing.reset();
    return result;
  }
} // namespace sprag
