// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/calibration/calibration.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "input/read.h"
#include "levers/dynamics.h"
#include "levers/prepared_scene.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int positions = 14; ///< of the comparison, over the drive

    /// Returns the thickness of the leaf spring [mm] with the target stiffness [N mm/rad].
    double calibrated_thickness(const Scene &scene, const double target)
    {
      // The stiffness rises with about thickness^3; a leaf thicker than a fifth of its length is no beam.
      const double thinnest = 1e-3 * scene.spring.leaf.length;
      const double thickest = 0.2 * scene.spring.leaf.length;
      const auto excess     = [&](const double log_thickness)
      { return std::log(leaf_stiffness(scene, std::exp(log_thickness)) / target); };
      const double least = excess(std::log(thinnest));
      const double most  = excess(std::log(thickest));
      if (least > 0. || most < 0.)
        throw InputError(scene.name + ".prm: Calibration/Stiffness = " + rounded_text(target) +
                         " N mm/rad cannot be reached: leaf springs of this length, " + rounded_text(thinnest) + " to " +
                         mm(thickest) + " thick, have " + rounded_text(target * std::exp(least)) + " to " +
                         rounded_text(target * std::exp(most)));
      const auto close             = [](const double a, const double b) { return b - a < 1e-11; };
      boost::uintmax_t most_solves = 60;
      const auto root =
          boost::math::tools::toms748_solve(excess, std::log(thinnest), std::log(thickest), least, most, close, most_solves);
      return std::exp(0.5 * (root.first + root.second));
    }

    /// Returns the added mass at the tip [t] or inertia of the hub [t mm^2] that gives the lever the target J [t mm^2].
    double calibrated_mass(Scene scene, const double target)
    {
      const bool at_tip     = scene.calibration.mass == AddedMass::tip;
      double &added         = at_tip ? scene.lever.tip_mass : scene.lever.hub_inertia;
      added                 = 0.;
      const double without  = inertia_as_built(scene);
      added                 = at_tip ? 1e-3 : 1.;
      const double per_unit = at_tip ? (inertia_as_built(scene) - without) / added : 1.;
      if (target < without)
        throw InputError(scene.name + ".prm: Calibration/Moment of inertia = " + rounded_text(target) +
                         " t mm2 cannot be reached: the parts as built have " + rounded_text(without) +
                         " t mm2 without added mass");
      return (target - without) / per_unit;
    }

    /// Returns E = 12 E I/(b d^3) of a bar of the scene's section with that bending stiffness; times 1 - nu^2 in plane strain.
    double equivalent_modulus(const Scene &scene, const double bending_stiffness)
    {
      const Lever &lever  = scene.lever;
      const double nu     = lever.poisson_ratio;
      const double strain = scene.analysis.plane == PlaneState::strain ? 1. - nu * nu : 1.;
      return strain * 12. * bending_stiffness / (lever.width * std::pow(lever.depth, 3));
    }

    /// Returns the two lowest frequencies [Hz].
    std::vector<double> lowest_frequencies(DynamicModel &model, const HeldSlide &slide, const bool in_contact)
    {
      std::vector<double> result;
      for (const auto &mode : model.vibrations(slide, in_contact, 2))
        if (result.size() < 2)
          result.push_back(std::abs(mode.mode.eigenvalue) / (2. * M_PI));
      return result;
    }
  } // namespace

  CalibratedParts calibrate_parts(const Scene &scene)
  {
    CalibratedParts result;
    const auto &target = scene.calibration;
    if (target.stiffness)
    {
      result.thickness = calibrated_thickness(scene, *target.stiffness);
      result.overrides.push_back(override_text("Leaf spring/Thickness", *result.thickness));
    }
    result.scene = prepared(variant(scene, result.overrides));
    if (target.moment_of_inertia)
    {
      const std::string parameter = target.mass == AddedMass::tip ? "Lever/Tip mass" : "Lever/Hub inertia";
      result.added                = calibrated_mass(result.scene, *target.moment_of_inertia);
      append<std::string>(result.overrides, { "Lever/Inertia=as built", override_text(parameter, *result.added),
                                              override_text("Lever/Moment of inertia", *target.moment_of_inertia) });
      result.scene = prepared(variant(scene, result.overrides));
    }
    return result;
  }

  ReducedConstants reduced_constants(const Scene &scene)
  {
    ReducedConstants result;
    const auto constants     = meshed_constants(scene);
    result.stiffness         = scene.spring.stiffness;
    result.moment_of_inertia = constants.moment_of_inertia;
    result.bending           = constants.bending;
    result.contact           = indent(scene, result.bending.stiffness);

    result.overrides = { "Analysis/Model=beam",
                         "Lever/Outline=bar",
                         "Friction plate/Type=none",
                         "Cylinder/Type=rigid",
                         "Mesh/File=",
                         "Lever/Inertia=scaled",
                         override_text("Lever/Moment of inertia", result.moment_of_inertia),
                         override_text("Lever/Young's modulus", equivalent_modulus(scene, result.bending.stiffness)),
                         override_text("Lever/Neutral axis offset", result.bending.neutral_axis_offset),
                         override_text("Contact/Stiffness", result.contact.fit.stiffness),
                         override_text("Contact/Exponent", result.contact.fit.exponent) };
    return result;
  }

  double Disagreement::force_deviation(const unsigned int which) const
  {
    double largest    = 0.;
    double difference = 0.;
    for (const auto &point : sliding)
    {
      const auto value = [&](const unsigned int model) { return which == 0 ? point.forces[model].P : point.forces[model].Q; };
      largest          = std::max(largest, std::abs(value(0)));
      difference       = std::max(difference, std::abs(value(1) - value(0)));
    }
    return difference / largest;
  }

  Disagreement compare(const Scene &meshed, const Scene &beam)
  {
    Disagreement result;
    const std::array<const Scene *, 2> scenes = { { &meshed, &beam } };
    std::array<std::vector<std::vector<SlidingForces>>, 2> forces;
    std::vector<DrivePoint> points;
    const double from = meshed.drive.minimum();
    const double to   = meshed.drive.maximum();
    for (const double direction : { 1., -1. })
      for (unsigned int i = 1; i <= positions; ++i)
        points.push_back({ 0., from + (to - from) * i / positions, direction * meshed.drive.peak_speed(), 0. });
    for (unsigned int model = 0; model < 2; ++model)
    {
      Scene scene             = *scenes[model];
      scene.stability.damping = false;
      scene                   = held_scene(scene);
      const auto dynamics     = DynamicsMaker(false).make(scene);
      for (const auto &point : points)
        forces[model].push_back(dynamics.model().sliding_forces(point));
      if (const auto slide = dynamics.model().hold(held_drive(scene), ContactFriction::none))
      {
        result.free_frequencies[model]    = lowest_frequencies(dynamics.model(), *slide, false);
        result.contact_frequencies[model] = lowest_frequencies(dynamics.model(), *slide, true);
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!forces[0][i].empty() && !forces[1][i].empty())
        result.sliding.push_back(
            { points[i].x, std::copysign(1., points[i].v), { { forces[0][i].front(), forces[1][i].front() } } });
    return result;
  }
} // namespace sprag
