// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/quasi_static_accuracy.h"

#include "analysis/accuracy/slide_samples.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "estimate/coarser_scene.h"
#include "fe/fields/stress_peaks.h"
#include "fe/mesh/lever_mesh.h"
#include "report/peak_report.h"
#include "results/entries.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/lever_inertia.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double difference_step = 1e-3; ///< to both sides, over the cylinder's radius

    /// Angular acceleration of the ideal lever [rad/s^2]; 0 where the drive turns near by, or begins or ends.
    double angular_acceleration(const Scene &scene, const double time)
    {
      const auto &drive = scene.drive;
      const auto at     = drive.at(time);
      const double span = difference_step * scene.geometry.cylinder_radius / std::abs(at.v);
      if (time < span || time + span > drive.duration())
        return 0.;
      const auto before = drive.at(time - span), after = drive.at(time + span);
      const bool turns = drive_direction(before.v) != drive_direction(at.v) || drive_direction(after.v) != drive_direction(at.v);
      if (turns || std::max({ before.x, at.x, after.x }) >= pivot_contact(scene.geometry))
        return 0.;
      const auto theta = [&](const DrivePoint &point) { return kinematics(scene.geometry, point.x).theta; };
      return (theta(before) - 2. * theta(at) + theta(after)) / (span * span);
    }

    constexpr double near_peak = 0.5;  ///< stress of the states that count, over the largest
    constexpr double near_edge = 0.85; ///< stress at the contact's edge over the largest, from which a finer mesh finds it there

    /// Stresses of a state in the run and in another model.
    struct StressPair
    {
      StressSample run, other;
    };

    /// Returns the root mean square changes over the states with at least half the largest stress, over that one: a single place
    /// may lie well by chance. None without states.
    std::optional<StressChanges> stress_changes(const std::vector<StressPair> &pairs)
    {
      const auto change = [&](double StressSample::*const part)
      {
        const double peak = largest(pairs, [&](const StressPair &pair) { return pair.run.*part; });
        std::vector<double> changes;
        for (const auto &[run, other] : pairs)
          if (run.*part >= near_peak * peak)
            changes.push_back(other.*part - run.*part);
        return peak > 0. ? root_mean_square(changes) / peak : 0.;
      };
      if (pairs.empty())
        return {};
      const auto peak = std::max_element(pairs.begin(), pairs.end(),
                                         [](const StressPair &a, const StressPair &b) { return a.run.layer < b.run.layer; });
      // A finer mesh finds still more of a cusp, as much as this one does beyond the other.
      const double more = std::max(0., peak->run.layer_edge - peak->other.layer_edge);
      return StressChanges{ change(&StressSample::lever), change(&StressSample::layer),
                            peak->run.layer_edge + more > near_edge * peak->run.layer };
    }

    constexpr unsigned int samples_per_stroke = 6, samples_in_space = 3;

    /// Sets the samples of a run, and returns them with the rows of its passage through stick between.
    std::vector<Row> choose_rows(const std::vector<Row> &rows, const unsigned int n_per_stroke, const std::vector<double> &times,
                                 TrialRows &run)
    {
      run = { slide_samples(rows, n_per_stroke, times), passage_rows(rows) };
      return rows_at(joined(sample_times(run.slides), sample_times(run.passage)), rows);
    }

    /// Divides the rows that another model has at all samples.
    TrialRows divided(const std::vector<Row> &rows, const TrialRows &run)
    {
      return { rows_at(sample_times(run.slides), rows), rows_at(sample_times(run.passage), rows) };
    }

    /// Gives a model its own penalties back.
    template <class Levers>
    struct OwnPenalties
    {
      Levers &levers;
      const ContactPenalties penalties = levers.penalties();

      ~OwnPenalties()
      {
        levers.use_penalties(penalties);
      }
    };

    bool augments(const Scene &scene)
    {
      return scene.contact.enforcement == Enforcement::augmented_lagrangian;
    }

    /// The samples in the run's own model with a softer penalty, where that says anything.
    template <class Levers>
    std::vector<Row> with_softer_penalty(const Scene &scene, Levers &levers, const std::vector<Row> &samples, const double start,
                                         const QuasiStaticSettings &settings)
    {
      if (augments(scene) && !scene.contact.tangential_penalty)
        return {};
      const OwnPenalties<Levers> own{ levers };
      const auto &penalties = own.penalties;
      levers.use_penalties({ augments(scene) ? penalties.normal : penalties.normal / softer, penalties.tangential / softer });
      return solve_at_samples(levers, samples, start, settings);
    }

    /// Solves a passage by half as many steps behind its reversal.
    std::vector<Row> solve_by_longer_steps(Model &model, const std::vector<Row> &passage, const double start,
                                           const QuasiStaticSettings &settings)
    {
      std::vector<Row> rows;
      for (std::size_t i = 0; i < passage.size(); ++i)
        if (i == 0 || i % 2 == 1)
          rows.push_back(passage[i]);
      return solve_at_samples(model, rows, start, settings);
    }

    constexpr double least_reversal_faces = 4.;
    constexpr double least_across         = 1e-6; ///< over the width [1 or N], below which round-off is left

    /// Width of the contact where its pressure is largest, in faces.
    double faces_in_contact(const Scene &scene, const std::vector<Row> &samples)
    {
      const auto *const row = find_largest_row(samples, [](const Row &sample) { return sample[Column::largest_pressure]; });
      return row == nullptr ? 0. : (*row)[Column::contact_width] / scene.mesh.face_size;
    }

    /// Returns the part of the mesh in an error, see mesh_part(). That of the largest pressure of a narrow contact is bounded.
    ErrorPart narrow_mesh_part(const Scene &scene, const TrialRuns &trial_runs, const std::string &quantity, const double change,
                               const double order)
    {
      auto part          = mesh_part(scene, change, order);
      const double faces = faces_in_contact(scene, trial_runs.run.slides);
      if (quantity == "largest_pressure" && faces < least_converging_faces)
        part.value = std::min(part.value, expected_pressure_error(faces, scene.mesh.degree));
      return part;
    }

    /// Adds what the largest P or Q, which may lie in the passage through stick behind a reversal, are off beyond the parts in
    /// full sliding.
    void add_reversal(const Scene &scene, const TrialRuns &trial_runs, ErrorEstimate &estimate)
    {
      // A narrower contact does not converge with the order of forces yet.
      const bool is_narrow = faces_in_contact(scene, trial_runs.run.slides) < least_reversal_faces;
      const double order   = is_narrow ? 1. : force_order(scene);
      const auto &passage  = trial_runs.run.passage;
      const auto column = estimate.quantity == "P" ? Column::P : estimate.quantity == "Q" ? Column::Q : Column::largest_pressure;
      const auto change = [&](const std::vector<Row> &other) { return peak_change(column, passage, other); };
      auto part         = narrow_mesh_part(scene, trial_runs, estimate.quantity, change(trial_runs.other.passage), order);
      part.value        = part.value + penalty_part(scene, change(trial_runs.soft.passage)).value - total_error(estimate);
      part.name         = "reversal";
      if (part.value > 0.)
        estimate.parts.push_back(part);
      if (estimate.quantity == "largest_pressure" || passage.empty())
        return;
      const double by_steps = peak_change(column, trial_runs.other.passage, trial_runs.longer_steps);
      estimate.parts.push_back(
          { "stick", by_steps, "Try an Analysis/Step of " + mm(0.8 * std::min(1., scene.analysis.step)) + '.' });
    }

    ErrorEstimate estimate(const Scene &scene, const TrialRuns &trial_runs, const std::string &quantity,
                           const std::string &relative_to)
    {
      const auto change  = [&](const std::vector<Row> &other) { return relative_change(quantity, trial_runs.run.slides, other); };
      const double order = quantity == "largest_pressure" ? pressure_order(scene) : force_order(scene);
      const auto mesh    = narrow_mesh_part(scene, trial_runs, quantity, change(trial_runs.other.slides), order);
      ErrorEstimate result{ quantity, relative_to, { mesh }, {} };
      if (!trial_runs.soft.slides.empty())
        result.parts.push_back(penalty_part(scene, change(trial_runs.soft.slides)));
      if (!trial_runs.soft.slides.empty() && augments(scene))
        result.parts.back().remedy = "Try twice the Contact/Tangential penalty, or leave it at auto.";
      if (quantity == "P" || quantity == "Q" || quantity == "largest_pressure")
        add_reversal(scene, trial_runs, result);
      return result;
    }

    /// Returns the estimate of a column that three dimensions add.
    ErrorEstimate estimate_across(const Scene &scene, const TrialRuns &trial_runs, const std::string &quantity)
    {
      const auto &columns = columns_across();
      const auto index    = static_cast<std::size_t>(find_by(columns, &ColumnInfo::name, quantity) - columns.data());
      const double peak   = largest(trial_runs.run.slides, [&](const Row &row) { return row.across.at(index); });
      if (!(peak > least_across * scene.lever.width))
        return { quantity, "", {}, "No estimate: the contact is the same on both sides." };
      const auto change = [&](const std::vector<Row> &other)
      {
        double result = 0.;
        for (std::size_t i = 0; i < other.size(); ++i)
          result = std::fmax(result, std::abs(other[i].across.at(index) - trial_runs.run.slides[i].across.at(index)));
        return result / peak;
      };
      ErrorEstimate result{ quantity, "its peak", { mesh_part(scene, change(trial_runs.other.slides), force_order(scene)) }, {} };
      if (!trial_runs.soft.slides.empty())
        result.parts.push_back(penalty_part(scene, change(trial_runs.soft.slides)));
      return result;
    }

    /// Error of the work on strokes of a single step, as of a parabola that is level at one of its ends.
    double lone_step_error(const std::vector<Row> &rows)
    {
      const auto turns_at = [&](const std::size_t i) {
        return i == 0 || i + 1 == rows.size() || drive_direction(rows[i][Column::v]) != drive_direction(rows[i + 1][Column::v]);
      };
      double error = 0.;
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (turns_at(i - 1) && turns_at(i))
          error +=
              std::abs((rows[i].drive_force() - rows[i - 1].drive_force()) * (rows[i][Column::x] - rows[i - 1][Column::x])) / 6.;
      return error;
    }

    /// Error of the work by the trapezoidal rule, by Richardson extrapolation from pairs of steps.
    double trapezoid_error(const std::vector<Row> &rows)
    {
      double error = lone_step_error(rows);
      for (std::size_t i = 2; i < rows.size(); i += 2)
      {
        const std::vector<Row> both = { rows[i - 2], rows[i - 1], rows[i] };
        if (drive_direction(both[0][Column::v]) == drive_direction(both[2][Column::v]))
          error += (compute_drive_work({ both[0], both[2] }) - compute_drive_work(both)) / 3.;
      }
      return error;
    }

    constexpr double least_loop = 1e-3; ///< over the largest work on the way; less is left of it without friction

    ErrorEstimate loop_area(const Scene &scene, const TrialRuns &trial_runs, const std::vector<Row> &rows)
    {
      if (std::abs(rows.back()[Column::drive_work]) < least_loop * largest(rows, Column::drive_work))
        return { "loop_area", "", {}, "No estimate: what is left of the drive's work is a difference of much larger ones." };
      auto result = estimate(scene, trial_runs, "loop_area", "it");
      result.parts.push_back({ "step", std::abs(trapezoid_error(rows) / rows.back()[Column::drive_work]),
                               "Try an Analysis/Step 0.7 times as large." });
      return result;
    }

    /// Error of a lever's largest stress [-]. It lies where the cells at the hub end, and their length is rounded: up to 0.15 %
    /// of five devices drawn at random (tests/benchmarks/effectivity.py), 0.05 % of most.
    constexpr double by_cells_at_hub = 1e-3;

    /// Returns those of the lever's and of the layer's largest stress.
    std::vector<ErrorEstimate> largest_stresses(const Scene &scene, const TrialRuns &trial_runs)
    {
      ErrorEstimate lever{ stress_names[0], "it", {}, {} }, layer{ stress_names[1], "it", {}, {} };
      const auto &changes = trial_runs.stress;
      if (!changes)
      {
        lever.unknown = layer.unknown = "No estimate: no stress was found in a state in which the whole contact slides.";
        return { lever, layer };
      }
      lever.parts = { mesh_part(scene, changes->lever, force_order(scene)),
                      { "hub", by_cells_at_hub, "It is of where the cells at the hub end, which no setting changes." } };
      layer.parts = { mesh_part(scene, changes->layer, scene.mesh.degree) };
      auto &mesh  = layer.parts.front().value;
      mesh        = std::max(mesh, mesh_part(scene, trial_runs.pressure_with_stress, pressure_order(scene)).value);
      if (!trial_runs.soft.slides.empty())
        for (auto *stress : { &lever, &layer })
          stress->parts.push_back(
              penalty_part(scene, relative_change("largest_pressure", trial_runs.run.slides, trial_runs.soft.slides)));
      if (changes->is_at_edge)
        layer = { stress_names[1],
                  "",
                  {},
                  "No estimate: the stress rises to a cusp where the contact ends; a finer mesh finds more of it." };
      return { lever, layer };
    }

    constexpr double follows_pressure = 0.05; ///< error of the largest pressure to which a mesh follows it, see peak_report.h

    ErrorEstimate unless_narrow(ErrorEstimate estimate, const double faces, const bool is_followed)
    {
      if (is_followed)
        return estimate;
      return { estimate.quantity,
               "",
               {},
               "No estimate: the contact is only " + rounded_text(faces) +
                   " faces wide. Try a smaller Mesh/Face size, or smaller faces in Mesh/File." };
    }
  } // namespace

  double left_out_inertia(const Scene &scene, const std::vector<Row> &rows)
  {
    const double J = moment_of_inertia(scene);
    double change  = 0.;
    for (const Row &row : rows)
      if (row[Column::v] != 0. && row[Column::P] > 0.)
      {
        const auto ideal = closed_form(scene, row[Column::x], row[Column::v]);
        const double moment =
            ideal.P * (ideal.contact.s + drive_direction(row[Column::v]) * ideal.mu * scene.geometry.interface_offset);
        change = std::max(change, std::abs(J * angular_acceleration(scene, row[Column::time]) / moment) * row[Column::P]);
      }
    return change / largest(rows, Column::P);
  }

  TrialRuns plane_trial_runs(const Scene &scene, StaticLever<2> &levers, const std::vector<Row> &rows,
                             const QuasiStaticSettings &settings, const std::vector<StressSample> &stresses)
  {
    TrialRuns result;
    const auto times   = mapped(stresses, &StressSample::time);
    const double start = rows.front()[Column::x];
    const auto chosen  = choose_rows(rows, samples_per_stroke, times, result.run);
    Mesh mesh;
    const Scene other = with_compared_mesh(with_penalties(scene, levers.penalties(), 1.));
    make_mesh(other, mesh);
    StaticLever<2> on_other(mesh, other);
    const BodyFields fields(on_other.body());
    std::vector<StressPair> pairs;
    const auto look = [&](const State &state, const Row &row, const Evaluation &)
    {
      const auto sample = std::find(times.begin(), times.end(), state.drive.time);
      if (sample == times.end())
        return;
      pairs.push_back({ stresses[sample - times.begin()], {} });
      for (const auto &displacement : on_other.body_displacements(state.coordinates, state.forces))
        look_at(fields, fields.at(displacement), row, pairs.back().other);
    };
    result.other        = divided(solve_at_samples(on_other, chosen, start, settings, look), result.run);
    result.longer_steps = solve_by_longer_steps(on_other, result.run.passage, start, settings);
    result.stress       = stress_changes(pairs);
    if (result.stress)
      result.pressure_with_stress =
          relative_change("largest_pressure", rows_at(times, result.run.slides), rows_at(times, result.other.slides));
    result.soft = divided(with_softer_penalty(scene, levers, chosen, start, settings), result.run);
    return result;
  }

  TrialRuns solid_trial_runs(const Scene &scene, SolidBody &body, StaticLever<3> &lever, const std::vector<Row> &rows,
                             const QuasiStaticSettings &settings)
  {
    TrialRuns result;
    const double start = rows.front()[Column::x];
    const auto chosen  = choose_rows(rows, samples_in_space, {}, result.run);
    result.soft        = divided(with_softer_penalty(scene, lever, chosen, start, settings), result.run);
    body.release_factors(); // before there are others
    Mesh mesh;
    const Scene other = with_compared_mesh(with_penalties(scene, lever.penalties(), 1.));
    make_mesh(other, mesh);
    const SolidBody other_body(other, mesh);
    StaticLever<3> on_other(other_body, other);
    result.other        = divided(solve_at_samples(on_other, chosen, start, settings), result.run);
    result.longer_steps = solve_by_longer_steps(on_other, result.run.passage, start, settings);
    return result;
  }

  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, const std::vector<Row> &rows,
                                                   const std::function<TrialRuns()> &run_trials)
  {
    const std::vector<std::string> across = { "centre_across", "twisting_moment" };
    const auto is_there = [&](const std::string &quantity) { return quantity != stress_names[1] || scene.layer.thickness > 0.; };
    const auto estimate_all = [&]
    {
      const TrialRuns trial_runs = run_trials();
      if (trial_runs.run.slides.size() < 2)
        throw NoEstimate{ "there are no two states in which the whole contact slides." };
      const double faces       = faces_in_contact(scene, trial_runs.run.slides);
      const bool forces_follow = faces > 1.;
      const bool all_follows   = expected_pressure_error(faces, scene.mesh.degree) <= follows_pressure;
      const double scatter     = smoothed_largest_pressure(rows, scene.mesh.face_size).scatter;
      const auto make_estimate = [&](const std::string &quantity, const std::string &relative_to, const bool is_followed)
      {
        auto found = estimate(scene, trial_runs, quantity, relative_to);
        if (quantity == "largest_pressure") // where its scatter is more than what the mesh is told to change
          found.parts.front().value = std::max(found.parts.front().value, scatter);
        return unless_narrow(std::move(found), faces, is_followed);
      };
      std::vector<ErrorEstimate> result = { make_estimate("P", "its peak", forces_follow),
                                            make_estimate("Q", "its peak", forces_follow),
                                            unless_narrow(loop_area(scene, trial_runs, rows), faces, forces_follow),
                                            make_estimate("largest_pressure", "it", all_follows),
                                            make_estimate("contact_width", "the largest one", all_follows) };
      for (auto &stress : largest_stresses(scene, trial_runs))
        if (is_there(stress.quantity))
          result.push_back(unless_narrow(std::move(stress), faces, all_follows));
      if (scene.analysis.dimension == 3)
        for (const auto &quantity : across)
          result.push_back(unless_narrow(estimate_across(scene, trial_runs, quantity), faces, forces_follow));
      const double inertia = left_out_inertia(scene, rows);
      for (auto &estimate : result)
        if (estimate.quantity == "P" && !estimate.parts.empty())
          estimate.left_out = { { "inertia", inertia, "Analysis/Type = transient has it." } };
      return result;
    };
    std::vector<std::string> quantities = filtered(accuracy_quantities(AnalysisType::quasi_static), is_there);
    if (scene.analysis.dimension == 3)
      append(quantities, across);
    return estimates_or_reason(scene, quantities, estimate_all);
  }

  void look_at(const BodyFields &fields, const std::vector<NodalField> &nodal, const Row &row, StressSample &sample)
  {
    constexpr double contact_middle = 0.4; // on both sides of the largest pressure, over the width of the contact
    const double middle             = row[Column::largest_pressure_xi];
    const double reach              = contact_middle * row[Column::contact_width];
    sample.time                     = row[Column::time];
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      const auto &node  = fields.nodes[i];
      const auto region = stress_region(node);
      if (region == 0u)
        sample.lever = std::max(sample.lever, von_mises(nodal[i]));
      else if (region == 1u)
      {
        const double stress = von_mises(nodal[i]);
        sample.layer        = std::max(sample.layer, stress);
        if (std::abs(node.position[0] - middle) > reach)
          sample.layer_edge = std::max(sample.layer_edge, stress);
      }
    }
  }
} // namespace sprag
