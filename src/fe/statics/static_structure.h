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

#include <map>
#include <utility>

namespace sprag
{
  /// Compliance of a face in a plane, as entries of the inverse of the stiffness.
  class SurfaceCompliance : public FaceCompliance
  {
  public:
    /// `stiffness`: factors of the body's symmetric stiffness. `dofs`: degrees of freedom of the body, by their places on the
    /// face.
    SurfaceCompliance(std::shared_ptr<const Mumps> stiffness, std::vector<unsigned int> dofs);

    /// Those blocks found together are found together again: the solver's round-off depends on that.
    void serialise_history(Archive &archive) override;

  protected:
    void find_blocks(const std::vector<BlockPair> &pairs) override;

    dealii::FullMatrix<double> block(const BlockPair &rows_and_columns) override
    {
      return blocks.at(rows_and_columns);
    }

  private:
    double &entry(unsigned int row, unsigned int column);
    void find(const std::vector<BlockPair> &needed);

    const std::shared_ptr<const Mumps> factors;
    const std::vector<unsigned int> body_dofs;
    std::map<unsigned int, unsigned int> surface_dof_map;
    std::map<BlockPair, dealii::FullMatrix<double>> blocks;
    std::vector<std::vector<BlockPair>> searches; ///< the blocks found together
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

  private:
    StaticStructure(const ElasticBody<2> &body, const std::shared_ptr<const Mumps> &factors, const InterfaceLayout &layout,
                    const JointSprings &springs);

    const ElasticBody<2> &body;
    const std::shared_ptr<const Mumps> factors;
    const SensorForces sensors;
  };
} // namespace sprag
