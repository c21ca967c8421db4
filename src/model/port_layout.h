// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <array>

namespace sprag
{
  /// A value for each lever; the second counts in a mirrored pair alone.
  using PerLever = std::array<double, 2>;

  /// Ports of a lever: first those of its friction face or axis in lever axes, then the compressions of its force sensors, which
  /// are only read, then tilt and skew of a cylinder whose axis is free on its shaft, beyond those of the scene, then the hub's
  /// rotation from the spring's rest and on a sprung support, in time, the lever's momentum coordinates. A mirrored pair's second
  /// lever has the same ports after those, in its own axes; a free axis is against one lever alone. The displacement of a sprung
  /// support is the last.
  struct PortLayout
  {
    unsigned int surface = 0; ///< number of ports of a lever's face
    bool sprung          = false;
    unsigned int sensors = 0; ///< of a lever
    unsigned int levers  = 1; ///< 2: a mirrored pair
    bool has_inertia     = true;
    unsigned int slopes  = 0; ///< 2: those of the cylinder's axis may change

    /// The layout of one lever alone.
    PortLayout single_lever() const
    {
      PortLayout result = *this;
      result.levers     = 1;
      return result;
    }

    unsigned int ports_per_lever() const
    {
      return surface + sensors + slopes + (sprung && has_inertia ? 3 : 1);
    }
    unsigned int first(const unsigned int lever) const
    {
      return lever * ports_per_lever();
    }
    unsigned int sensor(const unsigned int number, const unsigned int lever = 0) const
    {
      return first(lever) + surface + number;
    }
    unsigned int slope(const unsigned int number) const
    {
      return surface + sensors + number;
    }
    unsigned int rotation(const unsigned int lever = 0) const
    {
      return first(lever) + surface + sensors + slopes;
    }
    // With p = integral of rho u over the lever, u its displacement: the momentum along x is sin(theta) p'_eta - cos(theta)
    // p'_xi.
    unsigned int momentum_eta(const unsigned int lever = 0) const
    {
      return rotation(lever) + 1;
    }
    unsigned int momentum_xi(const unsigned int lever = 0) const
    {
      return rotation(lever) + 2;
    }
    unsigned int support() const
    {
      return levers * ports_per_lever();
    }
    unsigned int size() const
    {
      return support() + (sprung ? 1 : 0);
    }

    /// The lever, 0 or 1, of a port that is not the support's.
    unsigned int port_lever(const unsigned int port) const
    {
      return port / ports_per_lever();
    }

    /// Returns true if a port is one of the face of either lever.
    bool is_surface(const unsigned int port) const
    {
      return port < support() && port % ports_per_lever() < surface;
    }
    bool is_rotation(const unsigned int port) const
    {
      return port < support() && port % ports_per_lever() == surface + sensors + slopes;
    }
    bool is_slope(const unsigned int port) const
    {
      return port >= slope(0) && port < slope(slopes);
    }
  };
} // namespace sprag
