// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/port_springs.h"
#include "model/port_forces.h"
#include "model/port_layout.h"
#include "results/columns.h"

namespace sprag
{
  /// Newton iteration for any material: assembles and factorises at every iterate. Coordinates: of each lever the displacements
  /// of all degrees of freedom of its body and the turn of its hub, then the displacement of a sprung support.
  class FullStiffness
  {
  public:
    static constexpr bool looks_at_some = false; ///< but at all ports

    /// The body must outlive this; that of a pair's second lever is alike.
    FullStiffness(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);

    unsigned int n_coordinates() const;

    /// Index of the coordinate of a port.
    unsigned int coordinate(unsigned int port) const;

    dealii::Vector<double> port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Returns the forces on the ports less those of bodies and springs [N], with the tangent.
    Residual residual(const dealii::Vector<double> &coordinates, const PortForces &forces, const PortSelection &near = {});

    /// Returns the correction. Throws AnalysisError if the factorisation fails.
    dealii::Vector<double> correction(const Residual &residual, const PortForces &forces, const PortSelection &near = {});

    /// Returns the displacement of the whole body of each lever.
    std::vector<dealii::Vector<double>> body_displacements(const dealii::Vector<double> &coordinates,
                                                           const PortLoads &forces) const;

    /// Tells a row the forces of the sensors of a lever [N].
    void tell_sensors(unsigned int lever, const dealii::Vector<double> &coordinates, const PortLoads &forces, Row &row) const;

    /// Visits what the factors' ordering was found for, on which their round-off depends.
    void visit_history(Archive &archive);

  private:
    unsigned int first_coordinate(unsigned int lever) const;
    void couple_ports();
    void find_places(unsigned int lever);
    std::shared_ptr<dealii::PETScWrappers::SparseMatrix> free_matrix();
    dealii::Vector<double> body_displacement(unsigned int lever, const dealii::Vector<double> &coordinates) const;
    void add_body(unsigned int lever, const dealii::Vector<double> &coordinates, dealii::PETScWrappers::SparseMatrix &matrix,
                  dealii::Vector<double> &forces);

    const ElasticBody<2> &body;
    const PortLayout ports;
    const PortSprings springs;
    const std::vector<unsigned int> surface; ///< degrees of freedom of a lever's ports
    Mumps factors;
    dealii::PETScWrappers::SparseMatrix body_stiffness; ///< stiffness of a lever's body
    dealii::DynamicSparsityPattern pattern;
    std::vector<std::shared_ptr<dealii::PETScWrappers::SparseMatrix>> matrices; ///< with room for a tangent each
    std::vector<std::size_t> places; ///< of the entries of each lever's body in such a matrix

    // State of the first tangent, for which the factors are ordered.
    bool is_ordered = false;
    dealii::Vector<double> first_coordinates;
    PortForces first_forces;
  };
} // namespace sprag
