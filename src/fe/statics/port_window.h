// SPDX-License-Identifier: GPL-3.0-only
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
    std::function<PortSelection(const PortSelection &)> whole_blocks; ///< those that hold some ports
    std::function<std::shared_ptr<const dealii::FullMatrix<double>>(const PortSelection &whole_blocks)> among; ///< [mm/N]
  };

  /// Linear levers on linear springs in statics, seen through their ports, z = G f(z). The compliance G is dense on the faces of
  /// a lever and diagonal on hubs and support, which do not move a body in its own axes, and on the cylinder's slopes. It is
  /// known in a window of whole tiles, which moves where other ports are looked at. Only ports with forces carry tangents, so
  /// that a Newton correction is a dense solve of those, and the iterates are those of the full system. Coordinates:
  /// displacements of all ports. `near` are the ports that are looked at, which increase and hold those of the forces, of hubs
  /// and of the support.
  class PortWindow
  {
  public:
    static constexpr bool looks_at_some = true;

    /// The faces of a lever in the order of their ports, the same for both of a pair.
    PortWindow(const PortLayout &ports, const PortSprings &springs, std::vector<FaceResponse> faces);

    unsigned int n_coordinates() const;

    /// Index of the coordinate of a port.
    unsigned int coordinate(unsigned int port) const;

    const dealii::Vector<double> &port_displacements(const dealii::Vector<double> &coordinates) const;

    /// Sets the displacements of those ports of the faces that are looked at to G f.
    void set_faces(const PortLoads &forces, const PortSelection &near, dealii::Vector<double> &coordinates);

    /// Returns G f - z. `face_displacements`: displacements of the faces in place of G f, on all their ports, of a body that is
    /// not linear.
    Residual residual(const dealii::Vector<double> &coordinates, const PortForces &forces, const PortSelection &near,
                      const dealii::Vector<double> *face_displacements = nullptr);

    /// Returns the correction, 0 on ports that are not looked at. Throws AnalysisError if the tangent is singular.
    dealii::Vector<double> correction(const Residual &residual, const PortForces &forces, const PortSelection &near);

    /// Visits where the window is.
    void visit_history(Archive &archive);

  protected:
    /// Returns the forces on the surface of a lever, with the numbers that its ports have alone.
    PortLoads on_surface(const PortLoads &forces, unsigned int lever) const;

    const PortLayout ports;

  private:
    void move_window(const PortSelection &selected);
    PortSelection find_indices(const PortSelection &selected) const;
    PortSelection look_at(const PortSelection &near);

    const PortSprings springs;
    const std::vector<FaceResponse> faces;

    PortSelection window;      ///< ports that the compliance is known of, a place for each
    PortSelection window_for;  ///< ports that it was made for
    PortCompliance compliance; ///< of the places
  };
} // namespace sprag
