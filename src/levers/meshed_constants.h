#pragma once

#include "fe/body/effective_bending.h"
#include "scene/scene.h"

namespace sprag
{
  /// k of the scene's leaf spring, unloaded, if it were of another thickness [mm], by finite elements [N mm/rad].
  double leaf_stiffness(const Scene &scene, double thickness);

  /// J of the scene's mesh with its densities, whatever Lever/Inertia says [t mm^2].
  double inertia_as_built(const Scene &scene);

  /// Constants of a reduced lever that stands for a prepared scene's mesh.
  struct MeshedConstants
  {
    double moment_of_inertia = 0.; ///< J as Lever/Inertia says [t mm^2]
    EffectiveBending bending{};    ///< for contacts wherever the drive leads
  };

  MeshedConstants meshed_constants(const Scene &scene);
} // namespace sprag
