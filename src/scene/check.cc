#include "scene/check.h"

#include "base/text.h"
#include "scene/closed_form.h"

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

    std::vector<std::string> with(std::vector<std::string> names, const std::vector<std::string> &more)
    {
      names.insert(names.end(), more.begin(), more.end());
      return names;
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
        result.push_back({ "Drive/Table", {}, "x must be >= 0 mm throughout, it falls to " + rounded_text(drive.minimum()) });
      // A pivot farther than R from the path is never touched.
      const Geometry &g = scene.geometry;
      if (std::abs(g.pivot_height) > g.cylinder_radius)
        return result;
      const double touched = pivot_contact(g);
      if (drive.maximum() >= touched)
        result.push_back({ drive_end(scene), with(shape(), { "Drive/Start", "Drive/Profile" }),
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
      return { { drive_end(scene), with(shape(), { "Drive/Start", "Drive/Profile" }),
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
                 with(shape(), { "Drive/Start", "Drive/Profile", "Drive/Speed", "Drive/Cycles", "Friction/Law",
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
      return { { "Lever/Length", with(shape(), { "Drive/Start", "Drive/Profile", "Drive/Table" }),
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
      else if (!std::ifstream(settings.file) || std::filesystem::is_directory(settings.file, ignored))
        result.push_back({ "Mesh/File", {}, "cannot be read" });
      return result;
    }

    Violations finite_elements(const Scene &scene)
    {
      Violations result = mesh(scene.mesh, scene.lever);
      if (scene.lever.material == MaterialModel::neo_hookean && scene.analysis.plane == PlaneState::stress)
        result.push_back({ "Lever/Material", { "Analysis/Plane" }, "neo-Hookean needs Analysis/Plane = strain" });
      return result;
    }

    void append(Violations &all, const Violations &more)
    {
      all.insert(all.end(), more.begin(), more.end());
    }
  } // namespace

  std::vector<Violation> violations(const Scene &scene)
  {
    const AnalysisSettings &analysis = scene.analysis;
    const bool moves                 = analysis.type == AnalysisType::quasi_static;
    const bool meshed                = moves && analysis.model == ModelType::finite_element;

    Violations result;
    if (analysis.dimension != 2)
      result.push_back({ "Analysis/Dimension", {}, "must be 2: this version solves 2D problems only" });
    if (analysis.minimum_step > analysis.step)
      result.push_back({ "Analysis/Minimum step",
                         { "Analysis/Step" },
                         "must not be more than Step = " + rounded_text(analysis.step) + " mm" });
    if (meshed)
      append(result, finite_elements(scene));

    // The rest can be computed only where what it starts from makes sense.
    Violations positions = geometry(scene.geometry);
    if (positions.empty() && moves)
      positions = drive(scene);
    if (positions.empty() && moves)
      append(positions, sliding(scene));
    if (positions.empty() && meshed && scene.mesh.file.empty())
      append(positions, tip(scene));
    if (positions.empty() && moves && !meshed)
      append(positions, locked(scene));
    append(result, positions);
    return result;
  }
} // namespace sprag
