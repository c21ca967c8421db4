// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "base/errors.h"
#include "fe/fields/body_fields.h"
#include "fe/fields/device_mesh.h"
#include "fe/leaf/leaf_body.h"
#include "results/result_file.h"
#include "scene/device.h"

#include <cmath>
#include <memory>
#include <optional>

namespace sprag
{
  struct Device;

  /// Shapes of a scene's leaf spring, in the axes of the lever at rest: in equilibrium at a turn of the hub, its vibrations left
  /// out.
  class LeafShapes
  {
  public:
    explicit LeafShapes(const Device &device)
        : leaf(device.spring.leaf, device.spring.leaf.plane)
        , leaf_fields(leaf.body())
        , rest(leaf.rest())
    {
    }

    const BodyFields &fields() const
    {
      return leaf_fields;
    }

    /// Finds the displacement of the body's degrees of freedom at a turn from rest [rad], the hub's rotation included; none where
    /// no equilibrium is found: a picture less must not end a run.
    std::optional<dealii::Vector<double>> displacement(const double turn)
    {
      constexpr double least = 1e-9; // moves no point by more than a picture could show
      if (std::abs(turn) < least)
        return rest.displacement;
      try
      {
        return leaf.steps(rest, turn).back().displacement;
      }
      catch (const AnalysisError &)
      {
        return {};
      }
    }

  private:
    LeafBody leaf;
    const BodyFields leaf_fields;
    const LeafBody::State rest;
  };

  /// One state of the apparatus.
  struct DeviceState
  {
    double time = 0.; ///< [s]
    DevicePose pose;
    std::vector<dealii::Vector<double>> displacements; ///< elastic, of the body, one a lever, in its axes [mm]
    std::vector<std::vector<NodalField>> nodal;        ///< what BodyFields finds of them
    FaceState face;
  };

  /// Fields of a run for ParaView, frame by frame, in the axes of the world (WorldAxes). Nodes are where they are at rest
  /// (rest_pose()), `displacement` leads from there, rotation included, and `elastic_displacement` is its elastic part alone.
  /// `folder`/fields.xdmf shows the bodies with their stress, `folder`/face.xdmf pressure and traction along the friction faces,
  /// both from fields-mesh.h5 and fields-0000.h5, ...
  class FieldFrames
  {
  public:
    /// Scene and fields, which serve both levers of a pair, must outlive them.
    FieldFrames(const Device &device, const BodyFields &fields, const std::string &folder);

    /// Adds a frame, or replaces that of the same time. `whole`: with all components of the stress.
    void write(const DeviceState &state, bool whole);

    /// Serialises what says which frames there are, see FieldFiles.
    void serialise_progress(Archive &archive)
    {
      files->serialise_progress(archive);
    }

  private:
    struct Bodies;

    std::vector<DeviceBlock> faces() const;
    FieldMesh face_mesh() const;
    std::vector<Field> body_fields(const DeviceState &state, bool whole);
    void add_meshed(const DeviceState &state, const DeviceBlock &block, Bodies &values) const;
    void add_leaf(const DeviceState &state, const DeviceBlock &block, Bodies &values);
    std::vector<Field> face_fields(const DeviceState &state) const;

    const Device &device;
    const BodyFields &fields;
    const DevicePose rest;
    std::unique_ptr<LeafShapes> leaf;
    const std::vector<DeviceBlock> blocks;
    std::unique_ptr<FieldFiles> files;
  };
} // namespace sprag
