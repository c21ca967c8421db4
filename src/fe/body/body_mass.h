// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/body/end_face.h"
#include "scene/apparatus.h"
#include "scene/lever.h"

#include <list>

namespace sprag
{
  /// Masses of a lever. A hub in the mesh is massless.
  struct LeverInertia
  {
    std::map<dealii::types::material_id, double> densities; ///< before scaling [t/mm^3]
    double tip_mass          = 0.;                          ///< spread over the lever's end face [t]
    double moment_of_inertia = 0.; ///< about the pivot, what the densities are scaled to; all below included [t mm^2]
    InertiaSource source     = InertiaSource::scaled;
    double hub               = 0.; ///< of what turns with the hub besides [t mm^2]
    LeafBehaviour leaf       = {}; ///< its vibrations are attached coordinates
  };

  /// Sums of a lever's masses.
  struct MassSums
  {
    double density_factor    = 1.; ///< by which the densities were scaled to meet the moment of inertia
    double total_mass        = 0.; ///< of lever, tip and leaf spring [t]
    double moment_of_inertia = 0.; ///< about the pivot, of all that turns with the hub [t mm^2]
  };

  /// Returns the axis of each degree of freedom, -1 of an elastic cylinder's, which does not turn with the hub.
  template <int dim>
  std::vector<int> turning_axes(const ElasticBody<dim> &body);

  /// Returns the displacement (-eta, xi) of each degree of freedom by a unit of rigid rotation about the pivot [mm].
  template <int dim>
  dealii::Vector<double> rotation_arms(const ElasticBody<dim> &body);

  /// Masses of a body, applied cell by cell, with a tip mass on faces, and of what turns with its hub. Sums and moments leave out
  /// an elastic cylinder, which does not turn.
  template <int dim>
  class BodyMass : public MassSums
  {
  public:
    /// The mass of a cell or face between its nodes, the same in each direction.
    struct Cell
    {
      const dealii::FullMatrix<double> *mass; ///< of unit density
      double density;                         ///< times width or, of a half, two; of a face over its area
      std::vector<std::array<unsigned int, dim>> dofs;
    };

    /// Scales the densities of what turns to the moment of inertia, unless they are as built. The body must outlive this. Throws
    /// InputError if tip mass, hub and leaf spring alone have more than there is, or no end face carries the tip mass.
    BodyMass(const ElasticBody<dim> &body, const LeverInertia &inertia);

    /// The same with the tip mass on other faces.
    BodyMass(const ElasticBody<dim> &body, const LeverInertia &inertia, const CellFaces<dim> &tip);
    BodyMass(const BodyMass &)            = delete;
    BodyMass &operator=(const BodyMass &) = delete;

    /// Returns the mass times a displacement of all degrees of freedom, the held ones included.
    dealii::Vector<double> operator()(const dealii::Vector<double> &displacement) const;

    const std::vector<Cell> &cells() const
    {
      return all_cells;
    }

    /// Returns the sum of forces or impulses along an axis.
    double sum_along(const unsigned int axis, const dealii::Vector<double> &dof_values) const
    {
      return translation(axis) * dof_values;
    }

    /// Returns a unit displacement of all that turns along an axis.
    dealii::Vector<double> translation(const unsigned int axis) const
    {
      dealii::Vector<double> result(static_cast<unsigned int>(axes.size()));
      for (unsigned int dof = 0; dof < result.size(); ++dof)
        result[dof] = axes[dof] == static_cast<int>(axis) ? 1. : 0.;
      return result;
    }

    const dealii::Vector<double> arms; ///< rotation_arms() of the body
    const double hub;                  ///< moment of inertia of what turns with the hub besides, as hub and leaf spring [t mm^2]

  private:
    void add_cells(const ElasticBody<dim> &body, const LeverInertia &inertia);
    void add_tip(const ElasticBody<dim> &body, double tip_mass, const CellFaces<dim> &tip);

    bool turns(const Cell &cell) const
    {
      return axes[cell.dofs.front()[0]] >= 0;
    }

    std::list<dealii::FullMatrix<double>> masses; ///< of unit density, in space one for equal cells
    std::vector<Cell> all_cells;
    const std::vector<int> axes;
  };
} // namespace sprag
