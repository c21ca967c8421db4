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
    /// `of_lever`: layout of either structure.
    explicit MirroredPorts(const PortLayout &of_lever);

    /// The layout of the pair.
    const PortLayout &layout() const;

    /// Share of a structure's motion in each lever's: 1/sqrt(2), apart from the sign of the second lever's.
    static double share();

    /// Ports of a structure that ports of the pair depend on.
    PortSelection of_structure(const PortSelection &of_pair) const;

    /// Displacements of the pair's ports from those of both structures.
    dealii::Vector<double> displacements(const dealii::Vector<double> &mirroring, const dealii::Vector<double> &opposite) const;

    /// State of a port of the pair by that of the structures' port, see port_of_structure().
    PortState state(unsigned int port_of_pair, const PortState &mirroring, const PortState &opposite) const;

    unsigned int port_of_structure(unsigned int port_of_pair) const;

    /// Forces on the pair's ports as those on a structure's, without their tangent.
    PortForces forces(const PortForces &of_pair, unsigned int motion) const;

    /// Compliance of the pair's ports. `alike`: whether both structures answer alike, so that levers feel nothing of each other.
    PortCompliance compliance(const PortCompliance &mirroring, const PortCompliance &opposite, bool alike) const;

    /// Linear forces on the ports of both structures, those of the opposite motion counted on from the number of the other's.
    PortPerturbation on_both(const PortPerturbation &of_pair) const;

    /// Returns true if forces of on_both() couple the structures by more than round-off, as the levers' forces do not mirror.
    bool couples(const PortPerturbation &on_both) const;

    /// Linear forces on one structure, where forces mirror as the levers do. `both`: on_both() of them.
    PortPerturbation on_structure(const PortPerturbation &of_pair, const PortPerturbation &both, unsigned int motion) const;

  private:
    PortLayout pair;

    unsigned int structure_size() const;
    bool is_support(unsigned int port_of_pair) const;
    dealii::FullMatrix<double> displacements_by(const std::vector<unsigned int> &of_both,
                                                const std::vector<unsigned int> &of_pair) const;
    std::pair<unsigned int, unsigned int> range(const PortPerturbation &both, unsigned int motion) const;
    bool is_of_first_lever(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const;
  };
} // namespace sprag
