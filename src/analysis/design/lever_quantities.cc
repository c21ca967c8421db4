// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/lever_quantities.h"

#include "analytic/harmonic_balance.h"
#include "analytic/isolation.h"
#include "base/errors.h"
#include "scene/closed_form.h"
#include "scene/contact_width.h"
#include "scene/damper.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    using Q = DesignQuantity;

    constexpr unsigned int intervals = 32; ///< of the stroke

    double place(const Scene &scene, const unsigned int i)
    {
      return scene.drive.minimum() + (scene.drive.maximum() - scene.drive.minimum()) * i / intervals;
    }

    /// Least (s - mu e)/s on the way back.
    double least_margin(const Scene &scene)
    {
      double least = 1.;
      for (unsigned int i = 0; i <= intervals; ++i)
      {
        const double x     = place(scene, i);
        const double v     = -scene.drive.peak_speed();
        const auto contact = kinematics(scene.geometry, x);
        const double mu    = sliding_friction(scene, x, v).coefficient;
        least              = std::min(least, 1. - mu * scene.geometry.interface_offset / contact.s);
      }
      return least;
    }

    void add_slopes(const Scene &scene, DesignQuantities &result)
    {
      const double v             = scene.drive.peak_speed();
      const double mu            = sliding_friction(scene, 0., v).coefficient;
      const double k             = scene.spring.stiffness;
      const double out           = representative_slope(scene.geometry, k, mu, 1);
      const double back          = representative_slope(scene.geometry, k, mu, -1);
      result[Q::forward_slope]   = out;
      result[Q::backward_slope]  = back;
      result[Q::damping_slope]   = 0.5 * (out - back);
      result[Q::restoring_slope] = 0.5 * (out + back);
      result[Q::slope_ratio]     = ratio_of_ways(out, back);
      result[Q::friction_ratio]  = scene.isolation.levers * result[Q::damping_slope] / scene.isolation.stiffness;
    }

    double largest_size_of(const std::vector<double> &forces)
    {
      double largest = 0.;
      for (const double force : forces)
        largest = std::max(largest, std::abs(force));
      return largest;
    }

    /// By Simpson's rule over an even number of intervals.
    double integral_of(const std::vector<double> &values, const double length)
    {
      double sum = values.front() + values.back();
      for (std::size_t i = 1; i + 1 < values.size(); ++i)
        sum += (i % 2 == 1 ? 4. : 2.) * values[i];
      return sum * length / (3. * static_cast<double>(values.size() - 1));
    }

    void add_forces(const Scene &scene, DesignQuantities &result)
    {
      std::vector<double> places, forward, backward, opening;
      double largest_P = 0.;
      const double v   = scene.drive.peak_speed();
      for (unsigned int i = 0; i <= intervals; ++i)
      {
        const double x  = place(scene, i);
        const auto out  = closed_form(scene, x, v);
        const auto back = closed_form(scene, x, -v);
        places.push_back(x);
        forward.push_back(out.Q);
        backward.push_back(back.Q);
        opening.push_back(out.Q - back.Q);
        largest_P = std::max({ largest_P, out.P, back.P });
      }
      result[Q::force_ratio]          = ratio_of_ways(forward.back(), backward.back());
      result[Q::nonlinearity]         = std::max(nonlinearity_of(places, forward), nonlinearity_of(places, backward));
      result[Q::largest_force]        = std::max(largest_size_of(forward), largest_size_of(backward));
      result[Q::largest_normal_force] = largest_P;
      result[Q::largest_pressure]     = layer_pressure(scene, largest_P);
      result[Q::loop_area]            = integral_of(opening, scene.drive.maximum() - scene.drive.minimum());
    }

    /// Ends at infinity where the table cannot be followed.
    double offset_of(const Scene &scene)
    {
      IsolationFindings found;
      if (std::abs(scene.isolation.initial_displacement) >= damper_of(scene).reach)
        return std::numeric_limits<double>::infinity();
      try
      {
        run_isolation(scene, found, {});
        return std::abs(found.residual_offset);
      }
      catch (const AnalysisError &)
      {
        return std::numeric_limits<double>::infinity();
      }
    }

    void add_harmonic(const Scene &scene, DesignQuantities &quantities)
    {
      constexpr double infinite = std::numeric_limits<double>::infinity();
      const auto &isolation     = scene.isolation;
      const auto motions =
          harmonic_balance(isolation_system(scene), isolation.base_amplitude, 2. * M_PI * isolation.base_frequency);
      quantities[Q::transmissibility]   = motions.empty() ? infinite : 0.;
      quantities[Q::relative_amplitude] = motions.empty() ? infinite : 0.;
      for (const auto &motion : motions)
      {
        quantities[Q::transmissibility]   = std::max(quantities[Q::transmissibility], motion.transmissibility);
        quantities[Q::relative_amplitude] = std::max(quantities[Q::relative_amplitude], motion.amplitude);
      }
    }
  } // namespace

  LeverRule hardest_rule(const Scene &scene, const bool has_length)
  {
    const Geometry &g = scene.geometry;
    const double R = g.cylinder_radius, e = g.interface_offset, l = g.pivot_distance, h = g.pivot_height;
    const double end = scene.drive.maximum();
    LeverRule hardest{ -std::numeric_limits<double>::infinity(), {} };
    const auto take = [&](const double violation, const std::string &text)
    {
      if (violation > hardest.violation)
        hardest = { violation, text };
    };
    take((e - R) / R, "the interface's offset e must be less than the cylinder's radius R");
    take((R - l) / l, "the pivot's distance l must be more than the cylinder's radius R");
    take((h - (R - e)) / R, "the pivot's height h must be less than R - e");
    if (hardest.violation < 0. && std::abs(h) <= R)
      take((end - pivot_contact(g)) / l, "the cylinder must not reach the pivot on the stroke");
    if (!(hardest.violation < 0.))
      return hardest;
    take(-sliding_speed(g, end, 1.), "the cylinder must slide along the lever on the whole stroke");
    take(-least_margin(scene), "the lever must not jam on the way back");
    constexpr double room = 2.; // as a scene with a lever of some length needs it
    if (has_length)
      take((kinematics(g, scene.drive.minimum()).s + room - scene.lever.length) / l,
           "Lever/Length must reach 2 mm beyond the contact");
    return hardest;
  }

  double nonlinearity_of(const std::vector<double> &x, const std::vector<double> &forces)
  {
    double products = 0., squares = 0., farthest = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      products += x[i] * forces[i];
      squares += x[i] * x[i];
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      farthest = std::max(farthest, std::abs(forces[i] - products / squares * x[i]));
    return farthest / largest_size_of(forces);
  }

  double ratio_of_ways(const double forward, const double backward)
  {
    return backward < 0. ? forward / -backward : std::numeric_limits<double>::infinity();
  }

  DesignQuantities lever_quantities(const Scene &scene)
  {
    DesignQuantities result;
    const auto at_rest = kinematics(scene.geometry, 0.);
    add_slopes(scene, result);
    add_forces(scene, result);
    result[Q::jamming_margin] = least_margin(scene);
    result[Q::reach]          = pivot_contact(scene.geometry);
    result[Q::inclination]    = at_rest.theta * 180. / M_PI;
    result[Q::lever_length]   = at_rest.s;
    return result;
  }

  void add_table_quantities(const Scene &scene, const std::vector<DesignQuantity> &asked, DesignQuantities &quantities)
  {
    const auto asks = [&](const Q quantity) { return std::find(asked.begin(), asked.end(), quantity) != asked.end(); };
    if (asks(Q::transmissibility) || asks(Q::relative_amplitude))
      add_harmonic(scene, quantities);
    if (asks(Q::residual_offset))
      quantities[Q::residual_offset] = offset_of(scene);
  }
} // namespace sprag
