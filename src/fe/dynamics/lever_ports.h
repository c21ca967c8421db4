// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "model/port_layout.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Ports of a meshed lever in total coordinates: elastic displacements of those nodes (two entries a node), compressions of
  /// the force sensors, the hub's rotation and, on a sprung support, the momentum. The support's displacement follows the
  /// coordinates of the lever.
  class LeverPorts
  {
  public:
    LeverPorts(const ElasticBody<2> &body, const InertialMatrices &matrices, bool sprung);

    const PortLayout &layout() const
    {
      return ports;
    }

    /// Number of coordinates, the support's included.
    unsigned int n_coordinates() const;

    dealii::Vector<double> displacements(const dealii::Vector<double> &coordinates) const;

    /// Adds what a force on a port is on the coordinates.
    void add_force(unsigned int port, double force, dealii::Vector<double> &forces) const;

    /// Coordinates of the faces' nodes and the rotation, on which a compliance can be found.
    std::vector<unsigned int> face_coordinates() const;

    /// The port of the i-th of those coordinates.
    unsigned int face_port(unsigned int i) const;

    /// Turns the compliance of those coordinates into that of their ports.
    void transform(dealii::FullMatrix<double> &compliance) const;

  private:
    PortLayout ports;
    unsigned int n_lever;
    std::vector<unsigned int> coordinates;                             ///< of the face's ports
    dealii::Vector<double> arms;                                       ///< what a unit of rotation moves them [mm]
    std::vector<std::vector<std::pair<unsigned int, double>>> sensors; ///< rows of the sensors' ports
    std::array<dealii::Vector<double>, 2> momentum;                    ///< rows of the ports along eta and xi
  };
} // namespace sprag
