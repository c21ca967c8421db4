#pragma once

#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/port_springs.h"
#include "model/port_forces.h"
#include "model/port_layout.h"

namespace sprag
{
  /// Newton iteration for any material: assembles and factorises at every iterate. Coordinates: displacement of all degrees of
  /// freedom of the body, then those of the ports of hub and support.
  class FullStiffness
  {
  public:
    /// The body must outlive this.
    FullStiffness(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);

    unsigned int n_coordinates() const;

    dealii::Vector<double> port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Norm of the unbalanced forces [N].
    double unbalance(const dealii::Vector<double> &coordinates, const PortForces &forces);

    /// Correction at the last unbalance(). Throws AnalysisError if the factorisation fails.
    dealii::Vector<double> correction(const PortForces &forces);

    /// What a unit moment on the hub adds to the last correction() [1/(N mm)].
    dealii::Vector<double> moment_response(const PortForces &forces) const;

    dealii::Vector<double> body_displacement(const dealii::Vector<double> &coordinates, const PortForces &forces) const;

    /// Forces of the body's sensors [N].
    std::vector<double> sensor_forces(const dealii::Vector<double> &coordinates, const PortForces &forces) const;

  private:
    const ElasticBody<2> &body;
    const PortLayout ports;
    const PortSprings springs;
    std::vector<unsigned int> coordinate_of; ///< of each port
    Mumps factors;
    dealii::PETScWrappers::SparseMatrix matrix;
    dealii::Vector<double> residual; ///< forces on the ports less those of body and springs
  };
} // namespace sprag
