// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_model.h"
#include "model/linearisation.h"
#include "model/port_compliance.h"
#include "model/port_layout.h"

#include <utility>

namespace sprag
{
  /// Ports of a mirrored pair as those of two structures of one lever each: of the motion in which the levers mirror each other
  /// (0), and of that in which the second does the opposite (1), each at 1/sqrt(2) of its size for both. A sprung support moves
  /// with the first alone.
  class MirroredPorts
  {
  public:
    /// `lever_compliance`: layout of either structure.
    explicit MirroredPorts(const PortLayout &lever_layout);

    /// The layout of the pair.
    const PortLayout &layout() const;

    /// Share of a structure's motion in each lever's: 1/sqrt(2), apart from the sign of the second lever's.
    static double share();

    /// Ports of a structure that ports of the pair depend on.
    PortSelection structure_ports(const PortSelection &paired) const;

    /// Displacements of the pair's ports from those of both structures.
    dealii::Vector<double> displacements(const dealii::Vector<double> &mirroring, const dealii::Vector<double> &opposite) const;

    /// State of a port of the pair by that of the structures' port, see structure_port().
    PortState state(unsigned int pair_port, const PortState &mirroring, const PortState &opposite) const;

    unsigned int structure_port(unsigned int pair_port) const;

    /// Forces on the pair's ports as those on a structure's, without their tangent.
    PortForces forces(const PortForces &paired, unsigned int motion) const;

    /// Compliance of the pair's ports. `alike`: whether both structures answer alike, so that levers feel nothing of each other.
    PortCompliance compliance(const PortCompliance &mirroring, const PortCompliance &opposite, bool alike) const;

    /// Linear forces on the ports of both structures, those of the opposite motion counted on from the number of the other's.
    PortPerturbation on_both(const PortPerturbation &paired) const;

    /// Returns true if forces of on_both() couple the structures by more than round-off, as the levers' forces do not mirror.
    bool couples(const PortPerturbation &on_both) const;

    /// Linear forces on one structure, where forces mirror as the levers do. `both`: on_both() of them.
    PortPerturbation on_structure(const PortPerturbation &paired, const PortPerturbation &both, unsigned int motion) const;

  private:
    PortLayout pair;

    unsigned int structure_size() const;
    bool is_support(unsigned int pair_port) const;
    dealii::FullMatrix<double> displacements_by(const std::vector<unsigned int> &both_ports,
                                                const std::vector<unsigned int> &paired) const;
    std::pair<unsigned int, unsigned int> range(const PortPerturbation &both, unsigned int motion) const;
    bool acts_on_first_lever(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const;
  };
} // namespace sprag
