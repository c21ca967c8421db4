// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"
#include "report/report.h"
#include "run/vibration_report.h"
#include "scene/scene.h"
#include "verification/meshed_in_time.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

using namespace sprag;

namespace
{
  using Values = std::map<std::string, double>;

  /// The permitted difference of models in a quantity that they share by name.
  struct Tolerance
  {
    double relative;
    double absolute = 0.;
  };

  // The reduced models lump layer and shear into a contact law, the closed form has neither: up to 2 % of P, which Q and the
  // works take over, twice of it in energies. The centre of pressure lies within the contact, 2 mm wide.
  const std::map<std::string, Tolerance> same = {
    { "time", { 1e-9 } },
    { "x", { 1e-9 } },
    { "v", { 1e-9 } },
    { "theta", { 2e-3 } },
    { "theta_rate", { 0.03 } },
    { "s", { 0., 0.5 } },
    { "P", { 0.02 } },
    { "F", { 0.02 } },
    { "Q", { 0.02 } },
    { "Q_support", { 0.02 } },
    { "normal_resultant", { 0.02 } },
    { "friction_resultant", { 0.02 } },
    { "v_rel", { 0.01 } },
    { "speed", { 0.01 } },
    { "mu", { 0.01 } },
    { "centre_offset", { 0., 0.5 } },
    { "contact_width", { 0.08 } }, // four cells, whose points count or do not
    { "indentation", { 0.06 } },
    // 2 % as of P, and 0.8/3^3 of cells of a third of the contact, by which the pressure ripples as they pass.
    { "largest_pressure", { 0.05 } },
    { "largest_pressure_x", { 0., 0.5 } },   // where a cell of 0.5 mm passed
    { "largest_pressure_xi", { 0., 0.75 } }, // by that and half a cell
    { "friction_power", { 0.02 } },
    { "friction_work", { 0.03 } },
    { "drive_work", { 0.03 } },
    { "loop_area", { 0.03 } },
    { "spring_energy", { 0.04 } },
    { "elastic_energy", { 0.08 } },
    { "layer_energy", { 0.12 } },
    { "kinetic_energy", { 0.1 } },
    { "support_energy", { 0. } },
    { "support_displacement", { 0. } },
    { "P_quasi_static", { 0.02 } },
    { "Q_quasi_static", { 0.02 } },
    { "P_closed_form", { 1e-9 } },
    { "Q_closed_form", { 1e-9 } },
    { "theta_closed_form", { 1e-9 } },
    { "peak_P_forward", { 0.02 } },
    { "peak_Q_forward", { 0.02 } },
    { "peak_Q_support_forward", { 0.02 } },
    { "margin", { 0.02 } },
    // Numerical ones are what is left of an error: small everywhere.
    { "penetration", { 0., 5e-3 } },
    { "elastic_slip", { 0., 5e-3 } },
    { "cone_violation", { 0., 1e-6 } },
    { "contact_energy", { 0., 0.02 } },
    { "energy_residual", { 0., 0.1 } }, // works of 50 N mm; without inertia it is that of steps of 1 mm
    { "penetration_share", { 0., 0.15 } },
    { "deviation_P_forward", { 0., 0.02 } },
    { "deviation_Q_forward", { 0., 0.02 } },
    { "deviation_theta_forward", { 0., 0.02 } },
    { "representative_slope_forward", { 0.03 } },
    { "energy_residual_share", { 0., 1e-5 } },
    { "algorithmic_work", { 0., 0.02 } },
    { "damping_work", { 0., 0.05 } },
    { "creep", { 0. } },
    { "swing_P", { 0., 0.1 } },
  };

  // These are costs of a run, values that a stroke without a reversal lacks, and a determinant of which the sign alone counts.
  const std::set<std::string> not_compared = { "step",       "time_step",       "rejected_steps",  "active_points",
                                               "iterations", "augmentations",   "steps",           "augmentations_worst",
                                               "uniqueness", "peak_P_backward", "peak_Q_backward", "peak_Q_support_backward" };

  // One penalty for all, 12.5 E over cells of 0.5 mm. The automatic one in time is five times as stiff, which P does not feel but
  // single cells of a contact 1.3 mm wide do: their pressure is up to 1.8 times that of finer ones.
  Scene stroke(const ModelType model)
  {
    Scene scene           = with_lever(with_coulomb(in_time(model_a(), model), 0.73), 20., 9541.32, 1.45485);
    scene.contact.penalty = 12.5 * scene.layer.young_modulus / scene.mesh.face_size;
    scene.drive           = Drive(DriveProfile::triangle, 40., 46., 112., 0.5, 5e-3);
    return scene;
  }

  void add(const std::vector<Entry> &entries, Values &values)
  {
    for (const auto &entry : entries)
      if (const double *const value = std::get_if<double>(&entry.value); value != nullptr && std::isfinite(*value))
        values[entry.name] = *value;
  }

  Values row_values(const Row &row)
  {
    Values values;
    for (std::size_t i = 0; i < all_columns().size(); ++i)
      if (const double value = row[static_cast<Column>(i)]; std::isfinite(value))
        values[all_columns()[i].name] = value;
    return values;
  }

  Values stroke_values(std::vector<Row> rows, const std::vector<Entry> &summary)
  {
    Values values = row_values(rows.back());
    add(summary, values);
    return values;
  }

  Values transient_values(const ModelType model)
  {
    const Scene scene = stroke(model);
    auto rows         = run_any_in_time(scene).rows;
    for (auto &row : rows)
      add_closed_form(scene, row);
    Values values = stroke_values(rows, transient_summary(scene, rows));
    if (model == ModelType::rigid)
      values.erase("elastic_energy"); // without that of bending
    return values;
  }

  Values without_inertia()
  {
    Scene scene         = stroke(ModelType::finite_element);
    scene.analysis.type = AnalysisType::quasi_static;
    scene.drive         = Drive(DriveProfile::triangle, 40., 46., 112., 0.5);
    const auto rows     = run_scene(scene);
    return stroke_values(rows, make_summary(scene, rows));
  }

  Values by_closed_form()
  {
    Scene scene         = stroke(ModelType::closed_form);
    scene.analysis.type = AnalysisType::quasi_static;
    scene.drive         = Drive(DriveProfile::triangle, 40., 46., 112., 0.5);
    std::vector<Row> rows;
    run_closed_form(scene, [&](const Row &row) { rows.push_back(row); });
    // Contact and lever are ideal: there is nothing that these could be.
    Values values = stroke_values(rows, make_summary(scene, rows));
    for (const auto name : { "contact_width", "indentation", "elastic_energy" })
    {
      EXPECT_EQ(values.at(name), 0.) << name;
      values.erase(name);
    }
    return values;
  }

  Values held(const ModelType model)
  {
    const Scene scene = stroke(model);
    const auto made   = DynamicsMaker().make(scene);
    SlideStability found;
    found.slide = made.model().hold({ 0., 46., 112., 0. }, ContactFriction::sliding);
    Values values;
    add(slide_entries(found, true), values);
    return values;
  }

  void compare(const std::string &name, const Values &values, const Values &reference)
  {
    unsigned int compared = 0;
    for (const auto &[word, value] : values)
    {
      const auto other = reference.find(word);
      if (other == reference.end() || not_compared.count(word) > 0)
        continue;
      const auto tolerance = same.find(word);
      if (tolerance == same.end())
      {
        ADD_FAILURE() << word << " has no tolerance: " << name;
        continue;
      }
      const double most = tolerance->second.absolute + tolerance->second.relative * std::abs(other->second);
      EXPECT_NEAR(value, other->second, most) << word << " of " << name;
      ++compared;
    }
    EXPECT_GE(compared, 4u) << name;
  }
} // namespace

// One word is one quantity: every column and every entry of a summary that two models or analyses share says the same thing of
// the same slide, moving on at x = 46 mm, held there, in time and without inertia.
TEST(SharedNames, MeanOneQuantityAtEveryFidelity)
{
  const std::map<std::string, Values> models = { { "closed form", by_closed_form() },
                                                 { "rigid", transient_values(ModelType::rigid) },
                                                 { "beam", transient_values(ModelType::beam) },
                                                 { "condensed", transient_values(ModelType::condensed) },
                                                 { "finite elements", transient_values(ModelType::finite_element) },
                                                 { "rigid, held", held(ModelType::rigid) },
                                                 { "beam, held", held(ModelType::beam) },
                                                 { "condensed, held", held(ModelType::condensed) },
                                                 { "finite elements, held", held(ModelType::finite_element) } };
  const auto reference                       = without_inertia();
  for (const auto &[name, values] : models)
  {
    compare(name, values, reference);
    compare(name + " against finite elements in time", values, models.at("finite elements"));
    compare(name + " against the held condensed lever", values, models.at("condensed, held"));
  }
}
