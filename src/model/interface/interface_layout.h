// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <array>

namespace sprag
{
  /// A value for each lever; the second counts in a mirrored pair alone.
  using PerLever = std::array<double, 2>;

  /// Numbers of the dofs of a lever's interface. First come those of its friction face or axis in lever axes, then the
  /// compressions of its force sensors, which are only read. Tilt and skew of a cylinder whose axis is free on its shaft follow,
  /// beyond those of the scene. Then comes the hub's rotation from the spring's rest and on a sprung support, in time, the
  /// lever's momentum coordinates. A mirrored pair's second lever has the same dofs after those, in its own axes; a free axis is
  /// against one lever alone. The displacement of a sprung support is the last.
  struct InterfaceLayout
  {
    unsigned int surface = 0; ///< number of dofs of a lever's face
    bool sprung          = false;
    unsigned int sensors = 0; ///< of a lever
    unsigned int levers  = 1; ///< 2: a mirrored pair
    bool has_inertia     = true;
    unsigned int slopes  = 0; ///< 2: those of the cylinder's axis may change

    /// The layout of one lever alone.
    InterfaceLayout single_lever() const
    {
      InterfaceLayout result = *this;
      result.levers          = 1;
      return result;
    }

    unsigned int dofs_per_lever() const
    {
      return surface + sensors + slopes + (sprung && has_inertia ? 3 : 1);
    }
    unsigned int first(const unsigned int lever) const
    {
      return lever * dofs_per_lever();
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
      return levers * dofs_per_lever();
    }
    unsigned int size() const
    {
      return support() + (sprung ? 1 : 0);
    }

    /// Returns the lever, 0 or 1, of a dof that is not the support's.
    unsigned int lever_index(const unsigned int dof) const
    {
      return dof / dofs_per_lever();
    }

    /// Returns true if a dof is one of the face of either lever.
    bool is_surface(const unsigned int dof) const
    {
      return dof < support() && dof % dofs_per_lever() < surface;
    }
    bool is_rotation(const unsigned int dof) const
    {
      return dof < support() && dof % dofs_per_lever() == surface + sensors + slopes;
    }
    bool is_slope(const unsigned int dof) const
    {
      return dof >= slope(0) && dof < slope(slopes);
    }
  };
} // namespace sprag
