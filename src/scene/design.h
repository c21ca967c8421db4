// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // Settings of a design: demands on the lever, its free parameters and its aims.

  /// Names a quantity of a demand or an aim, as in params/design.md; `parameter` stands for a free parameter.
  SPRAG_ENUMERATION(DesignQuantity, damping_slope, restoring_slope, forward_slope, backward_slope, friction_ratio, slope_ratio,
                    force_ratio, nonlinearity, largest_force, largest_normal_force, largest_pressure, loop_area, jamming_margin,
                    reach, inclination, lever_length, transmissibility, relative_amplitude, residual_offset, growth_rate,
                    parameter)

  /// Names a free parameter, or one with a tolerance, as in --set, and its bounds.
  struct FreeParameter
  {
    std::string name;
    double from = 0.;
    double to   = 0.;
    std::string unit;
  };

  /// Refers to a quantity or to one of the free parameters.
  struct DesignTerm
  {
    DesignQuantity quantity = DesignQuantity::damping_slope;
    std::size_t parameter   = 0; ///< index of the free parameter, for DesignQuantity::parameter
  };

  /// Compares a value with the target of a demand; `equal` within a tolerance.
  SPRAG_ENUMERATION(DemandKind, at_most, at_least, equal)

  /// Constrains a quantity of the designed lever.
  struct Demand
  {
    DesignTerm term;
    DemandKind kind  = DemandKind::at_most;
    double target    = 0.;
    double tolerance = 0.; ///< of `equal`, > 0
    std::string text;      ///< as in the file, single-spaced
  };

  /// Names a quantity to be minimised or maximised.
  struct DesignAim
  {
    DesignTerm term;
    bool maximises = false;
    std::string text;
  };

  /// Selects the model that checks a proposed lever, in order of cost: the isolated table in time on levers of the closed form, a
  /// beam or a condensed lever.
  SPRAG_ENUMERATION(CheckModel, table, beam, condensed)

  /// Holds the section Design: free parameters, demands, aims and the effort of the search.
  struct DesignSettings
  {
    std::string free    = "Rotational spring/Stiffness = 1e4 ... 2e5";
    std::string demands = "damping slope = 0.1 +- 0.001";
    std::string aim     = "minimise largest force";
    std::string second_aim; ///< empty: none
    std::string tolerances; ///< empty: none
    std::string checks        = "none";
    unsigned int front_points = 11;   ///< of the front of two aims
    unsigned int positions    = 5;    ///< x at which beam and condensed check the slide, each both ways
    bool checks_in_time       = true; ///< whether the last of beam and condensed follows the drive in time
    unsigned int rounds       = 6;    ///< of proposals to a check model
    unsigned int evaluations  = 4000; ///< of the closed form in the global search
    unsigned int seed         = 1;

    // read_analysis_texts() fills these from the texts.
    std::vector<FreeParameter> free_parameters;
    std::vector<FreeParameter> toleranced; ///< parameters within whose bounds all demands hold
    std::vector<Demand> demanded;
    std::vector<DesignAim> aims;
    std::vector<CheckModel> check_models;
  };

  // The quantities that a design can demand or aim at. Forces and slopes are of one lever.

  /// Describes a quantity that designs can use.
  struct DesignQuantityInfo
  {
    DesignQuantity quantity;
    std::string name;
    std::string unit; ///< "1" where dimensionless
    std::string definition;
  };

  /// Lists all quantities but `parameter` in the order of the enumeration, with units and definitions of params/design.md.
  const std::vector<DesignQuantityInfo> &design_quantities();

  const DesignQuantityInfo &design_quantity_info(DesignQuantity quantity);

  std::optional<DesignQuantity> find_design_quantity(const std::string &name);

  /// Returns whether a design demands or aims at a quantity that `accepts` returns true for.
  template <class Condition>
  bool asks_for(const DesignSettings &design, const Condition &accepts)
  {
    const auto is_it = [&](const auto &use) { return accepts(use.term.quantity); };
    return std::any_of(design.demanded.begin(), design.demanded.end(), is_it) ||
           std::any_of(design.aims.begin(), design.aims.end(), is_it);
  }

  /// Returns whether a design demands or aims at this quantity.
  bool asks_for(const DesignSettings &design, DesignQuantity quantity);

  /// Returns whether a quantity describes the isolated table rather than a lever.
  bool is_table_quantity(DesignQuantity quantity);
} // namespace sprag
