// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_problem.h"

#include "analytic/harmonic_balance.h"
#include "analytic/isolation.h"
#include "base/errors.h"
#include "base/text.h"
#include "input/read.h"
#include "results/row_statistics.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/damper.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
        const auto state = closed_form(scene, place(scene, i), -scene.drive.peak_speed());
        least            = std::min(least, 1. - state.mu * scene.geometry.interface_offset / state.contact.s);
      }
      return least;
    }

    /// Adds the slopes at x = 0. With a preload, under which mu counts at each x, they are differences of the closed form, whose
    /// round-off would disturb the search without one.
    void add_ideal_slopes(const Scene &scene, DesignQuantities &result)
    {
      const double v   = scene.drive.peak_speed();
      const double mu  = closed_form(scene, 0., v).mu;
      const double h   = 1e-4 * scene.geometry.pivot_distance;
      const auto Q     = [&](const double x, const int direction) { return closed_form(scene, x, direction * v).Q; };
      const auto slope = [&](const int direction)
      {
        return scene.spring.rest_angle == 0. ? representative_slope(scene.geometry, scene.spring.stiffness, mu, direction)
                                             : (Q(h, direction) - Q(-h, direction)) / (2. * h);
      };
      add_slopes(scene, slope(1), slope(-1), result);
    }

    /// Integrates by Simpson's rule over an even number of intervals.
    double integrate(const std::vector<double> &values, const double length)
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
      result[Q::force_ratio]          = direction_ratio(forward.back(), backward.back());
      result[Q::nonlinearity]         = std::max(compute_nonlinearity(places, forward), compute_nonlinearity(places, backward));
      result[Q::largest_force]        = std::max(largest_magnitude(forward), largest_magnitude(backward));
      result[Q::largest_normal_force] = largest_P;
      result[Q::largest_pressure]     = layer_pressure(scene, largest_P);
      result[Q::loop_area]            = integrate(opening, scene.drive.maximum() - scene.drive.minimum());
    }

    /// Ends at infinity where the table cannot be followed.
    double compute_offset(const Scene &scene)
    {
      IsolationFindings found;
      if (std::abs(scene.isolation.initial_displacement) >= make_damper(scene).reach)
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

    /// Scale of a violation: the size of the target, or for a target of 0 the tolerance. Growth rates have 100/s.
    double demand_scale(const Demand &demand)
    {
      if (demand.term.quantity == DesignQuantity::growth_rate)
        return 100.;
      if (demand.target != 0.)
        return std::abs(demand.target);
      return demand.tolerance > 0. ? demand.tolerance : 1.;
    }

    double or_else(const double value, const double otherwise)
    {
      return std::isnan(value) ? otherwise : value;
    }

    constexpr double most_counted = 10.; ///< violation of what is far off or unknown

    double counted(const double violation)
    {
      return std::isnan(violation) ? most_counted : std::clamp(violation, -most_counted, most_counted);
    }

    void store_all(const std::vector<Parameter> &parameters, const std::vector<double> &values)
    {
      for (std::size_t i = 0; i < parameters.size(); ++i)
        parameters[i].store(number_text(values[i]));
    }

    double demand_margin(const Demand &demand, const double margin)
    {
      return demand.kind == DemandKind::equal ? std::min(margin, 0.25 * demand.tolerance / demand_scale(demand)) : margin;
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
    if (has_length)
      take((least_length(scene) - scene.lever.length) / l, "Lever/Length must reach beyond the contact");
    return hardest;
  }

  double compute_nonlinearity(const std::vector<double> &x, const std::vector<double> &forces)
  {
    const double products = std::inner_product(x.begin(), x.end(), forces.begin(), 0.);
    const double squares  = std::inner_product(x.begin(), x.end(), x.begin(), 0.);
    double farthest       = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      farthest = std::max(farthest, std::abs(forces[i] - products / squares * x[i]));
    return farthest / largest_magnitude(forces);
  }

  void add_slopes(const Scene &scene, const double forward, const double backward, DesignQuantities &quantities)
  {
    quantities[Q::forward_slope]   = forward;
    quantities[Q::backward_slope]  = backward;
    quantities[Q::damping_slope]   = 0.5 * (forward - backward);
    quantities[Q::restoring_slope] = 0.5 * (forward + backward);
    quantities[Q::slope_ratio]     = direction_ratio(forward, backward);
    quantities[Q::friction_ratio]  = scene.isolation.levers * quantities[Q::damping_slope] / scene.isolation.stiffness;
  }

  double largest_magnitude(const std::vector<double> &forces)
  {
    return largest(forces, [](const double force) { return force; });
  }

  double direction_ratio(const double forward, const double backward)
  {
    return backward < 0. ? forward / -backward : std::numeric_limits<double>::infinity();
  }

  DesignQuantities lever_quantities(const Scene &scene)
  {
    DesignQuantities result;
    const auto at_rest = kinematics(scene.geometry, 0.);
    add_ideal_slopes(scene, result);
    add_forces(scene, result);
    result[Q::jamming_margin] = least_margin(scene);
    result[Q::reach]          = pivot_contact(scene.geometry);
    result[Q::inclination]    = at_rest.theta * 180. / M_PI;
    result[Q::lever_length]   = at_rest.s;
    return result;
  }

  void add_table_quantities(const Scene &scene, const DesignSettings &design, DesignQuantities &quantities)
  {
    if (asks_for(design, Q::transmissibility) || asks_for(design, Q::relative_amplitude))
      add_harmonic(scene, quantities);
    if (asks_for(design, Q::residual_offset))
      quantities[Q::residual_offset] = compute_offset(scene);
  }

  double demand_violation(const Demand &demand, const double value)
  {
    const double scale = demand_scale(demand);
    if (demand.kind == DemandKind::at_most)
      return (value - demand.target) / scale;
    if (demand.kind == DemandKind::at_least)
      return (demand.target - value) / scale;
    return (std::abs(value - demand.target) - demand.tolerance) / scale;
  }

  double worse(const Demand &demand, const double first, const double second)
  {
    const bool is_second = std::isnan(first) || demand_violation(demand, second) > demand_violation(demand, first);
    return is_second ? second : first;
  }

  double term_value(const DesignTerm &term, const Proposal &proposal)
  {
    return term.quantity == DesignQuantity::parameter ? proposal.parameters.at(term.parameter)
                                                      : proposal.quantities[term.quantity];
  }

  std::vector<std::vector<double>> tolerance_corners(const DesignSettings &design)
  {
    if (design.toleranced.empty())
      return {};
    std::vector<std::vector<double>> corners = { {} };
    for (const auto &parameter : design.toleranced)
    {
      auto upper = corners;
      for (auto &corner : corners)
        corner.push_back(parameter.from);
      for (auto &corner : upper)
        corner.push_back(parameter.to);
      append(corners, upper);
    }
    return corners;
  }

  std::vector<std::string> overrides(const std::vector<FreeParameter> &parameters, const std::vector<double> &values)
  {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < values.size(); ++i)
      result.push_back(override_text(parameters[i].name, values[i]));
    return result;
  }

  std::vector<std::string> design_overrides(const Scene &design, const Proposal &lever)
  {
    return overrides(design.design.free_parameters, lever.parameters);
  }

  DesignProblem::DesignProblem(const Scene &scene)
      : base(scene)
      , input(std::make_unique<SceneSettings>())
  {
    input->scene        = base;
    const auto declared = scene_parameters(*input);
    for (const auto &parameter : base.design.free_parameters)
      free.push_back(*find_parameter(declared, parameter.name));
    for (const auto &parameter : base.design.toleranced)
      toleranced.push_back(*find_parameter(declared, parameter.name));
    corners = tolerance_corners(base.design);
    corrections.resize(1 + corners.size());
  }

  bool DesignProblem::is_expensive() const
  {
    return expensive_model ||
           asks_for(base.design, [](const Q quantity) { return is_table_quantity(quantity) && quantity != Q::friction_ratio; });
  }

  const Scene &DesignProblem::scene_at(const std::vector<double> &parameters) const
  {
    store_all(free, parameters);
    for (const auto &parameter : toleranced)
      parameter.store(parameter.default_value);
    return input->scene;
  }

  const Scene &DesignProblem::scene_at_corner(const std::vector<double> &parameters, const std::size_t corner) const
  {
    const Scene &scene = scene_at(parameters);
    if (corner > 0)
      store_all(toleranced, corners[corner - 1]);
    return scene;
  }

  DesignQuantities DesignProblem::ideal_quantities(const Scene &scene) const
  {
    DesignQuantities result = lever_quantities(scene);
    add_table_quantities(scene, base.design, result);
    return result;
  }

  DesignQuantities DesignProblem::corrected_quantities(const Scene &scene, const std::size_t corner) const
  {
    DesignQuantities result = ideal_quantities(scene);
    if (expensive_model)
      expensive_model(scene, result);
    const auto &[factors, differences] = corrections[corner];
    for (const auto &[quantity, name, unit, definition] : design_quantities())
      result[quantity] = or_else(factors[quantity], 1.) * result[quantity] + or_else(differences[quantity], 0.);
    return result;
  }

  Proposal DesignProblem::at(const std::vector<double> &place) const
  {
    Proposal result;
    const auto &bounds = base.design.free_parameters;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      result.parameters.push_back(bounds[i].from + std::clamp(place[i], 0., 1.) * (bounds[i].to - bounds[i].from));
    ++*count;
    const bool is_checked_by_models = std::any_of(base.design.check_models.begin(), base.design.check_models.end(),
                                                  [](const CheckModel check_model) { return check_model != CheckModel::table; });
    for (std::size_t corner = 0; corner <= corners.size(); ++corner)
    {
      const Scene &scene = scene_at_corner(result.parameters, corner);
      if (const auto rule = hardest_rule(scene, is_checked_by_models); corner == 0 || rule.violation > result.rule.violation)
        result.rule = rule;
      Proposal here{ result.parameters, {}, {}, {}, {} };
      if (result.rule.violation < 0.)
        here.quantities = corrected_quantities(scene, corner);
      if (corner == 0)
        result.quantities = here.quantities;
      for (std::size_t i = 0; i < base.design.demanded.size(); ++i)
      {
        const auto &demand = base.design.demanded[i];
        const double value = term_value(demand.term, here);
        if (corner == 0)
          result.worst.push_back(value);
        result.worst[i] = worse(demand, result.worst[i], value);
      }
    }
    for (std::size_t i = 0; i < result.worst.size(); ++i)
      result.violations.push_back(demand_violation(base.design.demanded[i], result.worst[i]));
    return result;
  }

  void DesignProblem::correct(const DesignQuantity quantity, const double by_closed_form, const double found,
                              const std::size_t corner)
  {
    const bool by_factor                      = by_closed_form > 0. && found > 0. && quantity != DesignQuantity::growth_rate;
    corrections[corner].factors[quantity]     = by_factor ? found / by_closed_form : 1.;
    corrections[corner].differences[quantity] = by_factor ? 0. : found - by_closed_form;
  }

  std::vector<double> DesignProblem::search_point(const std::vector<double> &parameters) const
  {
    std::vector<double> place;
    const auto &bounds = base.design.free_parameters;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      place.push_back((parameters[i] - bounds[i].from) / (bounds[i].to - bounds[i].from));
    return place;
  }

  BoxProblem DesignProblem::box(const std::optional<DesignAim> &aim, const std::optional<std::size_t> &omitted,
                                const std::optional<Demand> &limit) const
  {
    BoxProblem problem;
    std::vector<std::size_t> counting;
    for (std::size_t i = 0; i < base.design.demanded.size(); ++i)
      if (i != omitted && (expensive_model || base.design.demanded[i].term.quantity != DesignQuantity::growth_rate))
        counting.push_back(i);
    problem.dimension     = free.size();
    problem.n_constraints = 1 + counting.size() + (limit ? 1 : 0);
    problem.evaluate      = [this, aim, limit, omitted, counting](const std::vector<double> &place)
    {
      constexpr double strict_margin = 1e-6; // of the rules, which are strict
      const auto lever               = at(place);
      BoxProblem::Evaluation result{ most_counted, { counted(lever.rule.violation + strict_margin) } };
      const bool is_possible = lever.rule.violation < 0.;
      // A lever that breaks a rule violates every demand, by more the more it breaks it, so that the search leads back to
      // possible ones.
      const auto take = [&](const Demand &demand, const double violation)
      {
        const double missed = violation + demand_margin(demand, margin);
        result.constraints.push_back(is_possible ? counted(missed) : counted(1. + lever.rule.violation));
      };
      for (const auto i : counting)
        take(base.design.demanded[i], lever.violations[i]);
      if (limit)
        take(*limit, demand_violation(*limit, term_value(limit->term, lever)));
      if (aim && is_possible)
        result.objective = (aim->maximises ? -1. : 1.) * term_value(aim->term, lever);
      else if (omitted && is_possible)
        result.objective = counted(lever.violations[*omitted]);
      // A table that the lever does not hold fails the demand.
      const bool is_finite = std::all_of(base.design.aims.begin(), base.design.aims.end(),
                                         [&](const DesignAim &other) { return std::isfinite(term_value(other.term, lever)); });
      if (!is_finite)
      {
        result.objective           = most_counted;
        result.constraints.front() = std::max(result.constraints.front(), 1.);
      }
      return result;
    };
    return problem;
  }
} // namespace sprag
