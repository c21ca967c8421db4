// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "base/text.h"
#include "base/units.h"
#include "report/warnings.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    /// A value, what it can be with room, and units that are used by mistake in place of its own.
    struct CheckedValue
    {
      std::string parameter;
      double value;
      double low;
      double high;
      std::string unit;
      std::string known; ///< of extremes that there are
      std::vector<std::string> mistaken;

      bool is_plausible(const double candidate) const
      {
        return candidate >= low && candidate <= high;
      }
    };

    /// Levers are made a thousand times stiffer than metal on purpose, so that they do not bend.
    CheckedValue young_modulus(const std::string &section, const double value, const double low, const double high,
                               const std::string &softest)
    {
      return {
        section + "/Young's modulus", value, low, high, "MPa", "diamond has 1.2e6 MPa, " + softest, { "Pa", "kPa", "GPa" }
      };
    }

    CheckedValue metal(const std::string &section, const double value)
    {
      return young_modulus(section, value, 300., 1e9, "PTFE 500");
    }

    CheckedValue density(const std::string &section, const double value)
    {
      return { section + "/Density",          value, 1e-11, 3e-8, "t/mm3", "osmium has 2.3e-8 t/mm3, foams 2e-11",
               { "kg/m3", "g/cm3", "kg/mm3" } };
    }

    CheckedValue length(const std::string &parameter, const double value)
    {
      return { parameter, value, 0.5, 1e5, "mm", "parts of such devices measure a millimetre to some metres", { "m", "inch" } };
    }

    /// Its lever of the dimensions given would be lighter than balsa or, with as much again in a hub, ten times as heavy as
    /// osmium.
    CheckedValue inertia(const Lever &lever)
    {
      const double volume_moment = lever.depth * lever.width * std::pow(lever.length, 3) / 3.;
      return { "Lever/Moment of inertia",
               lever.moment_of_inertia,
               5e-11 * volume_moment,
               3e-7 * volume_moment,
               "t mm2",
               "the lever of this length, depth and width has " + rounded_text(2.7e-9 * volume_moment) + " t mm2 of aluminium",
               { "kg m2", "kg mm2", "g mm2" } };
    }

    /// Turned by a radian, it would press with less than 10 N at the pivot's distance, of which levers turn a tenth.
    CheckedValue spring(const Scene &scene)
    {
      const double distance = scene.geometry.pivot_distance;
      return { "Rotational spring/Stiffness",
               scene.spring.stiffness,
               10. * distance,
               1e7 * distance,
               "N mm/rad",
               "model A has 7.4e4 N mm/rad, 400 N/rad at the pivot's distance",
               { "N m/rad", "N mm/deg", "N m/deg" } };
    }

    std::vector<CheckedValue> checked_values(const Scene &scene)
    {
      return { metal("Lever", scene.lever.young_modulus),
               metal("Friction plate", scene.plate.young_modulus),
               metal("Leaf spring", scene.spring.leaf.young_modulus),
               young_modulus("Friction layer", scene.layer.young_modulus, 1e-3, 5e6, "gels 0.01"),
               young_modulus("Cylinder", scene.cylinder.young_modulus, 1e-3, 5e6, "gels 0.01"),
               density("Lever", scene.lever.density),
               density("Friction plate", scene.plate.density),
               density("Leaf spring", scene.spring.leaf.density),
               density("Friction layer", scene.layer.density),
               density("Cylinder", scene.cylinder.density),
               length("Geometry/Cylinder radius", scene.geometry.cylinder_radius),
               length("Geometry/Pivot distance", scene.geometry.pivot_distance),
               length("Leaf spring/Length", scene.spring.leaf.length),
               length("Lever/Length", scene.lever.length),
               length("Lever/Depth", scene.lever.depth),
               length("Lever/Width", scene.lever.width),
               inertia(scene.lever),
               spring(scene) };
    }

    /// "2700 kg/m3, which is 2.7e-09 t/mm3", of the first unit in which the value is plausible; empty where it is in none.
    std::string meant(const CheckedValue &checked)
    {
      try
      {
        for (const auto &unit : checked.mistaken)
          if (const double value = checked.value * unit_factor(unit, checked.unit); checked.is_plausible(value))
            return rounded_text(checked.value) + ' ' + unit + ", which is " + rounded_text(value) + ' ' + checked.unit;
      }
      catch (const InputError &)
      {
        // Without the data base of units there is nothing to propose.
      }
      return {};
    }
  } // namespace

  Warnings implausible_values(const Scene &scene)
  {
    std::string found, remedy;
    for (const auto &checked : checked_values(scene))
    {
      if (scene.specified.count(checked.parameter) == 0 || checked.is_plausible(checked.value))
        continue;
      const bool is_small = checked.value < checked.low;
      found += (found.empty() ? "" : " ") + checked.parameter + " = " + rounded_text(checked.value) + ' ' + checked.unit +
               " is " + (is_small ? "less" : "more") + " than " + rounded_text(is_small ? checked.low : checked.high) + ' ' +
               checked.unit + ": " + checked.known + '.';
      if (const auto likely = meant(checked); !likely.empty())
        remedy += checked.parameter + " may be meant as " + likely + ". ";
    }
    Warnings warnings;
    if (!found.empty())
      warnings.push_back({ "implausible_values", found,
                           "No solid or no such device has that: all results that depend on it are of another one.",
                           remedy + "Give the unit behind the number, or the number in the parameter's own unit." });
    return warnings;
  }
} // namespace sprag
