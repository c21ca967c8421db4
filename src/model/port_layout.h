#pragma once

namespace sprag
{
  /// Ports of a lever: first those of its friction face or axis in lever axes, then the compressions of its force sensors, which
  /// are only read, then the hub's rotation from the spring's rest; on a sprung support also the lever's momentum coordinates and
  /// the support's displacement.
  struct PortLayout
  {
    unsigned int surface = 0; ///< number of ports of the face
    bool sprung          = false;
    unsigned int sensors = 0;

    unsigned int sensor(const unsigned int number) const
    {
      return surface + number;
    }
    unsigned int rotation() const
    {
      return surface + sensors;
    }
    // With p = integral of rho u over the lever, u its displacement: the momentum along x is sin(theta) p'_eta - cos(theta)
    // p'_xi.
    unsigned int momentum_eta() const
    {
      return rotation() + 1;
    }
    unsigned int momentum_xi() const
    {
      return rotation() + 2;
    }
    unsigned int support() const
    {
      return rotation() + 3;
    }
    unsigned int size() const
    {
      return rotation() + (sprung ? 4 : 1);
    }
  };
} // namespace sprag
