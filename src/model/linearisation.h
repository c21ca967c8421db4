#pragma once

#include "model/dynamic_model.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Which part of the contact's tangent is wanted. By displacements: of the pressure, with the change of its direction, and of
  /// friction; by velocities: of contact damping, and of friction, as pressure and mu follow the velocities.
  enum class TangentPart
  {
    all, ///< by displacements
    pressure,
    friction,
    pressure_rate,
    friction_rate
  };

  /// A contact whose points all slide at one speed, at given displacements of the ports.
  struct SlidingState
  {
    const dealii::Vector<double> &ports;
    const DrivePoint &drive;
    double speed;                                  ///< of the cylinder's surface along the lever [mm/s], != 0
    const dealii::Vector<double> *rates = nullptr; ///< of the ports, which add to the slip; none: at rest
    ContactFriction friction            = ContactFriction::sliding;
    TangentPart part                    = TangentPart::all;
  };

  /// Displacements of points along the lever, in lever axes [mm].
  struct SurfaceShape
  {
    std::vector<double> xi; ///< undeformed
    std::vector<double> along;
    std::vector<double> across;
  };

  /// Forces f on some ports by a small perturbation z(t) of them, about a held slide:
  ///   f = (pressure + friction) z + (pressure_rate + friction_rate) z' - inertia z''
  struct PortPerturbation
  {
    std::vector<unsigned int> ports; ///< increasing
    dealii::FullMatrix<double> pressure;
    dealii::FullMatrix<double> friction;
    dealii::FullMatrix<double> pressure_rate;
    dealii::FullMatrix<double> friction_rate;
    dealii::FullMatrix<double> inertia; ///< coupling with a sprung support, symmetric

    dealii::FullMatrix<double> stiffness() const; ///< df/dz, all of it
    dealii::FullMatrix<double> damping() const;   ///< df/dz'
  };
} // namespace sprag
