// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/algebra/mumps.h"
#include "fe/body/elastic_body.h"
#include "fe/statics/sensor_forces.h"
#include "fe/statics/static_interface.h"
#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"
#include "results/columns.h"

#include <array>
#include <map>
#include <utility>

namespace sprag
{
  /// Compliance between the displacements of a face's nodes, the body held at its hub [mm/N]. A contact meets few of them at a
  /// time: the compliance is found in blocks, where it is asked for, as entries of the inverse of the stiffness, and kept.
  class SurfaceCompliance
  {
  public:
    /// `stiffness`: factors of the body's symmetric stiffness, which must outlive this. `dofs`: degrees of freedom of the body,
    /// by their places on the face.
    SurfaceCompliance(const Mumps &stiffness, std::vector<unsigned int> dofs);

    /// Returns the dofs of the blocks that hold some of the face's, increasing.
    DofSelection whole_blocks(const DofSelection &surface_dofs) const;

    /// Returns the compliance between some dofs, which make up whole blocks.
    dealii::FullMatrix<double> among(const DofSelection &whole_blocks);

    /// Serialises which blocks are known. Those found together are found together again: the solver's round-off depends on that.
    void serialise_history(Archive &archive);

  private:
    using Block = std::pair<unsigned int, unsigned int>; ///< of rows and columns, first >= second

    unsigned int n_block_dofs(unsigned int block) const;
    DofSelection block_dofs(unsigned int block) const;
    double &entry(unsigned int row, unsigned int column);
    void find(const std::vector<Block> &needed);

    const Mumps &factors;
    const std::vector<unsigned int> body_dofs;
    std::map<unsigned int, unsigned int> surface_dof_map;
    std::map<Block, dealii::FullMatrix<double>> blocks;
    std::vector<std::vector<Block>> searches; ///< the blocks found together
  };

  /// Linear levers on linear springs in statics, one or both of a pair, which are alike: factorised once and seen through the
  /// candidate dofs of their interface.
  class StaticStructure : public StaticInterface
  {
  public:
    /// The body must outlive this.
    StaticStructure(const ElasticBody<2> &body, const InterfaceLayout &layout, const JointSprings &springs);

    /// Returns the displacements in each of some states, by one back-substitution.
    std::vector<BodyDisplacements> body_displacements(const std::vector<StaticState> &states) const;

    /// Returns the forces of the sensors of a lever [N].
    std::vector<double> sensor_forces(unsigned int lever, const dealii::Vector<double> &, const DofLoads &forces) const;

    /// Serialises what it knows of the compliance.
    void serialise_history(Archive &archive);

  private:
    const ElasticBody<2> &body;
    const std::vector<unsigned int> surface; ///< the body's degrees of freedom on a lever's faces
    const std::shared_ptr<const Mumps> factors;
    std::array<SurfaceCompliance, 2> faces; ///< of friction face and cylinder's face
    const SensorForces sensors;
  };
} // namespace sprag
