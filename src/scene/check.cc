#include "scene/check.h"

#include "base/append.h"
#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/check_penalty.h"
#include "scene/check_plate.h"
#include "scene/check_spring.h"
#include "scene/closed_form.h"
#include "scene/contact_reference.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace sprag
{
  namespace
  {
    using Violations = std::vector<Violation>;

    std::string drive_end(const Scene &scene)
    {
      return scene.drive.profile() == DriveProfile::table ? "Drive/Table" : "Drive/Stroke";
    }

    std::vector<std::string> shape()
    {
      return { "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance", "Geometry/Pivot height" };
    }

    /// With e < R < l and h < R - e, eq. 9 gives 0 < theta_0 < 90 degrees.
    Violations geometry(const Geometry &g)
    {
      Violations result;
      const std::string radius = "Cylinder radius R = " + rounded_text(g.cylinder_radius) + " mm";
      if (g.interface_offset >= g.cylinder_radius)
        result.push_back({ "Geometry/Interface offset", { "Geometry/Cylinder radius" }, "must be less than " + radius });
      if (g.pivot_distance <= g.cylinder_radius)
        result.push_back({ "Geometry/Pivot distance",
                           { "Geometry/Cylinder radius" },
                           "must be more than " + radius + ", or the cylinder reaches the pivot" });
      const double highest = g.cylinder_radius - g.interface_offset;
      if (highest > 0. && g.pivot_height >= highest)
        result.push_back({ "Geometry/Pivot height",
                           { "Geometry/Cylinder radius", "Geometry/Interface offset" },
                           "must be less than R - e = " + rounded_text(highest) + " mm, or theta_0 is not positive" });
      return result;
    }

    Violations drive(const Scene &scene)
    {
      const Drive &drive = scene.drive;
      Violations result;
      if (drive.minimum() < 0.)
        result.push_back({ "Drive/Table",
                           {},
                           "x must be >= 0 mm throughout, it falls to " + rounded_text(drive.minimum()) +
                               ": levers stand on one side of x = 0 alone. Of a record about rest, max(x, 0) moves those of one "
                               "side, max(-x, 0) those opposite, |x| both in turn (Q then acts against the sign of x); a record "
                               "that counts from elsewhere needs an offset" });
      // A pivot farther than R from the path is never touched.
      const Geometry &g = scene.geometry;
      if (std::abs(g.pivot_height) > g.cylinder_radius)
        return result;
      const double touched = pivot_contact(g);
      if (drive.maximum() >= touched)
        result.push_back({ drive_end(scene), joined(shape(), { "Drive/Start", "Drive/Profile" }),
                           "x must stay below " + rounded_text(touched) +
                               " mm, where the cylinder reaches the pivot: (l - x)^2 + h^2 = R^2" });
      return result;
    }

    /// Beyond this the contact point moves against the cylinder: the friction of eq. 4 would drive.
    Violations sliding(const Scene &scene)
    {
      const double x = scene.drive.maximum();
      if (sliding_speed(scene.geometry, x, 1.) > 0.)
        return {};
      return { { drive_end(scene), joined(shape(), { "Drive/Start", "Drive/Profile" }),
                 "the cylinder must slide along the lever as it moves: at x = " + rounded_text(x) +
                     " mm, s cos(th) <= e sin(th)" } };
    }

    Violations locked(const Scene &scene)
    {
      const auto found = locking(scene);
      if (!found)
        return {};
      const double mu_e = found->mu * scene.geometry.interface_offset;
      return { { drive_end(scene),
                 joined(shape(), { "Drive/Start", "Drive/Profile", "Drive/Speed", "Drive/Cycles", "Friction/Law",
                                   "Friction/Coefficient", "Friction/Table" }),
                 "must not lock: moving back at x = " + rounded_text(found->x) + " mm, s = " + rounded_text(found->s) +
                     " mm <= mu e = " + rounded_text(mu_e) + " mm with mu = " + rounded_text(found->mu) } };
    }

    Violations tip(const Scene &scene)
    {
      // Room for the width of the contact, which is below a millimetre each way.
      const double margin  = 2.;
      const double x       = scene.drive.minimum();
      const double contact = kinematics(scene.geometry, x).s;
      if (scene.lever.length >= contact + margin)
        return {};
      return { { "Lever/Length", joined(shape(), { "Drive/Start", "Drive/Profile", "Drive/Table" }),
                 "must be at least " + rounded_text(contact + margin) + " mm: at x = " + rounded_text(x) +
                     " mm the cylinder touches the lever at s = " + rounded_text(contact) + " mm" } };
    }

    Violations mesh(const MeshSettings &settings, const Lever &lever)
    {
      Violations result;
      if (settings.face_size >= lever.length)
        result.push_back({ "Mesh/Face size", { "Lever/Length" }, "must be less than the lever's length" });
      if (settings.file.empty())
        return result;
      const auto ending = std::filesystem::path(settings.file).extension();
      std::error_code ignored;
      if (ending != ".geo" && ending != ".msh")
        result.push_back({ "Mesh/File", {}, "must end in .geo or .msh" });
      else if (!std::filesystem::is_regular_file(settings.file, ignored) || !std::ifstream(settings.file))
        result.push_back({ "Mesh/File", {}, "cannot be read" });
      return result;
    }

    /// What a type of analysis takes of the scene. The model counts only where the cylinder follows the drive.
    struct Use
    {
      explicit Use(const Scene &scene)
          : in_time(scene.analysis.type == AnalysisType::transient)
          , held(holds_slide(scene.analysis.type))
          , transient(in_time || held)
          , follows_drive(runs_model(scene.analysis.type))
          , calibrated(scene.analysis.type == AnalysisType::calibration)
          , positions(follows_drive || calibrated || scene.analysis.type == AnalysisType::contact_law)
          , meshed(needs_mesh(scene))
          , lever(meshed || (transient && scene.analysis.model != ModelType::closed_form))
          , own_mesh(meshed && !scene.mesh.file.empty())
      {
      }

      const bool in_time;
      const bool held;      ///< the slide, at one x
      const bool transient; ///< with inertia
      const bool follows_drive;
      const bool calibrated;
      const bool positions; ///< whether the cylinder is put somewhere
      const bool meshed;
      const bool lever; ///< whether it has dimensions
      const bool own_mesh;
    };

    Violations mesh_and_material(const Scene &scene, const Use &use)
    {
      Violations result = mesh(scene.mesh, scene.lever);
      if (scene.lever.material == MaterialModel::neo_hookean && scene.analysis.plane == PlaneState::stress && !use.transient)
        result.push_back({ "Lever/Material", { "Analysis/Plane" }, "neo-Hookean needs Analysis/Plane = strain" });
      return result;
    }

    Violations linear_structure(const Scene &scene, const Use &use)
    {
      Violations result;
      const auto need = [&](const bool kept, const std::string &parameter, const std::string &value)
      {
        if (!kept)
          result.push_back({ parameter,
                             { "Analysis/Type", "Analysis/Model" },
                             "must be " + value + (use.held ? " where a slide is held" : " with Analysis/Type = transient") });
      };
      need(scene.lever.material == MaterialModel::linear, "Lever/Material", "linear");
      need(scene.analysis.solution == Solution::automatic, "Analysis/Solution", "automatic");
      need(scene.contact.enforcement == Enforcement::penalty, "Contact/Enforcement", "penalty");
      return result;
    }

    Violations model(const Scene &scene, const Use &use)
    {
      Violations result;
      const ModelType model = scene.analysis.model;
      if (use.follows_drive && !use.transient && model != ModelType::closed_form && model != ModelType::finite_element)
        result.push_back({ "Analysis/Model",
                           { "Analysis/Type" },
                           "needs Analysis/Type = transient: without inertia there are closed form and finite element" });
      if (use.follows_drive && is_meshed(model) && scene.lever.neutral_axis_offset)
        result.push_back({ "Lever/Neutral axis offset",
                           { "Analysis/Type", "Analysis/Model" },
                           "must be auto, the finite elements have their own; only rigid and beam take another" });
      if (use.transient && is_meshed(model))
        append(result, linear_structure(scene, use));
      return result;
    }

    Violations contact(const Scene &scene, const Use &use)
    {
      if (!use.follows_drive || use.held || scene.contact.type != ContactType::ideal)
        return {};
      Violations result;
      const ModelType model = scene.analysis.model;
      if (model != ModelType::rigid && model != ModelType::closed_form)
        result.push_back({ "Contact/Type", { "Analysis/Type", "Analysis/Model" }, "ideal needs Analysis/Model = rigid" });
      if (scene.support.type != SupportType::rigid)
        result.push_back({ "Contact/Type", { "Analysis/Type", "Support/Type" }, "ideal needs Support/Type = rigid" });
      if (use.transient && model == ModelType::rigid && scene.drive.profile() == DriveProfile::triangle &&
          scene.drive.reversal_duration() == 0.)
        result.push_back({ "Drive/Reversal duration",
                           { "Analysis/Type", "Analysis/Model", "Contact/Type", "Drive/Profile" },
                           "must be more than 0 s with Contact/Type = ideal, or P is infinite at a reversal" });
      return result;
    }

    Violations support(const Scene &scene, const Use &use)
    {
      if (scene.support.type == SupportType::rigid)
        return {};
      if (use.in_time && scene.analysis.model == ModelType::closed_form)
        return { { "Support/Type", { "Analysis/Model" }, "sprung needs an Analysis/Model other than closed form in time" } };
      if (use.follows_drive)
        return {};
      return { { "Support/Type", { "Analysis/Type" }, "must be rigid where the cylinder follows no drive" } };
    }

    Violations inertia(const Scene &scene)
    {
      const double added = added_inertia(scene);
      if (scene.lever.inertia == InertiaSource::as_built || scene.lever.moment_of_inertia > added)
        return {};
      return { { "Lever/Moment of inertia",
                 { "Analysis/Type", "Analysis/Model", "Lever/Tip mass", "Lever/Hub inertia", "Lever/Length", "Lever/Depth",
                   "Lever/Neutral axis offset", "Geometry/Interface offset", "Friction layer/Thickness" },
                 "must be more than that of tip mass, hub and leaf spring alone, Tip mass (L^2 + e_a^2) + Hub inertia + J of the "
                 "leaf = " +
                     rounded_text(added) + " t mm2" } };
    }

    Violations time(const Scene &scene)
    {
      if (scene.time.step < scene.drive.duration())
        return {};
      return { { "Time/Step",
                 { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Speed", "Drive/Cycles",
                   "Drive/Reversal duration", "Drive/Table" },
                 "must be less than the duration of the drive, " + rounded_text(scene.drive.duration()) + " s" } };
    }

    void within_drive(const Scene &scene, const std::string &parameter, const std::optional<double> &x, Violations &result)
    {
      if (x && (*x < scene.drive.minimum() || *x > scene.drive.maximum()))
        result.push_back({ parameter,
                           { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Table" },
                           "must lie on the drive, " + rounded_text(scene.drive.minimum()) + " ... " +
                               rounded_text(scene.drive.maximum()) + " mm" });
    }

    void turn(const Scene &scene, Violations &result)
    {
      const double position = scene.stability.position.value_or(scene.drive.maximum());
      if (scene.sprag_slip.continuation > 0 && scene.sprag_slip.turn.value_or(scene.drive.minimum()) == position)
        result.push_back({ "Sprag slip/Turn",
                           { "Analysis/Type", "Sprag slip/Continuation", "Stability/Position", "Drive/Profile", "Drive/Start",
                             "Drive/Stroke", "Drive/Table" },
                           "must be another x than Stability/Position = " + rounded_text(position) + " mm" });
    }

    Violations held(const Scene &scene)
    {
      Violations result;
      if (scene.analysis.model == ModelType::closed_form)
        result.push_back({ "Analysis/Model", { "Analysis/Type" }, "must be another than closed form, which has no vibration" });
      if (scene.contact.type == ContactType::ideal)
        result.push_back({ "Contact/Type", { "Analysis/Type" }, "must be compliant where a slide is held" });
      within_drive(scene, "Stability/Position", scene.stability.position, result);
      if (scene.analysis.type == AnalysisType::sprag_slip)
      {
        within_drive(scene, "Sprag slip/Turn", scene.sprag_slip.turn, result);
        turn(scene, result);
        if (scene.sprag_slip.initial >= scene.sprag_slip.final)
          result.push_back({ "Sprag slip/Final amplitude",
                             { "Analysis/Type", "Sprag slip/Initial amplitude" },
                             "must be more than Initial amplitude = " + rounded_text(scene.sprag_slip.initial) });
      }
      const unsigned int coarsest = scene.map.coarsest;
      if (scene.analysis.type == AnalysisType::map && (coarsest & (coarsest - 1)) != 0)
        result.push_back({ "Map/Coarsest", { "Analysis/Type" }, "must be a power of 2" });
      return result;
    }

    Violations cache(const CondensedSettings &condensed)
    {
      std::error_code ignored;
      if (!std::filesystem::exists(condensed.cache, ignored) || std::filesystem::is_directory(condensed.cache, ignored))
        return {};
      return { { "Condensed/Cache", { "Analysis/Type", "Analysis/Model" }, "must be a folder" } };
    }

    Violations settings(const Scene &scene, const Use &use)
    {
      Violations result;
      const AnalysisSettings &analysis = scene.analysis;
      if (analysis.dimension != 2)
        result.push_back({ "Analysis/Dimension", {}, "must be 2: this version solves 2D problems only" });
      if (analysis.minimum_step > analysis.step)
        result.push_back({ "Analysis/Minimum step",
                           { "Analysis/Step" },
                           "must not be more than Step = " + rounded_text(analysis.step) + " mm" });
      append(result, model(scene, use));
      append(result, contact(scene, use));
      append(result, support(scene, use));
      if (use.meshed)
        append(result, mesh_and_material(scene, use));
      if (use.meshed && !use.own_mesh)
        append(result, penalty_violations(scene));
      if (use.meshed)
        append(result, plate_violations(scene, use.own_mesh));
      if (use.transient && use.lever && !use.own_mesh)
        append(result, inertia(scene));
      if (use.in_time)
        append(result, time(scene));
      if (use.held)
        append(result, held(scene));
      if (use.transient && analysis.model == ModelType::condensed)
        append(result, cache(scene.condensed));
      if (use.positions)
        append(result, spring_violations(scene));
      append(result, pair_violations(scene));
      if (use.meshed)
        append(result, cylinder_violations(scene));
      if (use.calibrated)
        append(result, calibration_violations(scene));
      return result;
    }

    /// Whether the lever is rigid and always on the cylinder, so that it locks where the closed form does.
    bool can_lock(const Scene &scene, const Use &use)
    {
      const ModelType model = scene.analysis.model;
      return use.follows_drive && (model == ModelType::closed_form ||
                                   (use.transient && model == ModelType::rigid && scene.contact.type == ContactType::ideal));
    }

    /// Each can be computed only where those before it are kept.
    Violations positions(const Scene &scene, const Use &use)
    {
      Violations result = geometry(scene.geometry);
      if (result.empty() && use.positions)
        result = drive(scene);
      if (result.empty() && use.positions)
        append(result, sliding(scene));
      if (result.empty() && use.lever && !use.own_mesh)
        append(result, tip(scene));
      if (result.empty() && use.meshed && !use.own_mesh)
        append(result, sweep_violations(scene));
      if (result.empty() && can_lock(scene, use))
        append(result, locked(scene));
      return result;
    }

    /// Of both levers of a full pair what is not said of the first already.
    Violations positions_of_levers(const Scene &scene, const Use &use)
    {
      if (number_of_levers(scene) == 1)
        return positions(scene, use);
      Violations result = positions(scene_of_lever(scene, 0), use);
      for (const auto &violation : positions(scene_of_lever(scene, 1), use))
        if (std::none_of(result.begin(), result.end(), [&](const Violation &v) { return v.parameter == violation.parameter; }))
          result.push_back(violation);
      return result;
    }
  } // namespace

  std::vector<Violation> violations(const Scene &scene)
  {
    const Use use(scene);
    Violations result = settings(scene, use);
    append(result, positions_of_levers(scene, use));
    return result;
  }
} // namespace sprag
