// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/lever_groups.h"

#include "base/text.h"
#include "fe/body/body_properties.h"
#include "scene/device.h"

namespace sprag
{
  namespace
  {
    using Names    = std::set<std::string>;
    using Messages = std::vector<std::string>;

    struct LeverGroup
    {
      std::string name;
      std::string meaning;
    };

    /// Groups of one kind that a mesh has.
    struct Found
    {
      std::string kind; ///< "surface"
      const Names &names;

      bool has(const std::string &name) const
      {
        return names.count(name) != 0;
      }
    };

    /// "no physical surface 'name', meaning (surfaces found: ...)", where it is not there.
    void need(const LeverGroup &group, const Found &found, Messages &result, const std::string &wish = "")
    {
      const auto &[name, meaning] = group;
      if (!found.has(name))
        result.push_back(wish + "no physical " + found.kind + " '" + name + "', " + meaning + " (" + found.kind +
                         "s found: " + quoted_list(found.names) + ")" +
                         did_you_mean(nearest(name, { found.names.begin(), found.names.end() })));
    }

    Messages missing_groups(const Device &device, const Found &parts, const Found &sides)
    {
      Messages result;
      need({ "friction face", "where the cylinder slides" }, sides, result);
      need({ "lever", "the metal" }, parts, result);
      if (!parts.has("hub"))
        need({ "hub", "which carries the lever on its pivot, nor a " + parts.kind + " 'hub'" }, sides, result);
      if (parts.has("web") && device.frame.web == 0.)
        result.push_back("has a " + parts.kind + " 'web', which must be wider than Lever frame/Web = 0");
      if (device.plate.type == PlateType::none)
      {
        if (parts.has("plate"))
          result.push_back("has a " + parts.kind + " 'plate', but Friction plate/Type = none");
        return result;
      }
      const std::string wish = "Friction plate/Type = on sensors, but there is ";
      need({ "plate", "which the cylinder rubs against" }, parts, result, wish);
      need({ "sensor plate", "the back of the friction plate, towards the sensors" }, sides, result, wish);
      need({ "sensor lever", "the lever's side towards the sensors" }, sides, result, wish);
      return result;
    }
  } // namespace

  MeshGroups lever_groups(const Device &device, const int dimension)
  {
    const bool plane = dimension == 2; // in which a web is a part of its own width
    MeshGroups result;
    result.parts = { { "lever", material_id::lever },
                     { "plate", material_id::plate },
                     { "layer", material_id::layer },
                     { "hub", material_id::hub } };
    if (plane)
      result.parts.emplace("web", material_id::web);
    result.sides = { { "friction face", boundary_id::friction_face },
                     { "hub", boundary_id::hub },
                     { "sensor plate", boundary_id::sensor_plate },
                     { "sensor lever", boundary_id::sensor_lever } };
    result.part_names =
        std::string("'lever', ") + (plane ? "'web', " : "") + "'plate', 'layer' and 'hub' (all but 'lever' optional)";
    result.missing = [&device, plane](const Names &parts, const Names &sides) {
      return missing_groups(device, Found{ plane ? "surface" : "volume", parts }, Found{ plane ? "curve" : "surface", sides });
    };
    return result;
  }
} // namespace sprag
