// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"
#include "fe/body/effective_bending.h"
#include "model/step/model.h"

#include <memory>

namespace sprag
{
  struct Scene;

  /// Finds by finite elements the k that the scene's leaf spring would have, unloaded, with another thickness [mm] [N mm/rad].
  double leaf_stiffness(const Scene &scene, double thickness);

  /// Finds J of the scene's mesh with its densities, independent of Lever/Inertia [t mm^2].
  double inertia_as_built(const Scene &scene);

  /// Constants of the reduced lever equivalent to a prepared scene's mesh.
  struct MeshedConstants
  {
    double moment_of_inertia = 0.; ///< J as Lever/Inertia says [t mm^2]
    EffectiveBending bending{};    ///< of contacts wherever the drive leads
  };

  /// Finds these constants by the mesh of a prepared scene.
  MeshedConstants meshed_constants(const Scene &scene);

  /// A meshed lever without inertia, and its mesh.
  struct LeverOnMesh
  {
    std::unique_ptr<Mesh> mesh;
    std::unique_ptr<Model> model;
  };

  /// Makes the scene's lever with an automatic penalty as stiff as hard contact, to which laws of the reduced models are fitted.
  /// Throws InputError for a mesh that cannot serve.
  LeverOnMesh make_lever_in_hard_contact(const Scene &scene);
} // namespace sprag
