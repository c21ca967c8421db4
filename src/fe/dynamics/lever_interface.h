// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "model/interface/interface_layout.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Interface of a meshed lever in total coordinates: elastic displacements of those nodes (two entries a node), compressions of
  /// the force sensors, the hub's rotation and, on a sprung support, the momentum. The support's displacement follows the
  /// coordinates of the lever.
  class LeverInterface
  {
  public:
    LeverInterface(const ElasticBody<2> &body, const InertialMatrices &matrices, bool sprung);

    const InterfaceLayout &layout() const
    {
      return numbering;
    }

    /// Number of coordinates, the support's included.
    unsigned int n_coordinates() const
    {
      return n_lever + (numbering.sprung ? 1 : 0);
    }

    dealii::Vector<double> displacements(const dealii::Vector<double> &coordinates) const;

    /// Adds a force on a dof to the forces on the coordinates.
    void add_force(unsigned int dof, double force, dealii::Vector<double> &forces) const;

    /// Coordinates of the faces' nodes and the rotation, on which a compliance can be found.
    std::vector<unsigned int> face_coordinates() const;

    /// Returns the dof of the i-th of those coordinates.
    unsigned int face_dof(const unsigned int i) const
    {
      return i < numbering.surface ? i : numbering.rotation();
    }

    /// Turns the compliance of those coordinates into that of their dofs.
    void transform(dealii::FullMatrix<double> &compliance) const;

  private:
    InterfaceLayout numbering;
    unsigned int n_lever;
    std::vector<unsigned int> coordinates;                             ///< of the face's dofs
    dealii::Vector<double> arms;                                       ///< what a unit of rotation moves them [mm]
    std::vector<std::vector<std::pair<unsigned int, double>>> sensors; ///< rows of the sensors' dofs
    std::array<dealii::Vector<double>, 2> momentum;                    ///< rows of the dofs along eta and xi
  };
} // namespace sprag
