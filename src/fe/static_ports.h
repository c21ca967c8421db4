#pragma once

namespace sprag
{
  /// Ports of a meshed lever without inertia: displacements of the face nodes (2 i + d of node i along xi, eta), the hub's turn
  /// from the spring's rest and, on a sprung support, its displacement along x.
  struct StaticPorts
  {
    unsigned int surface = 0; ///< number of ports of the face
    bool sprung          = false;

    unsigned int rotation() const
    {
      return surface;
    }
    unsigned int support() const
    {
      return surface + 1;
    }
    unsigned int size() const
    {
      return surface + (sprung ? 2 : 1);
    }
  };

  /// Linear springs at the ports of hub and support.
  struct PortSprings
  {
    double rotation = 0.; ///< k [N mm/rad], > 0
    double support  = 0.; ///< k_f [N/mm], > 0; counts on a sprung support
    double arm      = 0.; ///< length that turns a rotation into a movement [mm], > 0
  };
} // namespace sprag
