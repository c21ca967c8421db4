#pragma once

#include "fe/body/elastic_body.h"
#include "fe/statics/port_window.h"
#include "fe/statics/surface_compliance.h"
#include "model/port_layout.h"

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

    /// Displacement of the whole body of a lever under forces on the ports, by one back-substitution.
    dealii::Vector<double> body_displacement(unsigned int lever, const dealii::Vector<double> &coordinates,
                                             const PortLoads &forces) const;

    /// Forces of the sensors of a lever [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &coordinates,
                                      const PortLoads &forces) const;

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
