// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "scene/apparatus.h"
#include "scene/lever.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <array>
#include <map>
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
    unsigned int size() const;

    /// Index of the rotation.
    unsigned int rotation() const;

    /// Index of the i-th attached coordinate.
    unsigned int attached(unsigned int i) const;

    /// The coordinate that moves a degree of freedom of the body, and by how much a unit of it does.
    struct Mover
    {
      unsigned int coordinate;
      double share;
    };

    const Mover &mover(unsigned int dof) const;

    /// Displacement of a degree of freedom by a unit of rigid rotation [mm].
    double arm(unsigned int dof) const;

    /// The row of a connector: its product with the coordinates is the compression.
    std::vector<std::pair<unsigned int, double>> row(const Connector &connector) const;

    /// A unit of rigid rotation, in these coordinates.
    dealii::Vector<double> rigid_rotation() const;

    /// Elastic displacement of all degrees of freedom of the body, in the axes of its hub.
    dealii::Vector<double> elastic_displacement(const dealii::Vector<double> &total) const;

  private:
    std::vector<Mover> movers;
    std::vector<double> arms;
    unsigned int n_free     = 0;
    unsigned int n_attached = 0;
  };

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

  /// Returns by what the densities of cells are scaled to the moment of inertia, 1 as built. `of_cells`: theirs before, `added`:
  /// that of tip mass, hub and leaf spring [t mm^2]. Throws InputError if these alone have more than there is.
  double scaling_of_densities(const LeverInertia &inertia, double of_cells, double added);

  /// Matrices of small vibrations in total coordinates, without the hub's spring.
  class InertialMatrices
  {
  public:
    /// Throws InputError if tip mass and hub alone have more than the moment of inertia, or there is no end face for the tip.
    InertialMatrices(const ElasticBody<2> &body, const LeverInertia &inertia);

    const TotalCoordinates coordinates;
    dealii::PETScWrappers::SparseMatrix mass;
    dealii::PETScWrappers::SparseMatrix stiffness;       ///< of lever, friction layer and connectors
    dealii::PETScWrappers::SparseMatrix layer_stiffness; ///< the layer's part of it
    std::array<dealii::Vector<double>, 2> momentum;      ///< integral of rho u along each axis = row times coordinates [t]
    double moment_of_inertia = 0.;                       ///< about the pivot, of all that turns with the hub [t mm^2]
    double density_factor    = 1.;                       ///< by which the densities were scaled
    double total_mass        = 0.;                       ///< of lever, tip and leaf spring [t]

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
    void find_pattern(const ElasticBody<2> &body);
    void assemble_cells(const ElasticBody<2> &body, const std::map<dealii::types::material_id, double> &densities);
    void assemble_connectors(const ElasticBody<2> &body);
    void assemble_tip(const ElasticBody<2> &body, double tip_mass);
    void attach_hub(double of_hub, const LeafBehaviour &leaf);

    dealii::DynamicSparsityPattern pattern;
  };
} // namespace sprag
