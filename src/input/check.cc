// SPDX-License-Identifier: GPL-3.0-only
#include "input/check.h"

#include "base/ranges.h"
#include "base/system/file_content.h"
#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/lever_inertia.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace sprag
{
  namespace
  {
    using Names = std::vector<std::string>;

    const Names shape = { "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
                          "Geometry/Pivot height" };

    std::string drive_end(const Scene &scene)
    {
      return scene.drive.profile() == DriveProfile::table ? "Drive/Table" : "Drive/Stroke";
    }

    /// With e < R < l and h < R - e, eq. 9 gives 0 < theta_0 < 90 degrees.
    void geometry(const Geometry &g, Rules &rules)
    {
      const std::string radius = "Cylinder radius R = " + mm(g.cylinder_radius);
      rules.need(g.interface_offset < g.cylinder_radius, "Geometry/Interface offset", { "Geometry/Cylinder radius" },
                 "must be less than " + radius);
      rules.need(g.pivot_distance > g.cylinder_radius, "Geometry/Pivot distance", { "Geometry/Cylinder radius" },
                 "must be more than " + radius + ", or the cylinder reaches the pivot");
      const double highest = g.cylinder_radius - g.interface_offset;
      rules.need(highest <= 0. || g.pivot_height < highest, "Geometry/Pivot height",
                 { "Geometry/Cylinder radius", "Geometry/Interface offset" },
                 "must be less than R - e = " + mm(highest) + ", or theta_0 is not positive");
    }

    void drive(const Scene &scene, Rules &rules)
    {
      const Drive &drive = scene.drive;
      rules.need(drive.minimum() >= 0., "Drive/Table", {},
                 "x must be >= 0 mm throughout, it falls to " + rounded_text(drive.minimum()) +
                     ": levers stand on one side of x = 0 alone. Of a record about rest, max(x, 0) moves those of one "
                     "side, max(-x, 0) those opposite, |x| both in turn (Q then acts against the sign of x); a record "
                     "that counts from elsewhere needs an offset");
      // A pivot farther than R from the path is never touched.
      const Geometry &g = scene.geometry;
      if (std::abs(g.pivot_height) > g.cylinder_radius)
        return;
      const double touched = pivot_contact(g);
      rules.need(drive.maximum() < touched, drive_end(scene), joined(shape, { "Drive/Start", "Drive/Profile" }),
                 "x must stay below " + mm(touched) + ", where the cylinder reaches the pivot: (l - x)^2 + h^2 = R^2");
    }

    /// Beyond this the contact point moves against the cylinder: the friction of eq. 4 would drive.
    void sliding(const Scene &scene, Rules &rules)
    {
      const double x = scene.drive.maximum();
      rules.need(sliding_speed(scene.geometry, x, 1.) > 0., drive_end(scene), joined(shape, { "Drive/Start", "Drive/Profile" }),
                 "the cylinder must slide along the lever as it moves: at x = " + mm(x) + ", s cos(th) <= e sin(th)");
    }

    void locked(const Scene &scene, Rules &rules)
    {
      if (const auto found = locking(scene))
        rules.need(false, drive_end(scene),
                   joined(shape, { "Drive/Start", "Drive/Profile", "Drive/Speed", "Drive/Cycles", "Friction/Law",
                                   "Friction/Coefficient", "Friction/Table" }),
                   "must not lock: moving back at x = " + mm(found->x) + ", s = " + mm(found->s) +
                       " <= mu e = " + mm(found->mu * scene.geometry.interface_offset) + " with mu = " + rounded_text(found->mu));
    }

    /// The contact of a lever that hardly presses yields by less than lengths are rounded.
    void pressing(const Scene &scene, Rules &rules)
    {
      constexpr double rounding = 1e-11; // of the radius, with which points of the face are compared
      const double x            = scene.drive.maximum();
      const double P            = closed_form(scene, x, scene.drive.peak_speed()).P;
      const double width        = estimated_contact_width(scene, std::max(0., P));
      const double penetration  = width * width / (8. * scene.geometry.cylinder_radius);
      const bool is_set = scene.spring.type == SpringType::torsional && scene.specified.count("Rotational spring/Stiffness") > 0;
      rules.need(!is_set || !(P > 0.) || penetration > rounding * scene.geometry.cylinder_radius, "Rotational spring/Stiffness",
                 joined(shape, { "Drive/Start", "Drive/Profile", "Drive/Table" }),
                 "must press harder: P = " + rounded_text(P) + " N at x = " + mm(x) + " compresses the contact by " +
                     mm(penetration) +
                     ", less than rounding leaves of lengths; Analysis/Model = closed form needs no compression");
    }

    void tip(const Scene &scene, Rules &rules)
    {
      const double x = scene.drive.minimum();
      rules.need(scene.lever.length >= least_length(scene), "Lever/Length",
                 joined(shape, { "Drive/Start", "Drive/Profile", "Drive/Table" }),
                 "must be at least " + mm(least_length(scene)) + ": at x = " + mm(x) +
                     " the cylinder touches the lever at s = " + mm(kinematics(scene.geometry, x).s));
    }

    void mesh(const MeshSettings &settings, const Lever &lever, Rules &rules)
    {
      rules.need(settings.face_size < lever.length, "Mesh/Face size", { "Lever/Length" }, "must be less than the lever's length");
      if (settings.file.empty())
        return;
      const auto ending   = std::filesystem::path(settings.file).extension();
      const bool is_known = ending == ".geo" || ending == ".msh";
      const auto mistake  = is_known ? reason_unreadable(settings.file, largest_mesh) : "must end in .geo or .msh";
      rules.need(mistake.empty(), "Mesh/File", {}, mistake);
    }

    /// Parts of the scene that a type of analysis uses. The model counts only where the cylinder follows the drive.
    struct Use
    {
      const Scene &scene;
      const AnalysisType type  = scene.analysis.type;
      const bool in_time       = type == AnalysisType::transient;
      const bool held          = holds_slide(type); ///< the slide, at one x
      const bool isolated      = isolates_by_model(scene);
      const bool corrected     = identifies_by_model(scene);
      const bool transient     = in_time || held || isolated || corrected; ///< of models with inertia
      const bool follows_drive = runs_model(type);
      const bool calibrated    = type == AnalysisType::calibration;
      const bool positions =
          follows_drive || corrected || calibrated || type == AnalysisType::contact_law; ///< puts the cylinder somewhere
      const bool meshed   = needs_mesh(scene);
      const bool lever    = meshed || (transient && scene.analysis.model != ModelType::closed_form); ///< has dimensions
      const bool own_mesh = meshed && !scene.mesh.file.empty();
    };

    void mesh_and_material(const Scene &scene, const Use &use, Rules &rules)
    {
      mesh(scene.mesh, scene.lever, rules);
      const bool has_stress = scene.analysis.plane == PlaneState::stress && scene.analysis.dimension == 2;
      rules.need(scene.lever.material != MaterialModel::neo_hookean || !has_stress || use.transient, "Lever/Material",
                 { "Analysis/Plane", "Analysis/Dimension" },
                 "neo-Hookean needs Analysis/Plane = strain or Analysis/Dimension = 3");
      const auto need_strain = [&](const PlaneState plane, const std::string &parameter)
      {
        rules.need(scene.lever.material != MaterialModel::neo_hookean || scene.analysis.dimension == 3 || use.transient ||
                       plane == PlaneState::strain,
                   parameter, { "Lever/Material", "Analysis/Dimension" }, "must be strain with Lever/Material = neo-Hookean");
      };
      need_strain(scene.layer.plane, "Friction layer/Plane");
      need_strain(scene.cylinder.plane, "Cylinder/Plane");
    }

    void linear_structure(const Scene &scene, const Use &use, Rules &rules)
    {
      const auto need = [&](const bool kept, const std::string &parameter, const std::string &value)
      {
        rules.need(kept, parameter, { "Analysis/Type", "Analysis/Model" },
                   "must be " + value + (use.held ? " where a slide is held" : " with Analysis/Type = transient"));
      };
      need(scene.lever.material == MaterialModel::linear, "Lever/Material", "linear");
      need(scene.analysis.solution == Solution::automatic, "Analysis/Solution", "automatic");
      need(scene.contact.enforcement == Enforcement::penalty, "Contact/Enforcement", "penalty");
    }

    void model(const Scene &scene, const Use &use, Rules &rules)
    {
      const ModelType model = scene.analysis.model;
      rules.need(!use.follows_drive || use.transient || model == ModelType::closed_form || model == ModelType::finite_element,
                 "Analysis/Model", { "Analysis/Type" },
                 "needs Analysis/Type = transient: without inertia there are closed form and finite element");
      rules.need(!use.follows_drive || !is_meshed(model) || !scene.lever.neutral_axis_offset, "Lever/Neutral axis offset",
                 { "Analysis/Type", "Analysis/Model" },
                 "must be auto, the finite elements have their own; only rigid and beam take another");
      if (use.transient && is_meshed(model))
        linear_structure(scene, use, rules);
    }

    void contact(const Scene &scene, const Use &use, Rules &rules)
    {
      if (!use.follows_drive || use.held || scene.contact.type != ContactType::ideal)
        return;
      const ModelType model = scene.analysis.model;
      rules.need(model == ModelType::rigid || model == ModelType::closed_form, "Contact/Type",
                 { "Analysis/Type", "Analysis/Model" }, "ideal needs Analysis/Model = rigid");
      rules.need(scene.support.type == SupportType::rigid, "Contact/Type", { "Analysis/Type", "Support/Type" },
                 "ideal needs Support/Type = rigid");
      rules.need(!use.transient || model != ModelType::rigid || scene.drive.profile() != DriveProfile::triangle ||
                     scene.drive.reversal_duration() != 0.,
                 "Drive/Reversal duration", { "Analysis/Type", "Analysis/Model", "Contact/Type", "Drive/Profile" },
                 "must be more than 0 s with Contact/Type = ideal, or P is infinite at a reversal");
    }

    void support(const Scene &scene, const Use &use, Rules &rules)
    {
      if (scene.support.type == SupportType::rigid)
        return;
      rules.need(!use.in_time || scene.analysis.model != ModelType::closed_form, "Support/Type", { "Analysis/Model" },
                 "sprung needs an Analysis/Model other than closed form in time");
      rules.need(use.follows_drive, "Support/Type", { "Analysis/Type" }, "must be rigid where the cylinder follows no drive");
    }

    void inertia(const Scene &scene, Rules &rules)
    {
      const double added = added_inertia(scene);
      rules.need(scene.lever.inertia == InertiaSource::as_built || scene.lever.moment_of_inertia > added,
                 "Lever/Moment of inertia",
                 { "Analysis/Type", "Analysis/Model", "Lever/Tip mass", "Lever/Hub inertia", "Lever/Length", "Lever/Depth",
                   "Lever/Neutral axis offset", "Geometry/Interface offset", "Friction layer/Thickness" },
                 "must be more than that of tip mass, hub and leaf spring alone, Tip mass (L^2 + e_a^2) + Hub inertia + J of the "
                 "leaf = " +
                     rounded_text(added) + " t mm2");
    }

    void time(const Scene &scene, Rules &rules)
    {
      rules.need(scene.time.step < scene.drive.duration(), "Time/Step",
                 { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Speed", "Drive/Cycles",
                   "Drive/Reversal duration", "Drive/Table" },
                 "must be less than the duration of the drive, " + rounded_text(scene.drive.duration()) + " s");
    }

    void within_drive(const Scene &scene, const std::string &parameter, const std::optional<double> &x, Rules &rules)
    {
      rules.need(!x || (*x >= scene.drive.minimum() && *x <= scene.drive.maximum()), parameter,
                 { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Table" },
                 "must lie on the drive, " + rounded_text(scene.drive.minimum()) + " ... " + mm(scene.drive.maximum()));
    }

    void sprag_slip(const Scene &scene, Rules &rules)
    {
      const auto &settings  = scene.sprag_slip;
      const double position = scene.stability.position.value_or(scene.drive.maximum());
      within_drive(scene, "Sprag slip/Turn", settings.turn, rules);
      rules.need(settings.continuation == 0 || settings.turn.value_or(scene.drive.minimum()) != position, "Sprag slip/Turn",
                 { "Analysis/Type", "Sprag slip/Continuation", "Stability/Position", "Drive/Profile", "Drive/Start",
                   "Drive/Stroke", "Drive/Table" },
                 "must be another x than Stability/Position = " + mm(position));
      rules.need(settings.initial < settings.final, "Sprag slip/Final amplitude",
                 { "Analysis/Type", "Sprag slip/Initial amplitude" },
                 "must be more than Initial amplitude = " + rounded_text(settings.initial));
    }

    void held(const Scene &scene, Rules &rules)
    {
      rules.need(scene.analysis.model != ModelType::closed_form, "Analysis/Model", { "Analysis/Type" },
                 "must be another than closed form, which has no vibration");
      rules.need(scene.contact.type != ContactType::ideal, "Contact/Type", { "Analysis/Type" },
                 "must be compliant where a slide is held");
      within_drive(scene, "Stability/Position", scene.stability.position, rules);
      if (scene.analysis.type == AnalysisType::sprag_slip)
        sprag_slip(scene, rules);
      const unsigned int coarsest = scene.map.coarsest;
      rules.need(scene.analysis.type != AnalysisType::map || (coarsest & (coarsest - 1)) == 0, "Map/Coarsest",
                 { "Analysis/Type" }, "must be a power of 2");
    }

    void cache(const CondensedSettings &condensed, Rules &rules)
    {
      std::error_code ignored;
      rules.need(!std::filesystem::exists(condensed.cache, ignored) || std::filesystem::is_directory(condensed.cache, ignored),
                 "Condensed/Cache", { "Analysis/Type", "Analysis/Model" }, "must be a folder");
    }

    void settings(const Scene &scene, const Use &use, Rules &rules)
    {
      const AnalysisSettings &analysis = scene.analysis;
      const bool steps_in_time         = use.in_time || use.isolated || use.type == AnalysisType::sprag_slip;
      rules.need(!steps_in_time || scene.contact.damping_law == DampingLaw::dashpot, "Contact/Damping law", { "Analysis/Type" },
                 "must be dashpot in time, where vibrations of all frequencies mix: a verdict prints the Contact/Damping of the "
                 "dashpot that equals the loss factor at its frequency");
      if (analysis.dimension == 3 || scene.accuracy.is_dimension_open)
        check_solid(scene, rules);
      rules.need(analysis.minimum_step <= analysis.step, "Analysis/Minimum step", { "Analysis/Step" },
                 "must not be more than Step = " + mm(analysis.step));
      model(scene, use, rules);
      contact(scene, use, rules);
      support(scene, use, rules);
      if (use.meshed)
        mesh_and_material(scene, use, rules);
      if (use.meshed && !use.own_mesh)
        check_penalty(scene, rules);
      if (use.meshed)
        check_plate(scene, use.own_mesh, rules);
      if (use.transient && use.lever && !use.own_mesh)
        inertia(scene, rules);
      if (use.in_time)
        time(scene, rules);
      if (use.held)
        held(scene, rules);
      if (use.transient && analysis.model == ModelType::condensed)
        cache(scene.condensed, rules);
      if (use.positions)
        check_spring(scene, rules);
      rules.need(analysis.type != AnalysisType::slope || scene.spring.rest_angle == 0., "Rotational spring/Rest angle",
                 { "Analysis/Type" }, "must be 0 in a slope, which is that from a spring at rest");
      check_pair(scene, rules);
      if (use.meshed)
        check_cylinder(scene, rules);
      if (use.calibrated)
        check_calibration(scene, rules);
    }

    /// Returns true if the lever is rigid and always on the cylinder, so that it locks where the closed form does.
    bool can_lock(const Scene &scene, const Use &use)
    {
      const ModelType model = scene.analysis.model;
      return use.follows_drive && (model == ModelType::closed_form ||
                                   (use.transient && model == ModelType::rigid && scene.contact.type == ContactType::ideal));
    }

    /// Each can be computed only where those before it are kept.
    std::vector<Violation> positions(const Scene &scene, const Use &use)
    {
      constexpr double thinnest_hub = 1e-4; // [mm] of which gmsh keeps the sides apart
      Rules rules;
      geometry(scene.geometry, rules);
      const double offset = scene.geometry.interface_offset;
      rules.need(!use.meshed || use.own_mesh || offset == 0. || offset >= thinnest_hub, "Geometry/Interface offset",
                 { "Mesh/File" }, "must be 0 or at least " + mm(thinnest_hub) + ", or the hub is too thin to be meshed");
      const std::pair<bool, void (*)(const Scene &, Rules &)> checks[] = {
        { use.positions, drive },
        { use.positions, sliding },
        { use.follows_drive && use.meshed, pressing },
        { use.lever && !use.own_mesh, tip },
        { use.meshed && !use.own_mesh, check_sweep },
        { can_lock(scene, use), locked },
        { use.type == AnalysisType::isolation, check_isolation },
        { use.type == AnalysisType::identification, check_identification },
      };
      for (const auto &[counts, check] : checks)
        if (rules.broken.empty() && counts)
          check(scene, rules);
      return rules.broken;
    }

    Scene with_device(Scene scene, const Device &device)
    {
      static_cast<Device &>(scene) = device;
      return scene;
    }
  } // namespace

  std::vector<Violation> violations(const Scene &scene)
  {
    // Each run of a study is checked by itself.
    if (scene.analysis.type == AnalysisType::study)
      return {};
    Rules rules;
    if (scene.analysis.type == AnalysisType::design)
    {
      check_design(scene, rules);
      return rules.broken;
    }
    const Use use{ scene };
    settings(scene, use, rules);
    auto lever_violations = positions(with_device(scene, lever_device(scene, 0)), use);
    // The second lever adds only violations of parameters that the first does not break.
    if (count_levers(scene) == 2)
      for (const auto &violation : positions(with_device(scene, lever_device(scene, 1)), use))
        if (std::none_of(lever_violations.begin(), lever_violations.end(),
                         [&](const Violation &v) { return v.parameter == violation.parameter; }))
          lever_violations.push_back(violation);
    return joined(rules.broken, lever_violations);
  }
} // namespace sprag
