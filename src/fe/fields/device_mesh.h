// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/body_fields.h"
#include "fe/fields/field_files.h"
#include "results/columns.h"

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <cmath>

namespace sprag
{
  /// Axes of a part as they stand in the world: x along the cylinder's path towards the pivot, y up, z along zeta, the origin at
  /// the cylinder's centre for x = 0. Those of a lever inclined by theta are d = (-cos theta, sin theta, 0) and n = (sin theta,
  /// cos theta, 0); a pair's second lever has them mirrored at y = 0, the second half of a symmetric lever its third at z = 0.
  struct WorldAxes
  {
    dealii::Point<3> origin;       ///< [mm]
    dealii::Tensor<1, 3> along;    ///< d
    dealii::Tensor<1, 3> across;   ///< n
    dealii::Tensor<1, 3> sideways; ///< of zeta

    dealii::Tensor<1, 3> turned(const dealii::Tensor<1, 3> &vector) const
    {
      return vector[0] * along + vector[1] * across + vector[2] * sideways;
    }

    dealii::Point<3> place(const dealii::Tensor<1, 3> &position) const
    {
      return origin + turned(position);
    }

    dealii::SymmetricTensor<2, 3> turned(const dealii::SymmetricTensor<2, 3> &stress) const
    {
      dealii::Tensor<2, 3> axes;
      for (unsigned int i = 0; i < 3; ++i)
        axes[i] = dealii::Tensor<1, 3>({ along[i], across[i], sideways[i] });
      return symmetrize(axes * dealii::Tensor<2, 3>(stress) * transpose(axes));
    }

    bool are_left_handed() const
    {
      return cross_product_3d(along, across) * sideways < 0.;
    }
  };

  /// Makes axes of a lever. `side` is 1, or -1 for a pair's second lever; `origin` as it is seen from the first's side.
  inline WorldAxes world_axes(const dealii::Point<2> &origin, const double theta, const double side)
  {
    WorldAxes result;
    result.origin   = dealii::Point<3>(origin[0], side * origin[1], 0.);
    result.along    = dealii::Tensor<1, 3>({ -std::cos(theta), side * std::sin(theta), 0. });
    result.across   = dealii::Tensor<1, 3>({ std::sin(theta), side * std::cos(theta), 0. });
    result.sideways = dealii::Tensor<1, 3>({ 0., 0., 1. });
    return result;
  }

  struct Device;

  /// Pose of the parts of the apparatus, see WorldAxes.
  struct DevicePose
  {
    double x       = 0.;           ///< of the cylinder [mm]
    double support = 0.;           ///< displacement of the pivot frame along x [mm]
    std::array<double, 2> theta{}; ///< of each lever [rad]
  };

  /// Returns the pose at rest: x = 0, no lever turned, the pivot frame where it is without force.
  DevicePose rest_pose(const Device &device);

  DevicePose to_pose(const Row &row);

  /// Returns the axes of an elastic cylinder's mesh: at the cylinder's centre, parallel to those of the lever that presses on it,
  /// through which its material passes.
  WorldAxes cylinder_axes(const Device &device, const DevicePose &pose, unsigned int lever);

  /// The parts of the apparatus in pictures.
  enum class DevicePart
  {
    lever,    ///< with layer and plate
    cylinder, ///< an elastic one
    leaf,
    rigid_cylinder ///< not meshed: a disc, in space with its length and profile
  };

  /// Nodes and cells of one part that belong to one lever.
  struct DeviceBlock
  {
    DevicePart part;
    unsigned int lever;
    bool is_mirrored = false;                  ///< the other half of a lever that is symmetric over its width
    std::vector<unsigned int> nodes{};         ///< numbers among the BodyFields' nodes
    std::vector<dealii::Point<3>> positions{}; ///< of those, in the axes of the part
    std::vector<unsigned int> cells{};         ///< numbers among these nodes, as BodyFields has them
  };

  /// Returns lever, cylinder and, where one is given, leaf spring, each for every lever of the scene, as blocks of one mesh. Of
  /// an elastic cylinder between two levers, which is meshed for each of them, each has the half that faces it. A lever of which
  /// a half is solved is there with its mirror image.
  std::vector<DeviceBlock> device_blocks(const Device &device, const BodyFields &body, const BodyFields *leaf);

  /// Returns the axes of a block. A leaf spring's are those of the lever.
  WorldAxes block_axes(const Device &device, const DevicePose &pose, const DeviceBlock &block);

  /// Returns the mesh of the blocks in a pose, with `part` (material_id) and `lever` (1 or 2, 0 of a rigid cylinder).
  FieldMesh device_mesh(const Device &device, const DevicePose &pose, const std::vector<DeviceBlock> &blocks,
                        const BodyFields &body, const BodyFields *leaf);

  void append(const dealii::Tensor<1, 3> &vector, std::vector<float> &values);
} // namespace sprag
