// SPDX-License-Identifier: GPL-3.0-only
#include "report/warnings.h"

#include "base/text.h"
#include "laws/friction_law.h"
#include "report/peak_report.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/lever_inertia.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace sprag
{
  namespace
  {
    // With the penetration a fifth of the approach the largest pressure of model A is 7 % low and its contact 12 % wide.
    constexpr double largest_approach_penetration = 0.2;

    // The lever is turned less by the penetration: with a tenth of the layer P of model A is 3 % low.
    constexpr double largest_layer_penetration = 0.1;

    // Deflection over distance from the pivot. At finite strain P of model A with levers of 1, 2 and 4 mm is lower by 2.1, 0.7
    // and 0.04 % where this ratio is 0.024, 0.014 and 0.0034.
    constexpr double largest_deflection = 0.02;

    // The stress of a layer compressed by a tenth is about a tenth off in linear theory.
    constexpr double largest_strain = 0.1;

    // Points enter the contact without friction and have it whole after the elastic slip: Q lacks half its share of the width.
    constexpr double largest_elastic_slip = 0.02;

    // Works are sums over the steps. Steps of 20 mm leave 0.16 % of model A's open and 2 % of error in both works, one of 65 mm
    // 2.4 and 15 %; forces do not depend on the length of the steps.
    constexpr double largest_open_energy = 0.002;

    // The largest pressure over the mean over the contact's width is 1.27 to 1.5 between Hertz's ellipse and a thin layer's
    // parabola, 15/8 on a thin layer that keeps its volume; on meshes of 10 to 3 elements it is 1.2 to 1.4. Where it is 1.8 to 3
    // pressures are 60 to 260 % too large.
    constexpr double largest_peak_over_mean                = 1.6;
    constexpr double largest_peak_over_mean_incompressible = 2.;
    constexpr double incompressible                        = 0.4;
    constexpr double admitted_peak_share                   = 0.02; ///< of the rows, and least P that counts, over the largest

    // A beam of 8 mm at x = 60 mm back with mu = 0.4 + 0.004 s/mm v: the share is just below 5 % at 500 mm/s, where a drive from
    // x = 65 mm has 1.1 times the P of the held slide, 24 % at 560 (0.68 times), 65 % at 600 (0.22 times). Other slides have 0.7
    // % at most.
    constexpr double largest_own_speed_share = 0.05;

    std::string per_cent(const double share)
    {
      return rounded_text(std::round(1000. * share) / 10.) + " %";
    }

    /// "at x = 65 mm backward".
    std::string place(const Row &row)
    {
      const double v = row[Column::v]; // 0 of a held slide
      return "at x = " + mm(row[Column::x]) + (v < 0. ? " backward" : v > 0. ? " forward" : "");
    }

    /// The rows have penetration of a mesh and compression of the layer both.
    void add_penetration(const Scene &scene, const std::vector<Row> &rows, const Row &peak, Warnings &warnings)
    {
      const double thickness = scene.layer.thickness;
      const Row *deepest     = find_largest_row(rows, [](const Row &row) { return row[Column::penetration]; });
      if (deepest == nullptr)
        return;
      const double penetration = (*deepest)[Column::penetration];
      if (thickness > 0. && penetration > largest_layer_penetration * thickness)
        warnings.push_back(make_warning("overlap_of_layer", { mm(penetration), place(*deepest), per_cent(penetration / thickness),
                                                              per_cent(largest_layer_penetration) }));
      const double compression = (thickness > 0. ? peak[Column::indentation] : 0.) + hertz_height(scene, peak[Column::P]);
      const double at_peak     = peak[Column::penetration];
      const double approach    = at_peak + compression;
      if (at_peak > largest_approach_penetration * approach)
        warnings.push_back(make_warning(
            "soft_penalty", { mm(at_peak), place(peak), per_cent(at_peak / approach), per_cent(largest_approach_penetration) }));
    }

    void add_tangential(const Row &peak, Warnings &warnings)
    {
      const double slip  = peak[Column::elastic_slip];
      const double width = peak[Column::contact_width];
      if (!(slip > largest_elastic_slip * width))
        return;
      warnings.push_back(
          make_warning("soft_tangential_penalty", { mm(slip), place(peak), per_cent(slip / width), per_cent(largest_elastic_slip),
                                                    rounded_text(std::ceil(100. * slip / width)) }));
    }

    double peak_over_mean(const Scene &scene, const Row &row)
    {
      return row[Column::largest_pressure] * row[Column::contact_width] * scene.lever.width / row[Column::P];
    }

    /// Returns whether cylinder or lever themselves press one part of the width more than another.
    bool loads_unevenly(const Scene &scene)
    {
      const auto &cylinder = scene.cylinder;
      return scene.analysis.dimension == 3 && (cylinder.tilt != 0. || cylinder.skew != 0. || cylinder.crown_radius > 0. ||
                                               cylinder.length > 0. || !scene.mesh.file.empty());
    }

    /// Warns of peaks of the pressure if the scene gives the penalty. With an automatic one the mesh is to blame, see
    /// coarse_contact_warnings(). The mean over the width says nothing of peaks where the load over it is uneven.
    void add_peaks(const Scene &scene, const std::vector<Row> &rows, const double largest_P, Warnings &warnings)
    {
      if (!scene.contact.penalty || is_chosen(scene, "Contact/Penalty") || loads_unevenly(scene))
        return;
      const double admitted =
          scene.layer.poisson_ratio > incompressible ? largest_peak_over_mean_incompressible : largest_peak_over_mean;
      const Row *worst   = nullptr;
      std::size_t peaked = 0, pressed = 0;
      for (const Row &row : rows)
        if (row[Column::P] > admitted_peak_share * largest_P)
        {
          ++pressed;
          if (!(peak_over_mean(scene, row) > admitted))
            continue;
          ++peaked;
          if (worst == nullptr || peak_over_mean(scene, row) > peak_over_mean(scene, *worst))
            worst = &row;
        }
      if (worst == nullptr || static_cast<double>(peaked) <= admitted_peak_share * static_cast<double>(pressed))
        return;
      warnings.push_back(make_warning("stiff_penalty", { rounded_text(*scene.contact.penalty),
                                                         per_cent(static_cast<double>(peaked) / static_cast<double>(pressed)),
                                                         place(*worst), rounded_text(peak_over_mean(scene, *worst)),
                                                         rounded_text(admitted), mm((*worst)[Column::contact_width] / 4.) }));
    }

    double finite(const double value)
    {
      return std::isfinite(value) ? value : 0.;
    }

    /// A deformable lever in contact is turned less than a rigid one: by compression and penetration, and by its deflection.
    double deflection_over_length(const Row &row)
    {
      if (!(row[Column::P] > 0.))
        return 0.;
      const double layer_angle = (finite(row[Column::indentation]) + finite(row[Column::penetration])) / row[Column::s];
      return std::abs(row[Column::theta] - row[Column::theta_closed_form]) - finite(layer_angle);
    }

    void add_deflection(const Scene &scene, const std::vector<Row> &rows, Warnings &warnings)
    {
      const Row *worst = find_largest_row(rows, deflection_over_length);
      if (worst == nullptr || scene.lever.material != MaterialModel::linear)
        return;
      const double ratio = deflection_over_length(*worst);
      if (ratio <= largest_deflection)
        return;
      const double s = (*worst)[Column::s];
      const double arm =
          std::isfinite(s) ? s : kinematics(scene.geometry, std::min((*worst)[Column::x], scene.drive.maximum())).s;
      warnings.push_back(
          make_warning("large_deflection", { mm(ratio * arm), place(*worst), per_cent(ratio), per_cent(largest_deflection) }));
    }

    void add_strain(const Scene &scene, const std::vector<Row> &rows, Warnings &warnings)
    {
      const double thickness = scene.layer.thickness;
      const Row *worst       = find_largest_row(rows, [](const Row &row) { return row[Column::indentation]; });
      if (worst == nullptr || thickness == 0. || scene.lever.material != MaterialModel::linear)
        return;
      const double strain = (*worst)[Column::indentation] / thickness;
      if (strain > largest_strain)
        warnings.push_back(make_warning(
            "large_strain", { mm((*worst)[Column::indentation]), place(*worst), per_cent(strain), per_cent(largest_strain) }));
    }

    void add_pressure(const Scene &scene, const std::vector<Row> &rows, const Row &peak, Warnings &warnings)
    {
      const auto strength = layer_strength(scene.layer);
      if (!strength)
        return;
      const Row *pressed      = find_largest_row(rows, [](const Row &row) { return row[Column::largest_pressure]; });
      const Row &location_row = pressed != nullptr ? *pressed : peak;
      const double pressure = pressed != nullptr ? (*pressed)[Column::largest_pressure] : layer_pressure(scene, peak[Column::P]);
      if (pressure <= *strength)
        return;
      warnings.push_back(
          make_warning("pressure_beyond_strength",
                       { rounded_text(pressure) + (pressed != nullptr ? " MPa" : " MPa (estimated)"),
                         rounded_text(location_row[Column::P]), place(location_row), rounded_text(*strength),
                         scene.layer.strength ? "Friction layer/Strength" : "0.04 E, at which the cells of cork buckle" }));
    }

    /// Quasi-static alone: in time Analysis/Maximum energy residual looks at the whole ledger. The springs of the penalties,
    /// which no column counts there, hold no more than force times penetration and slip. Steps chosen for a target have told
    /// errors.
    void add_energy(const Scene &scene, const std::vector<Row> &rows, Warnings &warnings)
    {
      if (is_chosen(scene, "Analysis/Step") || scene.analysis.type != AnalysisType::quasi_static ||
          scene.analysis.model != ModelType::finite_element)
        return;
      const Row &last     = rows.back();
      const double stored = last[Column::spring_energy] + last[Column::elastic_energy] - rows.front()[Column::spring_energy] -
                            rows.front()[Column::elastic_energy];
      double springs = 0.;
      for (unsigned int lever = 0; lever < count_levers(rows); ++lever)
        springs += last.lever_value(Column::P, lever) * finite(last[Column::penetration]) +
                   std::abs(last.lever_value(Column::F, lever)) * finite(last[Column::elastic_slip]);
      const double open     = std::abs(last[Column::drive_work] - last[Column::friction_work] - stored) - finite(springs);
      const auto drive_work = [](const Row &row) { return std::abs(row[Column::drive_work]); };
      const double work     = std::max(largest(rows, drive_work), std::abs(last[Column::friction_work]));
      if (!(open > largest_open_energy * work))
        return;
      const Row *longest = find_largest_row(rows, [](const Row &row) { return std::abs(row[Column::step]); });
      warnings.push_back(make_warning(
          "long_steps", { per_cent(open / work), mm(std::abs((*longest)[Column::step])), per_cent(largest_open_energy) }));
    }

    /// A sensor that only presses needs a preload where the plate would pull it.
    void add_sensors_in_tension(const std::vector<Row> &rows, Warnings &warnings)
    {
      constexpr double least = 0.01; ///< of the largest P
      const Row *lowest      = nullptr;
      const auto pull        = [](const Row &row)
      {
        const auto &forces = row.sensor_forces;
        return forces.empty() ? 0. : -*std::min_element(forces.begin(), forces.end());
      };
      for (const auto &row : rows)
        if (lowest == nullptr || pull(row) > pull(*lowest))
          lowest = &row;
      const auto pressed = [](const Row &row) { return std::fmax(row[Column::P], row.lever_value(Column::P, 1)); };
      if (lowest == nullptr || !(pull(*lowest) > least * largest(rows, pressed)))
        return;
      warnings.push_back(make_warning("sensor_in_tension", { rounded_text(pull(*lowest)), place(*lowest) }));
    }

    /// Beyond its last row a table is constant.
    void add_friction_speed(const Scene &scene, const std::vector<Row> &rows, Warnings &warnings)
    {
      const auto *table = std::get_if<TabulatedFriction>(&scene.friction.law);
      if (table == nullptr)
        return;
      const Column column = scene.friction.speed == FrictionSpeed::drive ? Column::v : Column::v_rel;
      const Row *fastest  = find_largest_row(rows, [=](const Row &row) { return std::abs(row[column]); });
      const double last   = table->fastest;
      // Speeds of a drive that is a table too have round-off.
      if (fastest == nullptr || std::abs((*fastest)[column]) <= (1. + 1e-6) * last)
        return;
      warnings.push_back(make_warning("speed_beyond_table",
                                      { rounded_text(std::abs((*fastest)[column])), place(*fastest), rounded_text(last) }));
    }

    /// The layer's shear k_t delays what friction does to the slip: where mu falls by |mu'| a speed, |mu'| P / k_t [s] feeds a
    /// vibration. Beyond L / v, L Friction/Memory length, the slip runs away at once.
    void add_falling_friction(const Scene &scene, const std::vector<Row> &slides, Warnings &warnings)
    {
      if (scene.friction.speed == FrictionSpeed::drive || !falls_with_speed(scene.friction))
        return;
      const double tangential = contact_reference(scene).tangential;
      const auto shear        = [&](const Row &slide) {
        return -friction_coefficient(scene.friction, std::abs(slide[Column::v_rel])).derivative * slide[Column::P] / tangential;
      };
      const auto memory = [&](const Row &slide) { return scene.friction.memory_length / std::abs(slide[Column::v_rel]); };
      const Row *worst  = find_largest_row(slides, [&](const Row &slide) { return shear(slide) / memory(slide); });
      if (worst != nullptr && shear(*worst) > memory(*worst))
        warnings.push_back(make_warning(
            "runaway_slip", { place(*worst), rounded_text(1e3 * shear(*worst)), rounded_text(1e3 * memory(*worst)) }));
    }

    /// Returns the warnings that follow from rows of one lever.
    Warnings lever_warnings(const Scene &scene, const std::vector<Row> &rows)
    {
      Warnings warnings;
      const Row *peak = find_largest_row(rows, [](const Row &row) { return row[Column::P]; });
      if (peak == nullptr)
        return warnings;
      if (is_meshed(scene.analysis.model))
      {
        add_penetration(scene, rows, *peak, warnings);
        append(warnings, coarse_contact_warnings(scene, rows));
        add_peaks(scene, rows, (*peak)[Column::P], warnings);
        add_tangential(*peak, warnings);
      }
      add_deflection(scene, rows, warnings);
      add_strain(scene, rows, warnings);
      add_pressure(scene, rows, *peak, warnings);
      add_friction_speed(scene, rows, warnings);
      if (scene.analysis.type == AnalysisType::transient && is_reduced(scene.analysis.model))
        add_falling_friction(scene, rows, warnings);
      return warnings;
    }

    /// Returns what `judge` warns of, and of a pair's second lever what it does not warn of for the first.
    template <class Judge>
    Warnings each_lever(const Scene &scene, const std::vector<Row> &rows, const Judge &judge)
    {
      Warnings warnings = judge(scene, rows);
      if (count_levers(rows) == 1)
        return warnings;
      Scene second                  = scene;
      static_cast<Device &>(second) = lever_device(scene, 1);
      for (auto &warning : judge(second, lever_rows(rows, 1)))
        if (find_by(warnings, &Warning::name, warning.name) == nullptr)
        {
          warning.found += " This is the second lever of the pair.";
          warnings.push_back(warning);
        }
      return warnings;
    }
  } // namespace

  std::optional<double> layer_strength(const FrictionLayer &layer)
  {
    constexpr double buckling_strain = 0.04;
    constexpr double largest_ratio   = 0.2; // cork has 0 to 0.1 across the rings, 0.25 to 0.5 along them
    if (layer.thickness == 0.)
      return {};
    if (layer.strength)
      return layer.strength;
    if (layer.poisson_ratio > largest_ratio)
      return {};
    return buckling_strain * layer.young_modulus;
  }

  Warnings row_warnings(const Scene &scene, const std::vector<Row> &rows)
  {
    auto warnings = each_lever(scene, rows, lever_warnings);
    if (rows.empty())
      return warnings;
    add_energy(scene, rows, warnings);
    add_sensors_in_tension(rows, warnings);
    return warnings;
  }

  Warnings slide_warnings(const Scene &scene, const Row &slide, const double own_speed_share)
  {
    const auto judge = [](const Scene &own, std::vector<Row> rows)
    {
      for (Row &row : rows)
      {
        const auto ideal               = kinematics(own.geometry, row[Column::x]);
        row[Column::s]                 = ideal.s;
        row[Column::theta_closed_form] = ideal.theta;
      }
      auto warnings = lever_warnings(own, rows);
      add_falling_friction(own, rows, warnings);
      return warnings;
    };
    auto warnings = each_lever(scene, { slide }, judge);
    if (own_speed_share > largest_own_speed_share)
      warnings.push_back(
          make_warning("path_dependent_slide", { place(slide), per_cent(own_speed_share), per_cent(largest_own_speed_share) }));
    return warnings;
  }

  Warnings beam_warnings(const Scene &scene, const double frequency, const double growth_rate)
  {
    return { make_warning("beyond_the_beam",
                          { rounded_text(frequency), rounded_text(growth_rate), rounded_text(highest_beam_frequency(scene)) }) };
  }
} // namespace sprag
