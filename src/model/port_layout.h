#pragma once

namespace sprag
{
  /// Ports of a lever: first those of its friction face or axis in lever axes, then the hub's rotation from the spring's rest; on
  /// a sprung support also the lever's momentum coordinates and the support's displacement.
  struct PortLayout
  {
    unsigned int surface = 0; ///< number of ports of the face
    bool sprung          = false;

    unsigned int rotation() const
    {
      return surface;
    }
    // With p = integral of rho u over the lever, u its displacement: the momentum along x is sin(theta) p'_eta - cos(theta)
    // p'_xi.
    unsigned int momentum_eta() const
    {
      return surface + 1;
    }
    unsigned int momentum_xi() const
    {
      return surface + 2;
    }
    unsigned int support() const
    {
      return surface + 3;
    }
    unsigned int size() const
    {
      return surface + (sprung ? 4 : 1);
    }
  };
} // namespace sprag
