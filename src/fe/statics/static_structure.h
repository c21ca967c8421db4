// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/statics/port_window.h"
#include "fe/statics/surface_compliance.h"
#include "model/port_layout.h"
#include "results/columns.h"

#include <array>

namespace sprag
{
  /// Linear levers on linear springs in statics, one or both of a pair, which are alike: factorised once and seen through a
  /// window of their ports.
  class StaticStructure : public PortWindow
  {
  public:
    /// The body must outlive this.
    StaticStructure(const ElasticBody<2> &body, const PortLayout &ports, const PortSprings &springs);
    StaticStructure(const StaticStructure &)            = delete;
    StaticStructure &operator=(const StaticStructure &) = delete;

    /// Returns the displacement of the whole body of each lever under forces on the ports, by a back-substitution.
    std::vector<dealii::Vector<double>> body_displacements(const dealii::Vector<double> &coordinates,
                                                           const PortLoads &forces) const;

    /// Tells a row the forces of the sensors of a lever [N].
    void tell_sensors(unsigned int lever, const dealii::Vector<double> &coordinates, const PortLoads &forces, Row &row) const;

    /// Visits what it knows of the compliance.
    void visit_history(Archive &archive);

  private:
    void find_sensor_rows();
    dealii::Vector<double> forces_on_faces(unsigned int lever, const PortLoads &forces) const;

    const ElasticBody<2> &body;
    const PortLayout ports;
    const std::vector<unsigned int> surface; ///< degrees of freedom of a lever's ports
    Mumps factors;
    std::array<SurfaceCompliance, 2> faces; ///< of friction face and cylinder's face
    dealii::FullMatrix<double> sensor_rows; ///< force of a sensor by unit forces on a lever's ports
  };
} // namespace sprag
