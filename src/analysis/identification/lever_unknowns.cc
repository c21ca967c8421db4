// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/lever_unknowns.h"
#include "laws/friction.h"
#include "scene/scene.h"

#include "base/append.h"
#include "base/errors.h"
#include "base/text.h"
#include "scene/closed_form.h"
#include "scene/identification_text.h"
#include "scene/read.h"
#include "scene/sections.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int polynomial_rows = 61;   ///< of the table that a polynomial becomes
    constexpr double large_share           = 0.25; ///< of R - e and th0: a change that is large
    constexpr double beyond_peak           = 1.25;

    double root_mean_square(const std::vector<double> &values)
    {
      double squares = 0., count = 0.;
      for (const double value : values)
        if (!std::isnan(value))
        {
          squares += value * value;
          count += 1.;
        }
      return std::sqrt(squares / count);
    }

    /// Back to their defaults: those that count only with another law and would be refused beside this one.
    std::vector<std::string> without_other_laws(const std::string &law)
    {
      SceneSettings defaults;
      std::vector<std::string> result = { "Friction/Law=" + law };
      for (const auto &parameter : scene_parameters(defaults))
        if (parameter.choice == "Friction/Law" && parameter.chosen != law)
          result.push_back(full_name(parameter) + "=" + parameter.default_value);
      return result;
    }
  } // namespace

  LeverUnknowns::LeverUnknowns(const Scene &of_lever, const MeasuredMotion &motion)
      : scene(of_lever)
      , peak_speed(motion.peak_speed())
  {
    const auto &geometry = scene.geometry;
    for (const auto unknown : scene.identification.sought)
      switch (unknown)
      {
      case Unknown::stiffness:
        all.push_back({ "k", "N mm/rad", "stiffness of the rotational spring", scene.spring.stiffness, scene.spring.stiffness });
        break;
      case Unknown::interface_offset:
        all.push_back({ "e", "mm", "from the pivot to the friction interface", geometry.interface_offset,
                        large_share * (geometry.cylinder_radius - geometry.interface_offset) });
        break;
      case Unknown::inclination:
      {
        const double theta = kinematics(geometry, 0.).theta;
        all.push_back({ "th0", "rad", "inclination at x = 0, by the pivot's height", theta, large_share * theta });
        break;
      }
      case Unknown::force_offsets:
        add_offsets();
        break;
      case Unknown::lag:
      {
        const auto &first = motion.strokes().front();
        all.push_back({ "lag", "s", "of the forces behind x", 0.,
                        0.01 * motion.spacing() * static_cast<double>(first.last - first.first) });
        break;
      }
      default:
        add_friction(unknown, motion);
      }
  }

  void LeverUnknowns::add_friction(const Unknown unknown, const MeasuredMotion &motion)
  {
    const double v  = motion.peak_speed();
    const double mu = sliding_friction(scene, 0., v).coefficient;
    if (unknown == Unknown::friction_constant)
      all.push_back({ "mu", "1", "friction coefficient", mu, 1. });
    else if (unknown == Unknown::friction_factor)
      all.push_back({ "friction_factor", "1", "times mu of the scene's law", scene.friction.factor, 1. });
    else if (unknown == Unknown::friction_polynomial)
    {
      all.push_back({ "mu_0", "1", "of mu = mu_0 + mu_1 v + mu_2 v^2", mu, 1. });
      all.push_back({ "mu_1", "s/mm", "of mu", 0., 1. / v });
      all.push_back({ "mu_2", "s^2/mm^2", "of mu", 0., 1. / (v * v) });
    }
    else
      for (const double speed : scene.identification.friction_speeds)
        all.push_back({ "mu_at_" + rounded_text(speed), "1", "mu at " + rounded_text(speed) + " mm/s",
                        friction_coefficient(scene.friction, speed).coefficient, 1. });
  }

  void LeverUnknowns::add_offsets()
  {
    for (const auto &channel : scene.identification.measured.channels)
    {
      const auto word = word_for(force_words(), channel.force);
      all.push_back({ "offset_" + word, "N", "what " + word + " shows above the force", 0., root_mean_square(channel.values) });
    }
  }

  std::vector<std::pair<double, double>> LeverUnknowns::friction_rows(const std::vector<double> &values) const
  {
    std::vector<std::pair<double, double>> rows;
    const auto &speeds = scene.identification.friction_speeds;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].name == "mu_0")
        for (unsigned int row = 0; row < polynomial_rows; ++row)
        {
          const double v  = beyond_peak * peak_speed * row / (polynomial_rows - 1);
          const double mu = values[i] + v * (values[i + 1] + v * values[i + 2]);
          rows.emplace_back(v, std::clamp(mu, 0., 10.));
        }
      else if (all[i].name.rfind("mu_at_", 0) == 0)
        rows.emplace_back(speeds[rows.size()], values[i]);
    return rows;
  }

  IdentifiedLever LeverUnknowns::lever(const std::vector<double> &values) const
  {
    const auto &channels = scene.identification.measured.channels;
    IdentifiedLever result{ scene.geometry, scene.friction, scene.spring.stiffness, std::vector<double>(channels.size()) };
    std::size_t offset = 0;
    std::optional<double> theta;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const auto &name = all[i].name;
      if (name == "k")
        result.stiffness = values[i];
      else if (name == "e")
        result.geometry.interface_offset = values[i];
      else if (name == "th0")
        theta = values[i];
      else if (name == "mu")
        result.friction = { CoulombFriction{ values[i] }, scene.friction.speed };
      else if (name == "friction_factor")
        result.friction.factor = values[i];
      else if (name == "lag")
        result.lag = values[i];
      else if (name.rfind("offset_", 0) == 0)
        result.offsets[offset++] = values[i];
    }
    if (const auto rows = friction_rows(values); !rows.empty())
    {
      std::vector<double> speeds, coefficients;
      for (const auto &[speed, mu] : rows)
      {
        speeds.push_back(speed);
        coefficients.push_back(mu);
      }
      result.friction = { TabulatedFriction(speeds, coefficients), scene.friction.speed };
    }
    auto &geometry = result.geometry;
    if (theta)
      geometry.pivot_height =
          (geometry.cylinder_radius - geometry.interface_offset - geometry.pivot_distance * std::sin(*theta)) / std::cos(*theta);
    const double arm = geometry.cylinder_radius - geometry.interface_offset;
    if (!(result.stiffness > 0.) || !(arm > 0.) || !(geometry.pivot_height < arm) || (theta && !(std::abs(*theta) < M_PI_2)))
      throw InputError("the values make no lever");
    return result;
  }

  Scene LeverUnknowns::scene_with(const IdentifiedLever &lever) const
  {
    Scene result            = scene;
    result.geometry         = lever.geometry;
    result.friction         = lever.friction;
    result.spring.stiffness = lever.stiffness;
    return result;
  }

  std::vector<std::string> LeverUnknowns::overrides(const IdentifiedLever &lever, const std::string &friction_table) const
  {
    std::vector<std::string> result;
    for (const auto &number : all)
      if (number.name == "k")
        result.push_back(override_text("Rotational spring/Stiffness", lever.stiffness));
      else if (number.name == "e")
        result.push_back(override_text("Geometry/Interface offset", lever.geometry.interface_offset));
      else if (number.name == "th0")
        result.push_back(override_text("Geometry/Pivot height", lever.geometry.pivot_height));
      else if (number.name == "friction_factor")
        result.push_back(override_text("Friction/Factor", lever.friction.factor));
      else if (number.name == "mu")
      {
        append(result, without_other_laws("Coulomb"));
        result.push_back(override_text("Friction/Coefficient", std::get<CoulombFriction>(lever.friction.law).coefficient));
        result.push_back("Friction/Factor=1");
      }
    if (!friction_table.empty())
    {
      append(result, without_other_laws("table"));
      append(result, { "Friction/Table=" + friction_table, "Friction/Factor=1" });
    }
    return result;
  }
} // namespace sprag
