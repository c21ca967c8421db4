// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "analysis/accuracy/slide_samples.h"
#include "analysis/stability/stability.h"
#include "base/errors.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/static_lever.h"
#include "report/summary_lines.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double default_target = 0.01;
    constexpr double coarse_faces   = 1.5; ///< across the contact where P is largest: both trial runs have the same
    constexpr double most_faces     = 40.; ///< along the way of the contact
    constexpr unsigned int across   = 6;   ///< elements of a trial run
    constexpr const char *pressure  = "largest_pressure";

    /// Error of the plane model in a quantity, relative to three dimensions.
    struct Off
    {
      std::string quantity;
      double error;
    };

    Scene with_trial_mesh(Scene scene)
    {
      const auto [from, to]       = swept_contact(scene);
      const double width          = estimated_contact_width(scene, contact_reference(scene).P);
      scene.mesh.face_size        = std::max({ scene.mesh.face_size, width / coarse_faces, (to - from) / most_faces });
      scene.mesh.faces_in_contact = 0.;
      scene.mesh.elements_across  = std::min(scene.mesh.elements_across, across);
      scene.analysis.dimension    = 3;
      return scene;
    }

    std::vector<Off> off_along_drive(const Scene &scene)
    {
      const Scene solid = with_trial_mesh(scene);
      const Scene plane = to_plane(solid);
      const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      const auto places  = drive_samples(scene.drive);
      const double start = scene.drive.at(0.).x;
      Mesh mesh;
      make_mesh(plane, mesh);
      const SolidBody body(solid, mesh);
      StaticLever<3> in_space(body, solid);
      StaticLever<2> in_plane(mesh, plane);
      const auto rows       = solve_at_samples(in_space, places, start, settings);
      const auto plane_rows = solve_at_samples(in_plane, places, start, settings);
      auto quantities       = scene.accuracy.quantities;
      if (!is_requested(scene, pressure))
        quantities.push_back(pressure); // is told, too
      std::vector<Off> result;
      for (const auto &quantity : quantities)
        result.push_back({ quantity, relative_change(quantity, rows, plane_rows) });
      return result;
    }

    SlideStability find_slide(Scene scene)
    {
      scene.analysis.type  = AnalysisType::stability; // of which a whole lever is taken
      scene.analysis.model = ModelType::condensed;
      DynamicsMaker maker(true, 1);
      return check_slide(held_scene(scene), maker);
    }

    std::vector<Off> off_in_slide(const Scene &scene)
    {
      const Scene solid   = with_trial_mesh(scene);
      const auto in_space = find_slide(solid);
      const auto in_plane = find_slide(to_plane(solid));
      std::vector<Off> result{ { "frequency", std::abs(in_plane.frequency() / in_space.frequency() - 1.) } };
      if (scene.analysis.type == AnalysisType::stability)
        result.push_back({ "growth_rate", std::abs(in_plane.growth_rate() / in_space.growth_rate() - 1.) });
      if (!std::isfinite(result.front().error))
        throw AnalysisError("Analysis/Dimension: the slide of a probe has no vibration to choose by. Give 2 or 3 instead");
      return result;
    }

  } // namespace

  ChosenSetting choose_dimension(const Scene &scene)
  {
    const double target = scene.accuracy.target > 0. ? scene.accuracy.target : default_target;
    const auto off      = scene.analysis.type == AnalysisType::quasi_static ? off_along_drive(scene) : off_in_slide(scene);
    bool suffices       = true;
    std::vector<std::string> texts;
    for (const auto &[quantity, error] : off)
    {
      // In time P rings with the slide's frequency.
      const bool asked_for = scene.analysis.type == AnalysisType::transient || is_requested(scene, quantity);
      suffices             = suffices && (!asked_for || error <= target);
      texts.push_back(percent(error) + " in " + quantity + (asked_for ? "" : " (not asked for)"));
    }
    return { "Analysis/Dimension", suffices ? "2" : "3",
             "the plane is off by " + boost::algorithm::join(texts, ", ") + " on the same coarse mesh, for " + percent(target) +
                 " asked for" };
  }
} // namespace sprag
