#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/port_springs.h"
#include "model/port_forces.h"
#include "model/port_layout.h"

namespace sprag
{
  /// Newton iteration for any material: assembles and factorises at every iterate. Coordinates: of each lever the displacements
  /// of all degrees of freedom of its body and the turn of its hub, then the displacement of a sprung support.
  class FullStiffness
  {
  public:
    /// The body must outlive this; that of a pair's second lever is alike.
    FullStiffness(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);

    unsigned int n_coordinates() const;

    /// Index of the coordinate of a port.
    unsigned int coordinate(unsigned int port) const;

    dealii::Vector<double> port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Norm of the unbalanced forces [N].
    double unbalance(const dealii::Vector<double> &coordinates, const PortForces &forces);

    /// Correction at the last unbalance(). Throws AnalysisError if the factorisation fails.
    dealii::Vector<double> correction(const PortForces &forces);

    /// Absolute value of the largest coordinate.
    double largest(const dealii::Vector<double> &coordinates) const;

    /// Displacement of the whole body of a lever.
    dealii::Vector<double> body_displacement(unsigned int lever, const dealii::Vector<double> &coordinates,
                                             const PortLoads &forces) const;

    /// Forces of the sensors of a lever [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &coordinates,
                                      const PortLoads &forces) const;

    /// Visits what the factors' ordering was found for, on which their round-off depends.
    void visit_history(Archive &archive);

  private:
    unsigned int first_coordinate(unsigned int lever) const;
    void couple_ports(dealii::DynamicSparsityPattern &pattern) const;
    void find_places(unsigned int lever);
    void add_body(unsigned int lever, const dealii::Vector<double> &coordinates);

    const ElasticBody<2> &body;
    const PortLayout ports;
    const PortSprings springs;
    const std::vector<unsigned int> surface; ///< degrees of freedom of a lever's ports
    Mumps factors;
    dealii::PETScWrappers::SparseMatrix of_body; ///< stiffness of a lever's body
    dealii::PETScWrappers::SparseMatrix matrix;
    std::vector<std::size_t> places; ///< of the entries of each lever's body in the matrix
    dealii::Vector<double> residual; ///< forces on the ports less those of bodies and springs

    // The first matrix that was factorised, which the factors are ordered for.
    bool is_ordered = false;
    dealii::Vector<double> first_coordinates;
    PortForces first_forces;
  };
} // namespace sprag
