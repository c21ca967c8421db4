// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "fe/solid/solid_body.h"
#include "model/vibration.h"

#include <list>

namespace sprag
{
  /// Masses of a body in three dimensions, applied cell by cell, with a tip mass on its end face, and of what turns with its hub.
  class SolidMass
  {
  public:
    /// Scales the densities to the moment of inertia, as InertialMatrices does. The body must outlive this. Throws InputError as
    /// that does.
    SolidMass(const SolidBody &body, const LeverInertia &inertia);

    /// Returns the mass times a displacement of all degrees of freedom, the held ones included.
    dealii::Vector<double> operator()(const dealii::Vector<double> &displacement) const;

    /// Displacement of a degree of freedom by a unit of rigid rotation about the pivot [mm].
    const dealii::Vector<double> &arms() const
    {
      return rotation_arms;
    }

    /// Returns the sum of forces or impulses along an axis.
    double sum_along(unsigned int axis, const dealii::Vector<double> &of_dofs) const;

    /// Returns where the kinetic energy of a motion lies, given by the displacement of all degrees of freedom; `whole`: modal
    /// mass of the motion, with that of hub and leaf spring, which move as in a plane [t]. A body that is not the same on both
    /// sides of the middle has no such shares: NaN.
    Eigenmode::AcrossShares shares(const dealii::Vector<double> &displacement, double whole) const;

    double hub               = 0.; ///< moment of inertia of what turns with the hub besides, as hub and leaf spring [t mm^2]
    double density_factor    = 1.;
    double total_mass        = 0.; ///< [t]
    double moment_of_inertia = 0.; ///< about the pivot [t mm^2]

  private:
    struct Cell
    {
      const dealii::FullMatrix<double> *mass; ///< between the nodes, for each direction
      double density;                         ///< times the symmetric half's share; of a face over its area
      std::vector<std::array<unsigned int, 3>> dofs;
    };

    void find_cells(const SolidBody &body, const LeverInertia &inertia);
    void add_tip(const SolidBody &body, double tip_mass);
    void find_arms(const SolidBody &body);
    void find_mirrored(const std::vector<dealii::Point<3>> &places);

    std::list<dealii::FullMatrix<double>> masses; ///< of unit density, one for cells that are alike
    std::vector<Cell> cells;
    dealii::Vector<double> rotation_arms;
    std::vector<char> component;
    std::vector<unsigned int> mirrored; ///< by a degree of freedom that on the other side; empty where not all have one
  };
} // namespace sprag
