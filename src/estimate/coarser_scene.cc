// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/coarser_scene.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sprag
{
  std::vector<ErrorEstimate> estimates_or_reason(const Scene &scene, const std::vector<std::string> &quantities,
                                                 const std::function<std::vector<ErrorEstimate>()> &estimate)
  {
    std::string reason;
    try
    {
      if (!scene.mesh.file.empty() && needs_mesh(scene) && scene.analysis.dimension == 3)
        throw NoEstimate{ "a mesh from a file is compared with none in three dimensions. Run a finer mesh beside it." };
      return estimate();
    }
    catch (const NoEstimate &none)
    {
      reason = none.reason;
    }
    catch (const AnalysisError &error)
    {
      reason = "in the comparison " + std::string(error.what()) + '.';
    }
    catch (const InputError &error)
    {
      reason = "the mesh to compare with cannot serve: " + std::string(error.what()) + '.';
    }
    return mapped(quantities,
                  [&](const std::string &quantity) {
                    return ErrorEstimate{ quantity, "", {}, "No estimate: " + reason };
                  });
  }

  Scene with_penalties(Scene scene, const ContactPenalties &penalties, const double share)
  {
    scene.contact.penalty            = share * penalties.normal;
    scene.contact.tangential_penalty = share * penalties.tangential;
    return scene;
  }

  Scene with_coarser_mesh(Scene scene)
  {
    scene.mesh.face_size *= coarser;
    scene.mesh.faces_in_contact /= coarser;
    scene.cylinder.face_size *= coarser;
    const double across        = scene.mesh.elements_across / coarser;
    scene.mesh.elements_across = std::max(1u, static_cast<unsigned int>(std::lround(across)));
    scene.mesh.growth_across   = std::pow(scene.mesh.growth_across, coarser);
    return scene;
  }

  Scene with_compared_mesh(Scene scene)
  {
    if (scene.mesh.file.empty())
      return with_coarser_mesh(std::move(scene));
    ++scene.mesh.halvings;
    scene.mesh.face_size /= coarser;
    scene.cylinder.face_size /= coarser;
    return scene;
  }

  double force_order(const Scene &scene)
  {
    return scene.mesh.degree == 1 ? 1.6 : 2.;
  }

  double pressure_order(const Scene &scene)
  {
    return scene.contact.enforcement == Enforcement::augmented_lagrangian ? 2. : 3.;
  }

  ErrorPart mesh_part(const Scene &scene, const double change, const double order)
  {
    // The error of the coarser of two is that of the finer and their difference.
    const bool is_file  = !scene.mesh.file.empty();
    const double share  = finer_share(coarser, order) + (is_file ? 1. : 0.);
    const auto &smaller = is_file ? "Give elements of Mesh/File sides" : "Try a Mesh/Face size";
    return { "mesh", share * change,
             scene.mesh.degree == 1 ? std::string("Try Mesh/Degree = 2") + (is_file ? "." : " or a smaller Mesh/Face size.")
                                    : std::string(smaller) + " 0.7 times as large." };
  }

  ErrorPart penalty_part(const Scene &scene, const double change)
  {
    const bool has_inertia = scene.analysis.type != AnalysisType::quasi_static;
    return { "penalty", finer_share(softer, 1.) * change,
             has_inertia ? "Try twice the Contact/Penalty."
                         : "Try twice the Contact/Penalty or Contact/Enforcement = augmented Lagrangian." };
  }
} // namespace sprag
