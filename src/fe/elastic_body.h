#pragma once

#include "fe/material.h"

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <map>
#include <vector>

namespace sprag
{
  // Ids that make_mesh() gives and ElasticBody reads.
  namespace material_id
  {
    inline constexpr dealii::types::material_id lever = 1;
    inline constexpr dealii::types::material_id layer = 2;
    inline constexpr dealii::types::material_id hub   = 3; ///< rigid: its nodes do not move in lever axes
  }                                                        // namespace material_id

  namespace boundary_id
  {
    inline constexpr dealii::types::boundary_id friction_face = 1;
    inline constexpr dealii::types::boundary_id hub           = 2; ///< does not move in lever axes
  }                                                                // namespace boundary_id

  struct BodyProperties
  {
    unsigned int degree    = 2;
    PlaneState plane       = PlaneState::stress;
    MaterialModel material = MaterialModel::linear;
    double width           = 1.; ///< out of plane [mm]
    std::map<dealii::types::material_id, ElasticConstants> constants;
  };

  /// A free node of the friction face.
  template <int dim>
  struct FaceNode
  {
    dealii::Point<dim> position; ///< undeformed [mm]
    double weight;               ///< share of the face's area [mm^2]
    std::array<unsigned int, dim> dofs;
  };

  /// A meshed elastic body in axes in which its hub does not move. Displacement degrees of freedom are numbered from 0;
  /// those of the hub are held at 0 and carry an identity row.
  template <int dim>
  class ElasticBody
  {
  public:
    /// The triangulation is kept by reference and must outlive the body.
    ElasticBody(const dealii::Triangulation<dim> &triangulation, BodyProperties properties);
    ElasticBody(const ElasticBody &)            = delete;
    ElasticBody &operator=(const ElasticBody &) = delete;

    unsigned int n_dofs() const;

    /// Free nodes of the friction face, ordered along the first axis.
    const std::vector<FaceNode<dim>> &face_nodes() const;

    /// Largest E/h of the cells at the friction face, h their size normal to it [N/mm^3].
    double face_stiffness() const;

    /// A matrix for the stiffness with `extra` further rows and columns, which couple with the friction face and themselves.
    void reinit(dealii::PETScWrappers::SparseMatrix &matrix, unsigned int extra) const;

    /// Adds the stiffness at `displacement` to `matrix` and the internal forces [N] to `forces`; both may be longer than
    /// n_dofs().
    void assemble(const dealii::Vector<double> &displacement, dealii::PETScWrappers::SparseMatrix &matrix,
                  dealii::Vector<double> &forces) const;

    /// Elastic energy [mJ].
    double energy(const dealii::Vector<double> &displacement) const;

    /// Mass [t] and moment of inertia about the origin of the axes [t mm^2] at the given density [t/mm^3], hub included.
    std::array<double, 2> mass_and_inertia(double density) const;

    const BodyProperties &body_properties() const;

    const dealii::DoFHandler<dim> &dofs() const;

  private:
    void find_constraints();
    void find_face_nodes();

    const BodyProperties properties;
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    std::vector<FaceNode<dim>> face;
    double stiffness_of_face = 0.;
  };
} // namespace sprag
