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

  /// Constants of the scene that a lever or mirrored pair needs beside its own mechanics.
  struct LeverFrame
  {
    std::vector<Geometry> geometries; ///< one per lever; the cylinder's offset is included
    InterfaceLayout layout;
    double rest_inclination;         ///< theta without moment [rad]
    std::vector<MomentLaw> springs;  ///< one per lever: moment over the rotation from rest_inclination
    double support_stiffness;        ///< k_f of a sprung support under all levers [N/mm]
    double support_damping;          ///< c_f of that support [N s/mm]
    dealii::Vector<double> lengths;  ///< movement per unit of each dof: 1, or an arm for rotations [mm]
    double sensor_stiffness = 0.;    ///< of each force sensor of a friction plate [N/mm]
    bool joined             = false; ///< the springs of a pair meet in a joint that is not supported otherwise

    double loss_factor = 0.; ///< of contact and layer at each vibration's own frequency; 0: they have dashpots

    /// Indentation of the layer beyond which a slide counts as jammed [mm]: half its thickness, where the pressure is half of
    /// its Young's modulus and a run without inertia ends, too.
    double largest_indentation = std::numeric_limits<double>::infinity();

    /// Writes the sensor forces of a lever [N] to its row.
    std::function<void(std::vector<double> forces, Row &row)> observe_sensors = [](std::vector<double> forces, Row &row)
    { row.sensor_forces = std::move(forces); };

    /// Returns whether the first lever presses at x = 0.
    bool is_preloaded() const
    {
      return springs.front().moment(0.) > 0.;
    }
  };

  /// Returns the frame of a device; `lengths` are 1 except for the hubs' rotations. `lever_mass` [t] of one lever moves with a
  /// sprung support.
  LeverFrame lever_frame(const Device &device, const InterfaceLayout &layout, double lever_mass);

  /// Returns c_f = 2 D sqrt(k_f m) [N s/mm], D = Support/Damping and m the mass of frame and lever [t].
  double support_damping(const Support &support, double lever_mass);

  /// Spring, damping and support of a lever in time, beside its modes or matrices.
  struct LeverDynamics
  {
    double spring_stiffness  = 0.; ///< k [N mm/rad], > 0
    double mass_damping      = 0.; ///< Rayleigh [1/s]
    double stiffness_damping = 0.; ///< Rayleigh, the spring left out [s]
    double relaxation        = 0.; ///< of the friction layer, damping over stiffness [s]
    double modal_damping     = 0.; ///< of critical, on the bending modes
    bool sprung              = false;
    double support_mass      = 0.; ///< with the lever's [t]
    double support_stiffness = 0.; ///< [N/mm]
    double support_damping   = 0.; ///< [N s/mm]
  };

  /// Returns those of a scene's lever. `relaxation`: damping over stiffness of the friction layer [s];
  /// `lever_mass`: what moves with a sprung support [t].
  LeverDynamics make_lever_dynamics(const Device &device, double relaxation, double lever_mass);
} // namespace sprag
