#pragma once

#include "fe/body/elastic_body.h"
#include "fe/statics/port_springs.h"
#include "fe/statics/surface_compliance.h"
#include "model/port_layout.h"

#include <array>

namespace sprag
{
  /// Linear levers on linear springs in statics, one or both of a pair, which are alike: factorised once and seen through their
  /// ports, z = G f(z). The compliance G is dense on the faces of a lever and diagonal on hubs and support, which do not move a
  /// body in its own axes. Only ports with forces carry tangents, so that a Newton correction is a dense solve of those, and the
  /// iterates are those of the full system. Coordinates: displacements of all ports, of which only those that were entered
  /// last are looked at.
  class StaticStructure
  {
  public:
    /// The body must outlive this.
    StaticStructure(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);

    unsigned int n_coordinates() const;

    /// Index of the coordinate of a port.
    unsigned int coordinate(unsigned int port) const;

    const dealii::Vector<double> &port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Looks at the given ports from now on, which increase and hold those of hubs and support. Returns those that it did not
    /// look at before.
    PortSelection enter(const PortSelection &ports);

    /// Sets the displacements of those ports of the faces that it looks at to G f. It must look at the ports of the forces.
    void set_faces(const PortLoads &forces, dealii::Vector<double> &coordinates) const;

    /// Norm of G f - z, as a displacement [mm].
    double unbalance(const dealii::Vector<double> &coordinates, const PortForces &forces);

    /// Correction at the last unbalance(), 0 on ports it does not look at. Throws AnalysisError if the tangent is singular.
    dealii::Vector<double> correction(const PortForces &forces) const;

    /// Absolute value of the largest coordinate that it looks at.
    double largest(const dealii::Vector<double> &coordinates) const;

    /// Displacement of the whole body of a lever under forces on the ports, by one back-substitution.
    dealii::Vector<double> body_displacement(unsigned int lever, const dealii::Vector<double> &coordinates,
                                             const PortLoads &forces) const;

    /// Forces of the sensors of a lever [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &coordinates,
                                      const PortLoads &forces) const;

    /// Visits what it knows of the compliance.
    void visit_history(Archive &archive);

  private:
    /// Ports of a face of a lever.
    struct Section
    {
      unsigned int face; ///< 0: friction face, 1: that of an elastic cylinder
      unsigned int begin;
      unsigned int end; ///< beyond the last
    };

    void find_sensor_rows();
    std::array<Section, 2> sections_of(unsigned int lever) const;
    void move_window(const PortSelection &wanted);
    dealii::Vector<double> forces_on_faces(unsigned int lever, const PortLoads &forces) const;
    PortSelection places_of(const std::vector<unsigned int> &of_ports) const;

    const ElasticBody<2> &body;
    const PortLayout ports;
    const PortSprings springs;
    const std::vector<unsigned int> surface; ///< degrees of freedom of a lever's ports
    Mumps factors;
    std::array<SurfaceCompliance, 2> faces; ///< of friction face and cylinder's face
    dealii::FullMatrix<double> sensor_rows; ///< force of a sensor by unit forces on a lever's ports

    // The compliance is known in a window of whole tiles, a place for each of its ports.
    PortSelection window;
    PortSelection window_for;        ///< ports that it was made for
    PortCompliance compliance;       ///< of the places
    dealii::Vector<double> mismatch; ///< G f - z
    PortSelection selected;          ///< ports it looks at
    PortSelection places;            ///< of them
  };
} // namespace sprag
