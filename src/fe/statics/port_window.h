#pragma once

#include "base/archive.h"
#include "fe/statics/port_springs.h"
#include "model/port_forces.h"
#include "model/port_layout.h"

#include <functional>

namespace sprag
{
  /// Compliance between the ports of a face of a body that its hub holds, by their places on the face.
  struct FaceResponse
  {
    unsigned int n_ports;
    std::function<PortSelection(const PortSelection &)> whole_tiles; ///< those that hold some ports
    std::function<std::shared_ptr<const dealii::FullMatrix<double>>(const PortSelection &whole_tiles)> among; ///< [mm/N]
  };

  /// Linear levers on linear springs in statics, seen through their ports, z = G f(z). The compliance G is dense on the faces of
  /// a lever and diagonal on hubs and support, which do not move a body in its own axes, and on the cylinder's slopes. It is
  /// known in a window of whole tiles. Only ports with forces carry tangents, so that a Newton correction is a dense solve of
  /// those, and the iterates are those of the full system. Coordinates: displacements of all ports, of which only those that were
  /// entered last are looked at.
  class PortWindow
  {
  public:
    /// The faces of a lever in the order of their ports, the same for both of a pair.
    PortWindow(const PortLayout &ports, const PortSprings &springs, std::vector<FaceResponse> faces);

    unsigned int n_coordinates() const;

    /// Index of the coordinate of a port.
    unsigned int coordinate(unsigned int port) const;

    const dealii::Vector<double> &port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Looks at the given ports from now on, which increase and hold those of hubs and support. Returns those that it did not
    /// look at before.
    PortSelection enter(const PortSelection &ports);

    /// Sets the displacements of those ports of the faces that it looks at to G f. It must look at the ports of the forces.
    void set_faces(const PortLoads &forces, dealii::Vector<double> &coordinates) const;

    /// Norm of G f - z, as a displacement [mm]. `of_faces`: displacements of the faces in place of G f, on all their ports, of a
    /// body that is not linear.
    double unbalance(const dealii::Vector<double> &coordinates, const PortForces &forces,
                     const dealii::Vector<double> *of_faces = nullptr);

    /// Correction at the last unbalance(), 0 on ports it does not look at. Throws AnalysisError if the tangent is singular.
    dealii::Vector<double> correction(const PortForces &forces) const;

    /// Absolute value of the largest coordinate that it looks at.
    double largest(const dealii::Vector<double> &coordinates) const;

    /// Visits where the window is.
    void visit_history(Archive &archive);

  private:
    void move_window(const PortSelection &wanted);
    PortSelection places_of(const std::vector<unsigned int> &of_ports) const;

    const PortLayout ports;
    const PortSprings springs;
    const std::vector<FaceResponse> faces;

    PortSelection window;            ///< ports that the compliance is known of, a place for each
    PortSelection window_for;        ///< ports that it was made for
    PortCompliance compliance;       ///< of the places
    dealii::Vector<double> mismatch; ///< G f - z
    PortSelection selected;          ///< ports it looks at
    PortSelection places;            ///< of them
  };
} // namespace sprag
