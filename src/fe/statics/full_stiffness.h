// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/static_interface.h"
#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"
#include "results/columns.h"

namespace sprag
{
  /// Newton iteration for any material: assembles and factorises at every iterate. Coordinates: of each lever the displacements
  /// of all degrees of freedom of its body and the turn of its hub, then the displacement of a sprung support.
  class FullStiffness
  {
  public:
    static constexpr bool has_candidates = false; ///< but at the whole interface

    /// The body must outlive this; that of a pair's second lever is equal.
    FullStiffness(const ElasticBody<2> &body, const InterfaceLayout &layout, const JointSprings &springs);

    unsigned int n_coordinates() const
    {
      return first_coordinate(layout.levers) + (layout.sprung ? 1 : 0);
    }

    /// Returns the index of the coordinate of a dof.
    unsigned int coordinate(unsigned int dof) const;

    dealii::Vector<double> interface_displacements(const dealii::Vector<double> &coordinates) const;

    /// Returns the interface forces less those of bodies and springs [N], with the tangent.
    Residual residual(const dealii::Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &near = {});

    /// Returns the correction. Throws AnalysisError if the factorisation fails.
    dealii::Vector<double> correction(const Residual &residual, const InterfaceForces &forces, const DofSelection &near = {});

    /// Returns the displacements in each of some states.
    std::vector<BodyDisplacements> body_displacements(const std::vector<StaticState> &states) const;

    /// Returns the forces of the sensors of a lever [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &coordinates, const DofLoads &) const;

    /// Serialises what the factors' ordering was found for, on which their round-off depends.
    void serialise_history(Archive &archive);

  private:
    unsigned int first_coordinate(const unsigned int lever) const
    {
      return lever * (body.n_dofs() + 1);
    }

    std::shared_ptr<dealii::PETScWrappers::SparseMatrix> free_matrix();
    dealii::Vector<double> body_displacement(unsigned int lever, const dealii::Vector<double> &coordinates) const;
    void add_body(unsigned int lever, const dealii::Vector<double> &coordinates, dealii::PETScWrappers::SparseMatrix &matrix,
                  dealii::Vector<double> &forces);

    const ElasticBody<2> &body;
    const InterfaceLayout layout;
    const JointSprings springs;
    const std::vector<unsigned int> surface; ///< the body's degrees of freedom on a lever's faces
    Mumps factors{ MatrixKind::tangent };
    dealii::PETScWrappers::SparseMatrix body_stiffness; ///< stiffness of a lever's body
    dealii::DynamicSparsityPattern pattern;
    std::vector<std::shared_ptr<dealii::PETScWrappers::SparseMatrix>> matrices; ///< each allocated for a tangent

    // State of the first tangent, for which the factors are ordered.
    bool is_ordered = false;
    dealii::Vector<double> first_coordinates;
    InterfaceForces first_forces;
  };
} // namespace sprag
