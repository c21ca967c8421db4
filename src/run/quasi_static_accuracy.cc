// SPDX-License-Identifier: GPL-3.0-only
#include "run/quasi_static_accuracy.h"

#include "analysis/accuracy/sample_changes.h"
#include "base/errors.h"
#include "base/text.h"
#include "report/peak_report.h"
#include "results/row_statistics.h"
#include "run/coarser_scene.h"
#include "run/left_out_inertia.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    bool augments(const Scene &scene)
    {
      return scene.contact.enforcement == Enforcement::augmented_lagrangian;
    }

    constexpr double least_faces_of_reversal = 4.;

    /// Width of the contact where its pressure is largest, in faces.
    double faces_in_contact(const Scene &scene, const std::vector<Row> &samples)
    {
      const auto *const row = row_of_largest(samples, [](const Row &sample) { return sample[Column::largest_pressure]; });
      return row == nullptr ? 0. : (*row)[Column::contact_width] / scene.mesh.face_size;
    }

    /// Adds what the largest P or Q, which may lie in the passage through stick behind a reversal, are off beyond the parts in
    /// full sliding.
    void add_reversal(const Scene &scene, const Probes &probes, ErrorEstimate &estimate)
    {
      // A narrower contact does not converge with the order of forces yet.
      const bool is_narrow = faces_in_contact(scene, probes.run) < least_faces_of_reversal;
      const double order   = is_narrow ? 1. : order_of_forces(scene);
      const auto change    = [&](const std::vector<Row> &other)
      { return other.empty() ? 0. : change_of_peak(estimate.quantity, probes.passage, other); };
      auto part  = mesh_part(scene, change(probes.coarse_passage), order);
      part.value = part.value + penalty_part(scene, change(probes.soft_passage)).value - total_error(estimate);
      part.name  = "reversal";
      if (part.value > 0.)
        estimate.parts.push_back(part);
    }

    ErrorEstimate estimate(const Scene &scene, const Probes &probes, const std::string &quantity, const std::string &relative_to)
    {
      const auto change  = [&](const std::vector<Row> &other) { return relative_change(quantity, probes.run, other); };
      const double order = quantity == "largest_pressure" ? order_of_pressure(scene) : order_of_forces(scene);
      ErrorEstimate result{ quantity, relative_to, { mesh_part(scene, change(probes.coarse), order) }, {} };
      if (!probes.soft.empty())
        result.parts.push_back(penalty_part(scene, change(probes.soft)));
      if (!probes.soft.empty() && augments(scene))
        result.parts.back().remedy = "Try twice the Contact/Tangential penalty, or leave it at auto.";
      add_reversal(scene, probes, result);
      return result;
    }

    /// Of strokes that are one step: as of a parabola that is level at one of its ends.
    double error_of_lone_steps(const std::vector<Row> &rows)
    {
      const auto turns_at = [&](const std::size_t i)
      { return i == 0 || i + 1 == rows.size() || direction_of(rows[i][Column::v]) != direction_of(rows[i + 1][Column::v]); };
      double error = 0.;
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (turns_at(i - 1) && turns_at(i))
          error +=
              std::abs((rows[i].drive_force() - rows[i - 1].drive_force()) * (rows[i][Column::x] - rows[i - 1][Column::x])) / 6.;
      return error;
    }

    /// What the trapezoidal rule adds to the work, by Richardson from steps taken two at a time.
    double error_of_trapezoids(const std::vector<Row> &rows)
    {
      double error = error_of_lone_steps(rows);
      for (std::size_t i = 2; i < rows.size(); i += 2)
      {
        const std::vector<Row> both = { rows[i - 2], rows[i - 1], rows[i] };
        if (direction_of(both[0][Column::v]) == direction_of(both[2][Column::v]))
          error += (work_of_drive({ both[0], both[2] }) - work_of_drive(both)) / 3.;
      }
      return error;
    }

    constexpr double least_loop = 1e-3; ///< over the largest work on the way; less is left of it without friction

    ErrorEstimate loop_area(const Scene &scene, const Probes &probes, const std::vector<Row> &rows)
    {
      if (std::abs(rows.back()[Column::drive_work]) < least_loop * largest(rows, Column::drive_work))
        return { "loop_area", "", {}, "No estimate: what is left of the drive's work is a difference of much larger ones." };
      auto result = estimate(scene, probes, "loop_area", "it");
      result.parts.push_back({ "step", std::abs(error_of_trapezoids(rows) / rows.back()[Column::drive_work]),
                               "Try an Analysis/Step 0.7 times as large." });
      return result;
    }

    ErrorEstimate largest_stress(const Scene &scene, const Probes &probes)
    {
      if (!probes.stress)
        return { "largest_stress", "", {}, "No estimate: no stress was found in a state in which the whole contact slides." };
      if (probes.stress->is_at_edge)
        return { "largest_stress",
                 "",
                 {},
                 "No estimate: in the layer the stress rises to a cusp where the contact ends; a finer mesh finds more of it." };
      auto lever  = mesh_part(scene, probes.stress->lever, order_of_forces(scene));
      auto layer  = mesh_part(scene, probes.stress->layer, scene.mesh.degree);
      layer.value = std::max(layer.value, mesh_part(scene, probes.pressure_with_stress, order_of_pressure(scene)).value);
      lever.name  = "mesh_of_lever";
      layer.name  = "mesh_of_layer";
      ErrorEstimate result{ "largest_stress", "that of the lever or of the layer", { lever, layer }, {} };
      if (!probes.soft.empty())
        result.parts.push_back(penalty_part(scene, relative_change("largest_pressure", probes.run, probes.soft)));
      return result;
    }

    /// Adds the scatter of the rows, where it is more than what the mesh is told to change.
    ErrorEstimate with_scatter(ErrorEstimate estimate, const double scatter)
    {
      estimate.parts.front().value = std::max(estimate.parts.front().value, scatter);
      return estimate;
    }

    constexpr double follows_pressure = 0.05; ///< error of the largest pressure to which a mesh follows it, see peak_report.h

    ErrorEstimate unless_narrow(ErrorEstimate estimate, const double faces, const bool is_followed)
    {
      if (is_followed)
        return estimate;
      return { estimate.quantity,
               "",
               {},
               "No estimate: the contact is only " + rounded_text(faces) + " faces wide. Try a smaller Mesh/Face size." };
    }

    std::vector<ErrorEstimate> unknown_errors(const std::string &reason)
    {
      std::vector<ErrorEstimate> result;
      for (const char *const quantity : { "P", "Q", "loop_area", "largest_pressure", "contact_width", "largest_stress" })
        result.push_back({ quantity, "", {}, reason });
      return result;
    }
  } // namespace

  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, const std::vector<Row> &rows,
                                                   const std::function<Probes()> &probe)
  {
    if (!scene.mesh.file.empty())
      return unknown_errors(no_coarser_mesh);
    try
    {
      const Probes probes = probe();
      if (probes.run.size() < 2)
        return unknown_errors("No estimate: there are no two states in which the whole contact slides.");
      const double faces       = faces_in_contact(scene, probes.run);
      const bool forces_follow = faces > 1.;
      const bool all_follows   = expected_pressure_error(faces, scene.mesh.degree) <= follows_pressure;
      const double scatter     = smoothed_largest_pressure(rows, scene.mesh.face_size).scatter;
      const auto told          = [&](const std::string &quantity, const std::string &relative_to, const bool is_followed)
      {
        const double least = quantity == "largest_pressure" ? scatter : 0.;
        return unless_narrow(with_scatter(estimate(scene, probes, quantity, relative_to), least), faces, is_followed);
      };
      std::vector<ErrorEstimate> result = { told("P", "its peak", forces_follow),
                                            told("Q", "its peak", forces_follow),
                                            unless_narrow(loop_area(scene, probes, rows), faces, forces_follow),
                                            told("largest_pressure", "it", all_follows),
                                            told("contact_width", "the largest one", all_follows),
                                            unless_narrow(largest_stress(scene, probes), faces, all_follows) };
      const double inertia              = left_out_inertia(scene, rows);
      for (auto &estimate : result)
        if (estimate.quantity == "P" && !estimate.parts.empty())
          estimate.left_out = { { "inertia", inertia, "Analysis/Type = transient has it." } };
      return result;
    }
    catch (const AnalysisError &error)
    {
      return unknown_errors("No estimate: in the comparison there was " + std::string(error.what()) + ".");
    }
    catch (const InputError &error)
    {
      return unknown_errors("No estimate: the coarser mesh cannot serve: " + std::string(error.what()) + ".");
    }
  }
} // namespace sprag
