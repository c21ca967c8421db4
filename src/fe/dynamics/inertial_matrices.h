// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_mass.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <array>
#include <vector>

namespace sprag
{
  /// Coordinates of a body in axes that do not turn, linear in the rotation of its hub: the total displacements
  /// u_tot = u_e + theta~ (-eta, xi) of all nodes which the hub does not hold, attached ones, and last theta~ itself.
  class TotalCoordinates
  {
  public:
    /// `attached`: number of further coordinates, before the rotation, which move no node.
    explicit TotalCoordinates(const ElasticBody<2> &body, unsigned int attached = 0);

    /// Number of coordinates, the rotation included.
    unsigned int size() const
    {
      return n_free + n_attached + 1;
    }

    /// Index of the rotation.
    unsigned int rotation() const
    {
      return n_free + n_attached;
    }

    /// Index of the i-th attached coordinate.
    unsigned int attached(const unsigned int i) const
    {
      return n_free + i;
    }

    /// The coordinate that moves a degree of freedom of the body, and by how much a unit of it does.
    struct Mover
    {
      unsigned int coordinate;
      double share;
    };

    const Mover &mover(const unsigned int dof) const
    {
      return movers[dof];
    }

    /// Displacement of a degree of freedom by a unit of rigid rotation [mm].
    double arm(const unsigned int dof) const
    {
      return arms[dof];
    }

    /// The row of a connector: its product with the coordinates is the compression.
    std::vector<std::pair<unsigned int, double>> row(const Connector &connector) const;

    /// A unit of rigid rotation, in these coordinates.
    dealii::Vector<double> rigid_rotation() const;

    /// Returns what forces on all degrees of freedom of the body are on the coordinates.
    dealii::Vector<double> collect(const dealii::Vector<double> &dof_values) const;

    /// Adds a symmetric matrix of some degrees of freedom of the body to that of the coordinates.
    void scatter(const std::vector<dealii::types::global_dof_index> &dofs, const dealii::FullMatrix<double> &local,
                 dealii::PETScWrappers::SparseMatrix &matrix) const;

    /// Returns the coordinates of an elastic displacement of all degrees of freedom in the axes of the hub, with attached ones
    /// and a rotation.
    dealii::Vector<double> total(const dealii::Vector<double> &elastic, const std::vector<double> &attached,
                                 double rotation) const;

    /// Elastic displacement of all degrees of freedom of the body, in the axes of its hub.
    dealii::Vector<double> elastic_displacement(const dealii::Vector<double> &total) const;

  private:
    std::vector<Mover> movers;
    const dealii::Vector<double> arms;
    unsigned int n_free     = 0;
    unsigned int n_attached = 0;
  };

  /// Matrices of small vibrations in total coordinates, without the hub's spring.
  class InertialMatrices : public MassSums
  {
  public:
    /// Throws InputError as BodyMass.
    InertialMatrices(const ElasticBody<2> &body, const LeverInertia &inertia);

    const TotalCoordinates coordinates;
    dealii::PETScWrappers::SparseMatrix mass;
    dealii::PETScWrappers::SparseMatrix stiffness;       ///< of lever, friction layer and connectors
    dealii::PETScWrappers::SparseMatrix layer_stiffness; ///< the layer's part of it
    std::array<dealii::Vector<double>, 2> momentum;      ///< integral of rho u along each axis = row times coordinates [t]

    /// Factors of a sum of mass, stiffness, the layer's stiffness and a unit on the hub's rotation.
    struct Weights
    {
      double mass;
      double stiffness;
      double layer;
      double rotation;
    };

    void sum(const Weights &weights, dealii::PETScWrappers::SparseMatrix &result) const;

  private:
    InertialMatrices(const ElasticBody<2> &body, const BodyMass<2> &body_mass, const LeafBehaviour &leaf);
    void find_pattern(const ElasticBody<2> &body);
    void assemble_stiffness(const ElasticBody<2> &body);
    void attach(double hub_inertia, const LeafBehaviour &leaf);

    dealii::DynamicSparsityPattern pattern;
  };
} // namespace sprag
