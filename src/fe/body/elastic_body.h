// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/mumps.h"
#include "fe/body/connectors.h"
#include "fe/body/dimension.h"
#include "fe/body/friction_face.h"

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace sprag
{
  /// A meshed elastic body in axes in which its hub does not move. Displacement degrees of freedom are numbered from 0; those
  /// of the hub are held at 0, and of a half over the width those across in its middle.
  template <int dim>
  class ElasticBody
  {
  public:
    /// Adds constraints to those of hub and core.
    using Constrain = std::function<void(const dealii::DoFHandler<dim> &, dealii::AffineConstraints<double> &)>;

    /// The triangulation is kept by reference and must outlive the body.
    ElasticBody(const dealii::Triangulation<dim> &triangulation, BodyProperties properties, const Constrain &constrain = {});
    ElasticBody &operator=(ElasticBody &&) = delete;

    unsigned int n_dofs() const
    {
      return dof_handler.n_dofs();
    }

    const FrictionFace<dim> &friction_face() const
    {
      return face;
    }

    /// Returns the face where an elastic cylinder can touch the friction face; empty without such a cylinder.
    const FrictionFace<dim> &cylinder_face() const
    {
      return cylinder_friction_face;
    }

    /// Returns the springs between friction plate and lever, which are part of stiffness and energy.
    const std::vector<Connector> &connectors() const
    {
      return springs;
    }

    /// Returns those of the connectors() that are force sensors.
    std::vector<Connector> sensors() const;

    /// Returns the forces of the sensors at a displacement [N].
    std::vector<double> sensor_forces(const dealii::Vector<double> &displacement) const;

    const dealii::Mapping<dim> &cell_mapping() const
    {
      return mapping;
    }

    /// Returns which degrees of freedom are held or follow others.
    const dealii::AffineConstraints<double> &held() const
    {
      return constraints;
    }

    /// Allocates a matrix for the stiffness.
    void reinit(dealii::PETScWrappers::SparseMatrix &matrix) const;

    /// Adds the stiffness at `displacement` to `matrix` and the internal forces [N] to `forces`.
    void assemble(const dealii::Vector<double> &displacement, dealii::PETScWrappers::SparseMatrix &matrix,
                  dealii::Vector<double> &forces) const;

    /// Returns factors of the stiffness without load.
    std::shared_ptr<const Mumps> factorised() const;

    /// Returns the elastic energy [mJ].
    double energy(const dealii::Vector<double> &displacement) const;

    /// Returns mass [t] and moment of inertia about the pivot [t mm^2] at the given density [t/mm^3], hub included.
    std::array<double, 2> mass_and_inertia(double density) const;

    const BodyProperties &body_properties() const
    {
      return properties;
    }

    const dealii::DoFHandler<dim> &dofs() const
    {
      return dof_handler;
    }

    /// Returns whether the hub holds a degree of freedom.
    bool is_held(const unsigned int dof) const
    {
      return constraints.is_constrained(dof);
    }

  protected:
    /// Sets connectors that are not those of the properties.
    void use_connectors(std::vector<Connector> connectors)
    {
      springs = std::move(connectors);
    }

  private:
    void find_constraints(const Constrain &constrain);

    const BodyProperties properties;
    const dealii::FESystem<dim> fe;
    const dealii::MappingQ<dim> mapping;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    FrictionFace<dim> face;
    FrictionFace<dim> cylinder_friction_face;
    std::vector<Connector> springs;
  };

  /// Returns the degrees of freedom of the nodes of the friction face, then those of an elastic cylinder's face.
  template <int dim>
  std::vector<unsigned int> surface_dofs(const ElasticBody<dim> &body)
  {
    auto result         = face_dofs(body.friction_face());
    const auto cylinder = face_dofs(body.cylinder_face());
    result.insert(result.end(), cylinder.begin(), cylinder.end());
    return result;
  }

  /// Returns displacements [mm] by forces on all degrees of freedom of a body that its hub holds [N], one column after another.
  using Response = std::function<std::vector<double>(std::vector<double> columns)>;

  /// Returns the answer by the factors of a body.
  inline Response make_response(std::shared_ptr<const Mumps> factors)
  {
    return [factors = std::move(factors)](std::vector<double> columns)
    {
      factors->solve(columns);
      return columns;
    };
  }
} // namespace sprag
