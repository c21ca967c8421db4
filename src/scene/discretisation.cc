// SPDX-License-Identifier: GPL-3.0-only
#include "scene/discretisation.h"

#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    /// Where pressures are told. In time cells of 0.5 mm tilt under the stiffer penalty, and P is 2 % off where the contact is
    /// 1.3 mm wide.
    constexpr double driven_face_size = 0.25; ///< [mm]

    /// Across the contact, by degree: the largest pressure is then within 1 %.
    constexpr double enough_faces[] = { 5., 4. };

    /// Augmentations are cheap where the lever is factorised once. Chords of degree 1 need soft contact to follow a circle.
    Enforcement automatic_enforcement(const Scene &scene)
    {
      const bool is_cheap = scene.analysis.type == AnalysisType::quasi_static && scene.lever.material == MaterialModel::linear &&
                            scene.analysis.solution == Solution::automatic;
      return is_cheap && scene.mesh.degree == 2 && !scene.contact.penalty ? Enforcement::augmented_lagrangian
                                                                          : Enforcement::penalty;
    }
  } // namespace

  void make_discretisation(SceneSettings &settings)
  {
    Scene &scene                = settings.scene;
    const bool is_static        = scene.analysis.type == AnalysisType::quasi_static;
    const bool is_driven        = is_static || scene.analysis.type == AnalysisType::transient;
    scene.mesh.face_size        = settings.face_size.value_or(is_driven ? driven_face_size : scene.mesh.face_size);
    const double enough         = enough_faces[scene.mesh.degree == 1 ? 0 : 1];
    scene.mesh.faces_in_contact = settings.faces_in_contact.value_or(is_static ? enough : 0.);
    scene.contact.enforcement   = settings.enforcement.value_or(automatic_enforcement(scene));
  }
} // namespace sprag
