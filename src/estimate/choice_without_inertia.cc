// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "analysis/accuracy/slide_samples.h"
#include "analytic/error_estimate.h"
#include "base/phase_timer.h"
#include "base/ranges.h"
#include "base/text.h"
#include "estimate/coarser_scene.h"
#include "estimate/expected_cost.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/static_lever.h"
#include "program/resources.h"
#include "report/peak_report.h"
#include "report/report.h"
#include "report/summary_lines.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    // Shares of the target that the causes of an error may use up.
    constexpr double mesh_share = 0.35, row_share = 0.3, model_share = 0.7;
    constexpr double contact_mesh_share = 0.6; ///< of pressure and width, which rows hardly change

    constexpr double reversal_share = 0.6; ///< of P and Q behind a reversal
    constexpr double stick_share    = 0.4; ///< likewise

    constexpr double trial_faces            = 4.;   ///< across the contact where P is largest
    constexpr double least_faces            = 3.5;  ///< likewise, where pressure or width are wanted
    constexpr double narrowest              = 0.7;  ///< width of the contact over the estimated one, at least
    constexpr double faces_for_forces       = 2.;   ///< likewise, of forces alone, in trial runs and at least
    constexpr double most_trial_faces       = 300.; ///< along the way of the contact
    constexpr double extrapolated           = 0.4;  ///< face size over that of the trial run that tells of it, at least
    constexpr double finer_trial            = 0.8;  ///< face size of a trial run over that of the one before, at most
    constexpr unsigned int most_refinements = 2;
    constexpr double finest                 = 16.; ///< Mesh/Face size of the trial run over that of a run

    double convergence_order(const Scene &scene, const std::string &quantity)
    {
      return quantity == "largest_pressure" ? pressure_order(scene) : force_order(scene);
    }

    bool is_force_quantity(const std::string &quantity)
    {
      return quantity == "P" || quantity == "Q" || quantity == "loop_area";
    }

    /// Returns the faces in contact that P and Q need behind a reversal for a target; infinite without a target. Their error goes
    /// with the square of mu and of the face size. On models A and B and two other devices, with mu of 0.4 to 0.7 and 2 to 12
    /// faces, it is a twentieth to 0.7 times that taken here. Of a contact narrower than four faces the run tells too large an
    /// error for a tight target; its width is taken up to a fifth too large here.
    double faces_behind_reversal(const Scene &scene, const double target)
    {
      constexpr double tight = 2.5e-3;
      const double speed     = scene.drive.peak_speed();
      const double mu        = friction_coefficient(step_friction(scene.friction, speed), speed).coefficient;
      const double error     = 0.03 * mu * mu; // of one face in contact
      return std::max(target < tight ? 5. : 0., std::sqrt(error / (reversal_share * target)));
    }

    /// Returns the Analysis/Step that the steps through stick behind a reversal need for a target, infinite where the usual ones
    /// suffice. Their error is that of mu at another speed. On models A and B and two other devices that of the usual ones is a
    /// third to all of that taken here.
    double longest_step_through_stick(const Scene &scene, const double target)
    {
      const double speed   = scene.drive.peak_speed();
      const auto law       = step_friction(scene.friction, speed);
      const double mu      = friction_coefficient(law, speed).coefficient;
      const double error   = 4.5e-3 * mu * (mu - friction_coefficient(law, 0.).coefficient);
      const bool is_passed = !scene.drive.reversals().empty() && (is_requested(scene, "P") || is_requested(scene, "Q"));
      return is_passed && error > stick_share * target ? std::sqrt(stick_share * target / error)
                                                       : std::numeric_limits<double>::infinity();
    }

    double share_for(const std::string &quantity)
    {
      return is_force_quantity(quantity) ? mesh_share : contact_mesh_share;
    }

    constexpr double trial_rows = 30.; ///< steps of a run that cost as much as the trial run and the coarser one

    ExpectedCost trial_cost(Scene fine)
    {
      fine.analysis.step = (fine.drive.maximum() - fine.drive.minimum()) / trial_rows;
      return expected_cost(fine);
    }

    std::string announcement(const Scene &fine, const ExpectedCost &cost)
    {
      return "Probe:        faces of " + mm(fine.mesh.face_size) + ", about " + formatted("%.2g", cost.cpu_seconds) +
             " s of CPU time, " + formatted("%.2g", cost.bytes / 1e9) + " GB";
    }

    constexpr double largest_on_cylinder = 0.05; ///< Cylinder/Face size over its radius; a trial run has twice that

    std::vector<Row> trial_run(const Scene &scene, const std::vector<Row> &places)
    {
      Mesh mesh;
      make_mesh(scene, mesh);
      StaticLever<2> levers(mesh, scene);
      return solve_at_samples(levers, places, scene.drive.at(0.).x,
                              { scene.analysis.step, scene.analysis.minimum_step, scene.contact });
    }

    std::vector<Row> with_closed_form(const Scene &scene, std::vector<Row> rows)
    {
      for (Row &row : rows)
      {
        add_closed_form(scene, row);
        row[Column::P] = row[Column::P_closed_form];
        row[Column::Q] = row[Column::Q_closed_form];
      }
      return rows;
    }

    /// Returns by how much the largest P or Q behind the reversal of the closed form, which jumps there, is off that of finite
    /// elements, which turn over the contact's width.
    double jump_change(const std::string &quantity, const std::vector<Row> &rows, const Row &jump)
    {
      const Column column = quantity == "P" ? Column::P : Column::Q;
      const auto counts   = moves_with_friction(rows, drive_direction(jump[Column::v]), column);
      const double peak   = std::abs(peak_between_rows(rows, column, counts));
      return peak > 0. ? std::abs(std::abs(jump[column]) - peak) / largest(rows, column) : 0.;
    }

    Scene with_face_size(Scene scene, const double size)
    {
      scene.mesh.face_size = size;
      if (is_open(scene, "Cylinder/Face size"))
        scene.cylinder.face_size = std::min(size, largest_on_cylinder * scene.geometry.cylinder_radius);
      return scene;
    }

    /// Chooses for a run without inertia.
    class StaticChoice
    {
    public:
      explicit StaticChoice(const Scene &scene_, const Announce &announce)
          : scene(scene_)
          , enforcement_is_open(scene.contact.enforcement == Enforcement::penalty && is_open(scene, "Contact/Enforcement") &&
                                is_open(scene, "Contact/Penalty"))
          , grading_is_open(is_open(scene, "Mesh/Faces in contact"))
          , forces_only(std::all_of(scene.accuracy.quantities.begin(), scene.accuracy.quantities.end(), is_force_quantity))
      {
        const double since = PhaseTimer::cpu_seconds();
        if (grading_is_open && forces_only)
          scene.mesh.faces_in_contact = 0.;
        if (enforcement_is_open)
          scene.contact.enforcement = Enforcement::augmented_lagrangian;
        const auto [from, to] = swept_contact(scene);
        width                 = estimated_contact_width(scene, contact_reference(scene).P);
        const double target   = scene.accuracy.target;
        if (needs_no_trial(target))
          return;
        const bool is_coarse =
            forces_only && !scene.accuracy.is_model_open && faces_behind_reversal(scene, target) <= trial_faces;
        solve_trial_runs(std::max(width / (is_coarse ? faces_for_forces : trial_faces), (to - from) / most_trial_faces));
        // Beyond the coarser of these trial runs the contact may be narrower than a face.
        if (!is_coarse)
          longest_trusted = coarser * face_size;
        const auto is_too_far = [&]
        {
          return longest_face(target) < extrapolated * finer_trial * face_size &&
                 is_paid(with_budget_left(scene, since), meeting(target));
        };
        const bool may_refine = target > 0. && is_open(scene, "Mesh/Face size") && scene.mesh.file.empty();
        for (unsigned int i = 0; i < most_refinements && may_refine && is_too_far(); ++i)
        {
          const Scene fine = with_face_size(scene, longest_face(target) / extrapolated);
          require_memory(fine);
          const auto cost = trial_cost(fine);
          if (!announce(announcement(fine, cost), cost.cpu_seconds))
            break;
          solve_trial_runs(fine.mesh.face_size);
        }
      }

      Choice meeting(const double target) const
      {
        const double closed_form_error = *std::max_element(closed_form_errors.begin(), closed_form_errors.end());
        const bool closed_form         = scene.accuracy.is_model_open && closed_form_error <= model_share * target;
        Choice choice;
        if (scene.accuracy.is_model_open)
          choice.settings.push_back({ "Analysis/Model", closed_form ? "closed form" : "finite element",
                                      std::isfinite(closed_form_error)
                                          ? "the closed form is " + percent(closed_form_error) + " off a probe"
                                          : "the closed form does not tell what is wanted" });
        if (closed_form)
          choice.error = closed_form_error;
        else if (is_open(scene, "Mesh/Face size") && scene.mesh.file.empty())
          add_mesh(target, choice);
        if (enforcement_is_open && !closed_form)
          choice.settings.push_back({ "Contact/Enforcement", "augmented Lagrangian", "it leaves no error of a penalty" });
        if (forces_only && !closed_form && grading_is_open)
          choice.settings.push_back({ "Mesh/Faces in contact", "0", "no pressure is wanted" });
        if (is_open(scene, "Analysis/Step"))
        {
          const double spacing = largest_row_spacing(scene, row_share * target, is_requested(scene, "loop_area"));
          const double longest = closed_form ? spacing : longest_step_through_stick(scene, target);
          choice.settings.push_back({ "Analysis/Step", rounded_text(std::min(spacing, longest)),
                                      longest < spacing ? "steps through stick behind a reversal are short enough"
                                                        : "lines between rows follow the closed form" });
          choice.error += row_share * target;
        }
        return choice;
      }

    private:
      Scene scene;
      const bool enforcement_is_open, grading_is_open, forces_only;
      bool has_trial         = true;          ///< else the fewest faces suffice
      double width           = 0.;            ///< estimated one of the contact where P is largest [mm]
      double trial_width     = 0.;            ///< the same by the trial run [mm]
      double face_size       = 0.;            ///< of the finer trial run, or the longest one without [mm]
      double longest_trusted = 0.;            ///< face size for which the errors can be extrapolated [mm]
      std::vector<double> errors;             ///< of the finer trial run, of each quantity
      std::vector<double> closed_form_errors; ///< of the closed form; infinite of what it does not tell

      /// Returns whether the fewest faces suffice for a target, and sets these and their errors if so. The error of the pressure
      /// is that of the warning coarse_contact.
      bool needs_no_trial(const double target)
      {
        const double pressure_error = expected_pressure_error(narrowest * least_faces, scene.mesh.degree);
        const auto is_simple        = [](const std::string &quantity)
        { return is_force_quantity(quantity) || quantity == "largest_pressure"; };
        const auto &requested = scene.accuracy.quantities;
        const double faces    = forces_only ? faces_for_forces : least_faces;
        if (!(contact_mesh_share * target >= pressure_error) || scene.accuracy.is_model_open ||
            faces_behind_reversal(scene, target) > faces || !std::all_of(requested.begin(), requested.end(), is_simple))
          return false;
        has_trial = false;
        face_size = longest_trusted = width / faces;
        trial_width                 = width;
        for (const auto &quantity : requested)
          errors.push_back(is_force_quantity(quantity) ? 0. : pressure_error);
        closed_form_errors.assign(errors.size(), std::numeric_limits<double>::infinity());
        return true;
      }

      void solve_trial_runs(const double size)
      {
        face_size = longest_trusted = size;
        const Scene fine            = with_face_size(scene, size);
        const auto places           = drive_samples(scene.drive);
        const auto turn = scene.accuracy.is_model_open ? reversal_samples(scene.drive, 2. * width) : std::vector<Row>{};
        auto sampled    = with_closed_form(scene, joined(places, turn));
        std::sort(sampled.begin(), sampled.end(), [](const Row &a, const Row &b) { return a[Column::time] < b[Column::time]; });
        if (!turn.empty()) // the closed form alone jumps there
          sampled.erase(std::find_if(sampled.begin(), sampled.end(),
                                     [&](const Row &row) { return row[Column::time] == turn.front()[Column::time]; }));
        const auto solved = trial_run(fine, sampled);
        const auto rows   = rows_at(sample_times(places), solved);
        const auto jump   = with_closed_form(scene, turn);
        const auto coarse = trial_run(with_coarser_mesh(fine), places);
        const auto closed = with_closed_form(scene, rows);
        const auto ratio  = [&](const Row &row)
        { return row[Column::contact_width] / estimated_contact_width(scene, row[Column::P]); };
        trial_width = width * sum_over(rows, ratio) / static_cast<double>(rows.size());
        errors.clear();
        closed_form_errors.clear();
        for (const auto &quantity : scene.accuracy.quantities)
        {
          errors.push_back(relative_change(quantity, rows, coarse) * finer_share(coarser, convergence_order(scene, quantity)));
          closed_form_errors.push_back(is_force_quantity(quantity) ? relative_change(quantity, rows, closed)
                                                                   : std::numeric_limits<double>::infinity());
          if (!jump.empty() && (quantity == "P" || quantity == "Q"))
            closed_form_errors.back() = std::max(closed_form_errors.back(), jump_change(quantity, solved, jump.front()));
        }
      }

      /// Returns the faces in contact with which a run tells at most this error of the largest pressure.
      double faces_for_pressure(const double error) const
      {
        constexpr double many   = 10.;
        const double sufficient = many * std::cbrt(expected_pressure_error(many, scene.mesh.degree) / error);
        return std::clamp(sufficient, least_faces, least_converging_faces);
      }

      double longest_face(const double target) const
      {
        double result = longest_trusted;
        for (std::size_t i = 0; i < errors.size(); ++i)
        {
          const auto &quantity = scene.accuracy.quantities[i];
          const double share   = share_for(quantity) * target / std::max(errors[i], 1e-12);
          if (!is_force_quantity(quantity))
            result = std::min(result, trial_width / faces_for_pressure(share_for(quantity) * target));
          result = std::min(result, face_size * std::pow(share, 1. / convergence_order(scene, quantity)));
        }
        return std::max(result, face_size / finest);
      }

      void add_mesh(const double target, Choice &choice) const
      {
        const auto &requested        = scene.accuracy.quantities;
        const bool wants_peaks       = is_requested(scene, "P") || is_requested(scene, "Q");
        const bool has_reversal      = wants_peaks && !scene.drive.reversals().empty();
        const double trial_face_size = longest_face(target);
        const double longest         = std::max(face_size / finest, width / faces_behind_reversal(scene, target));
        const bool is_shorter        = has_reversal && longest < trial_face_size;
        const double size            = is_shorter ? longest : trial_face_size;
        bool is_short_enough         = true;
        if (has_reversal)
          choice.error = reversal_share * target * std::pow(size * faces_behind_reversal(scene, target) / width, 2);
        for (std::size_t i = 0; i < errors.size(); ++i)
        {
          const double error = errors[i] * std::pow(size / face_size, convergence_order(scene, requested[i]));
          choice.error       = std::max(choice.error, error);
          is_short_enough    = is_short_enough && error <= 1.01 * share_for(requested[i]) * target;
        }
        choice.settings.push_back(
            { "Mesh/Face size", rounded_text(size),
              is_shorter   ? "the largest P and Q behind a reversal need " + rounded_text(width / size) + " faces in contact"
              : !has_trial ? rounded_text(width / size) + " faces in contact suffice"
                           : "a probe with " + rounded_text(face_size) + " mm is " +
                                 percent(*std::max_element(errors.begin(), errors.end())) + " off" });
        if (scene.cylinder.type != CylinderType::rigid && is_open(scene, "Cylinder/Face size"))
          choice.settings.push_back(
              { "Cylinder/Face size", rounded_text(with_face_size(scene, size).cylinder.face_size), "as on the lever" });
        if (!is_short_enough)
          choice.limit = "Faces of " + mm(size) + " are the shortest that a probe tells of.";
      }
    };
  } // namespace

  ChooseToMeet choose_without_inertia(const Scene &scene, const Announce &announce)
  {
    return [all = StaticChoice(scene, announce)](const double target) { return all.meeting(target); };
  }
} // namespace sprag
