#pragma once

#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/port_springs.h"
#include "model/port_forces.h"
#include "model/port_layout.h"

namespace sprag
{
  /// A linear body on linear springs in statics, factorised once and seen through its ports: z = G f(z). The compliance G is
  /// dense on the nodes of the faces and diagonal on hub and support, which do not move the body in its own axes. Only ports with
  /// forces carry tangents, so a Newton correction is a dense solve of those, and the iterates are those of the full system.
  /// Coordinates: displacements of the ports.
  class FaceCompliance
  {
  public:
    /// The body must outlive this.
    FaceCompliance(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);

    unsigned int n_coordinates() const;

    const dealii::Vector<double> &port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Norm of G f - z, as a displacement [mm].
    double unbalance(const dealii::Vector<double> &coordinates, const PortForces &forces);

    /// Correction at the last unbalance(). Throws AnalysisError if the tangent is singular.
    dealii::Vector<double> correction(const PortForces &forces) const;

    /// What a unit moment on the hub adds to the last correction [1/(N mm)]. Throws as it does.
    dealii::Vector<double> moment_response(const PortForces &forces) const;

    /// Displacement of the whole body under the forces, by one back-substitution.
    dealii::Vector<double> body_displacement(const dealii::Vector<double> &coordinates, const PortForces &forces) const;

    /// Forces of the body's sensors [N].
    std::vector<double> sensor_forces(const dealii::Vector<double> &coordinates, const PortForces &forces) const;

  private:
    void find_sensor_rows();

    const ElasticBody<2> &body;
    const PortLayout ports;
    const std::vector<unsigned int> surface; ///< degrees of freedom of its ports
    const double arm;
    const PortSelection all;
    Mumps factors;
    dealii::FullMatrix<double> compliance;
    dealii::FullMatrix<double> sensor_rows; ///< force of a sensor by unit forces on the face's ports
    dealii::Vector<double> mismatch;        ///< G f - z
  };
} // namespace sprag
