// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/identification.h"
#include "laws/friction_law.h"
#include "scene/scene.h"

#include "base/errors.h"
#include "base/least_squares.h"
#include "base/ranges.h"
#include "base/text.h"
#include "input/analysis_texts.h"
#include "input/read.h"
#include "input/sections.h"
#include "scene/closed_form.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  namespace
  {
    constexpr double least_stroke            = 0.02; ///< share of the range of x; shorter returns are noise
    constexpr std::size_t windows_per_stroke = 40;   ///< in which lines are fitted to x(t) for the speed
    constexpr std::size_t largest_half_width = 50;   ///< rows of such a window before or after its middle

    /// Returns the Hermite cubic at s = `share` of an interval of length `step`, by values and slopes at its ends.
    double cubic(const double share, const double step, const double from, const double to, const double v_from,
                 const double v_to)
    {
      const double s = share;
      return (1. + 2. * s) * (1. - s) * (1. - s) * from + s * s * (3. - 2. * s) * to +
             step * (s * (1. - s) * (1. - s) * v_from - s * s * (1. - s) * v_to);
    }

    constexpr unsigned int polynomial_rows = 61;   ///< rows of the table of mu(v) written for a polynomial
    constexpr double large_share           = 0.25; ///< scale of e and th0, as a share of R - e and th0
    constexpr double largest_table_speed   = 1.25; ///< of that table, over the peak speed

    /// A number of a lever that is a parameter of its scene.
    struct LeverParameter
    {
      std::string name;
      double &(*number)(IdentifiedLever &lever);
    };

    /// Parameters of the scene by the name of the unknown.
    const std::map<std::string, LeverParameter> lever_parameters = {
      { "k", { "Rotational spring/Stiffness", [](IdentifiedLever &lever) -> double & { return lever.stiffness; } } },
      { "rest", { "Rotational spring/Rest angle", [](IdentifiedLever &lever) -> double & { return lever.rest_angle; } } },
      { "e",
        { "Geometry/Interface offset", [](IdentifiedLever &lever) -> double & { return lever.geometry.interface_offset; } } },
      { "th0", { "Geometry/Pivot height", [](IdentifiedLever &lever) -> double & { return lever.geometry.pivot_height; } } },
      { "friction_factor", { "Friction/Factor", [](IdentifiedLever &lever) -> double & { return lever.friction.factor; } } }
    };

    /// Returns overrides that choose a law and reset the parameters of the others, which would be refused beside it.
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

  MeasuredMotion::MeasuredMotion(const Scene &scene)
      : time(scene.identification.measured.time)
      , x(scene.identification.measured.x)
  {
    const bool by_drive = x.empty();
    for (std::size_t row = 0; by_drive && row < time.size(); ++row)
      x.push_back(scene.drive.at(time[row]).x);
    find_strokes();
    for (const auto &stroke : all)
    {
      std::vector<double> found;
      if (!by_drive && !time.empty())
        found = measured_speeds(stroke);
      for (std::size_t row = stroke.first; by_drive && row <= stroke.last; ++row)
        found.push_back(scene.drive.at(time[row], row == stroke.first ? Drive::Side::after : Drive::Side::before).v);
      if (found.empty())
        found.assign(stroke.last - stroke.first + 1, stroke.direction * scene.drive.peak_speed());
      speeds.push_back(found);
    }
    for (const auto &stroke_speeds : speeds)
      for (const double speed : stroke_speeds)
        fastest = std::max(fastest, std::abs(speed));
  }

  void MeasuredMotion::find_strokes()
  {
    const auto range   = std::minmax_element(x.begin(), x.end());
    const double least = least_stroke * (*range.second - *range.first);
    std::size_t first = 0, lowest = 0, highest = 0;
    int direction  = 0;
    const auto end = [&](const std::size_t turn)
    {
      all.push_back({ first, turn, direction });
      first     = turn;
      direction = -direction;
      lowest = highest = turn;
    };
    for (std::size_t row = 0; row < x.size(); ++row)
    {
      lowest  = x[row] < x[lowest] ? row : lowest;
      highest = x[row] > x[highest] ? row : highest;
      if (direction == 0 && x[highest] - x[lowest] > least)
      {
        direction = highest > lowest ? 1 : -1;
        first     = direction > 0 ? lowest : highest;
      }
      else if (direction > 0 && x[highest] - x[row] > least)
      {
        end(highest);
        lowest = row;
      }
      else if (direction < 0 && x[row] - x[lowest] > least)
      {
        end(lowest);
        highest = row;
      }
    }
    end(direction > 0 ? highest : lowest);
  }

  std::vector<double> MeasuredMotion::measured_speeds(const Stroke &stroke) const
  {
    const auto rows   = stroke.last - stroke.first + 1;
    const auto widest = std::clamp<std::size_t>(rows / windows_per_stroke / 2, 2, largest_half_width);
    std::vector<double> result;
    for (std::size_t row = stroke.first; row <= stroke.last; ++row)
    {
      // With as many rows before as after, the slope of the line has an error of second order in the window.
      const auto half = std::max<std::size_t>(1, std::min({ widest, row - stroke.first, stroke.last - row }));
      const auto from = std::max(row, stroke.first + half) - half;
      const auto to   = std::min(row + half, stroke.last) + 1;
      const auto part = [&](const std::vector<double> &values)
      { return std::vector<double>(values.begin() + from, values.begin() + to); };
      const auto times = part(time);
      result.push_back(times.back() > times.front() ? fitted_line(times, part(x)).slope : 0.);
    }
    return result;
  }

  std::size_t MeasuredMotion::stroke_at(const std::size_t row, const double lag) const
  {
    std::size_t stroke = 0;
    const auto begun = [&](const Stroke &next) { return time.empty() ? row >= next.first : time[row] - lag >= time[next.first]; };
    while (stroke + 1 < all.size() && begun(all[stroke + 1]))
      ++stroke;
    return stroke;
  }

  bool MeasuredMotion::covers(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    const auto &[first, last, direction] = all[stroke];
    if (time.empty())
      return row > first && row < last;
    return time[row] - lag > time[first] && time[row] - lag < time[last];
  }

  MeasuredMotion::Place MeasuredMotion::at(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    const Stroke &within = all[stroke];
    const auto &v        = speeds[stroke];
    const auto place     = std::clamp(row, within.first, within.last);
    if (time.empty() || (lag == 0. && place == row))
      return { x[place], v[place - within.first] };
    const double when = time[row] - lag;
    if (when <= time[within.first])
      return { x[within.first] + v.front() * (when - time[within.first]), v.front() };
    if (when >= time[within.last])
      return { x[within.last] + v.back() * (when - time[within.last]), v.back() };
    const auto next    = std::upper_bound(time.begin() + within.first + 1, time.begin() + within.last, when) - time.begin();
    const auto i       = static_cast<std::size_t>(next) - 1;
    const auto j       = i - within.first;
    const double step  = time[i + 1] - time[i];
    const double share = (when - time[i]) / step;
    return { cubic(share, step, x[i], x[i + 1], v[j], v[j + 1]), v[j] + share * (v[j + 1] - v[j]) };
  }

  double MeasuredMotion::travel(const std::size_t row, const double lag, const std::size_t stroke) const
  {
    return all[stroke].direction * (at(row, lag, stroke).x - x[all[stroke].first]);
  }

  double MeasuredMotion::length(const std::size_t stroke) const
  {
    return std::abs(x[all[stroke].last] - x[all[stroke].first]);
  }

  double MeasuredMotion::spacing() const
  {
    return time.size() < 2 ? 0. : (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  }

  LeverUnknowns::LeverUnknowns(const Scene &scene_, const MeasuredMotion &motion)
      : scene(scene_)
      , peak_speed(motion.peak_speed())
  {
    const auto &geometry = scene.geometry;
    const double theta   = kinematics(geometry, 0.).theta;
    const auto &first    = motion.strokes().front();
    for (const auto unknown : scene.identification.sought)
      if (unknown == Unknown::stiffness)
        all.push_back({ "k", "N mm/rad", "stiffness of the rotational spring", scene.spring.stiffness, scene.spring.stiffness });
      else if (unknown == Unknown::interface_offset)
        all.push_back({ "e", "mm", "from the pivot to the friction interface", geometry.interface_offset,
                        large_share * (geometry.cylinder_radius - geometry.interface_offset) });
      else if (unknown == Unknown::inclination)
        all.push_back({ "th0", "rad", "inclination at x = 0, by the pivot's height", theta, large_share * theta });
      else if (unknown == Unknown::rest_angle)
        all.push_back({ "rest", "rad", "turn of the lever at which the rotational spring has no moment", scene.spring.rest_angle,
                        large_share * theta });
      else if (unknown == Unknown::lag)
        all.push_back({ "lag", "s", "of the forces behind x", 0.,
                        0.01 * motion.spacing() * static_cast<double>(first.last - first.first) });
      else if (unknown == Unknown::force_offsets)
        add_offsets();
      else
        add_friction(unknown, motion);
  }

  void LeverUnknowns::add_friction(const Unknown unknown, const MeasuredMotion &motion)
  {
    const double v  = motion.peak_speed();
    const double mu = closed_form(scene, 0., v).mu;
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
      all.push_back({ "offset_" + word, "N", "what " + word + " shows above the force", 0.,
                      root_mean_square(filtered(channel.values, [](const double value) { return !std::isnan(value); })) });
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
          const double v  = largest_table_speed * peak_speed * row / (polynomial_rows - 1);
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
    IdentifiedLever result{ scene.geometry, scene.friction, scene.spring.stiffness, scene.spring.rest_angle,
                            std::vector<double>(channels.size()) };
    std::size_t offset = 0;
    std::optional<double> theta;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const auto &name = all[i].name;
      if (name == "th0")
        theta = values[i];
      else if (name == "mu")
        result.friction = { CoulombFriction{ values[i] }, scene.friction.speed };
      else if (name == "lag")
        result.lag = values[i];
      else if (const auto parameter = lever_parameters.find(name); parameter != lever_parameters.end())
        parameter->second.number(result) = values[i];
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
    if (theta) // R - e = l sin(theta_0) + h cos(theta_0) (eq. 9), solved for h
      geometry.pivot_height =
          (geometry.cylinder_radius - geometry.interface_offset - geometry.pivot_distance * std::sin(*theta)) / std::cos(*theta);
    const double arm = geometry.cylinder_radius - geometry.interface_offset;
    if (!(result.stiffness > 0.) || !(arm > 0.) || !(geometry.pivot_height < arm) || (theta && !(std::abs(*theta) < M_PI_2)))
      throw InputError("the values make no lever");
    return result;
  }

  Scene LeverUnknowns::scene_with(const IdentifiedLever &lever) const
  {
    Scene result             = scene;
    result.geometry          = lever.geometry;
    result.friction          = lever.friction;
    result.spring.stiffness  = lever.stiffness;
    result.spring.rest_angle = lever.rest_angle;
    return result;
  }

  std::vector<std::string> LeverUnknowns::overrides(IdentifiedLever lever, const std::string &friction_table) const
  {
    std::vector<std::string> result;
    for (const auto &number : all)
      if (const auto parameter = lever_parameters.find(number.name); parameter != lever_parameters.end())
        result.push_back(override_text(parameter->second.name, parameter->second.number(lever)));
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

  std::string LeverUnknowns::ranges(const std::vector<double> &values, const std::vector<double> &low,
                                    const std::vector<double> &high) const
  {
    std::vector<std::string> result;
    const auto add = [&](const std::string &parameter, const double from, const double to)
    { result.push_back(parameter + formatted(" %.5g %.5g", std::min(from, to), std::max(from, to))); };
    constexpr double narrow = 1e-5; // over the unknown's scale: what five digits do not show
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (high[i] - low[i] <= narrow * all[i].scale)
        continue;
      const auto at = [&](const std::vector<double> &end)
      {
        auto changed = values;
        changed[i]   = end[i];
        return lever(changed);
      };
      if (const auto parameter = lever_parameters.find(all[i].name); parameter != lever_parameters.end())
      {
        auto first = at(low), second = at(high);
        add(parameter->second.name, parameter->second.number(first), parameter->second.number(second));
      }
      else if (all[i].name == "mu")
        add("Friction/Coefficient", low[i], high[i]);
    }
    return result.empty() ? "none" : boost::algorithm::join(result, "; ");
  }
} // namespace sprag
