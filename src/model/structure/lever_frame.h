// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "results/columns.h"
#include "scene/lever.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <limits>

namespace sprag
{
  struct Device;

  /// Constants that a lever, or a mirrored pair, has from the scene it stands in.
  struct LeverFrame
  {
    std::vector<Geometry> geometries; ///< of each lever, the cylinder's offset in them
    InterfaceLayout layout;
    double rest_inclination;         ///< theta without moment [rad]
    MomentLaw spring;                ///< rotational, over the turn from there
    double support_stiffness;        ///< k_f of all levers [N/mm]; counts on a sprung support
    double support_damping;          ///< c_f of all levers [N s/mm]
    dealii::Vector<double> lengths;  ///< movement by a unit of each dof [mm]: 1, and an arm for rotations
    double sensor_stiffness = 0.;    ///< of each force sensor of a friction plate [N/mm]
    bool joined             = false; ///< the springs of a pair by a joint that nothing else carries

    /// Indentation of the layer beyond which a slide counts as jammed [mm]: half its thickness, where the pressure is half of
    /// its Young's modulus and a run without inertia ends, too.
    double largest_indentation = std::numeric_limits<double>::infinity();

    /// Tells the row of a lever the forces of its sensors [N].
    std::function<void(std::vector<double> forces, Row &row)> tell_sensors = [](std::vector<double> forces, Row &row)
    { row.sensor_forces = std::move(forces); };
  };

  /// The frame of a scene, with lengths 1 but for the hubs' rotations. `lever_mass` [t], of one lever, moves with a sprung
  /// support.
  LeverFrame lever_frame(const Device &device, const InterfaceLayout &layout, double lever_mass);

  /// c_f [N s/mm]: Support/Damping of critical of the frame with the lever on k_f.
  double support_damping(const Support &support, double lever_mass);
} // namespace sprag
