// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/shared_writing.h"

#include <map>
#include <string>
#include <vector>

namespace sprag
{
  /// Numbers at the nodes of a mesh, `components` a node.
  struct Field
  {
    std::string name; ///< ParaView shows it with the unit behind it
    std::string unit; ///< "1" where dimensionless
    std::string description;
    unsigned int components = 1; ///< 1: scalar, 3: vector, 9: tensor by rows
    std::vector<float> values;
  };

  /// Cells of one kind.
  struct FieldMesh
  {
    std::string name;                        ///< of its index: `name`.xdmf
    std::vector<double> nodes;               ///< x, y and z of each [mm]
    std::vector<unsigned int> cells;         ///< numbers of the nodes of each
    unsigned int nodes_per_cell = 4;         ///< 2: lines, 4: quadrilaterals, 8: hexahedra
    std::vector<Field> fixed;                ///< the same in every frame
    std::vector<unsigned int> rigid_cells{}; ///< others, which have vectors alone: ParaView shows them grey

    std::size_t n_nodes() const
    {
      return nodes.size() / 3;
    }
  };

  /// Names and values of a frame as a whole, attributes of its file and data of the grid in ParaView.
  struct FrameFact
  {
    std::string name;
    std::string unit;
    double value;
  };

  /// Storage of frames. Long runs write a file for each, so that written ones are never touched again.
  enum class FrameStorage
  {
    files,   ///< `name`-mesh.h5, and `name`-0000.h5, ... in the order of writing
    one_file ///< `name`.h5, a group each
  };

  /// Fields on meshes that do not change, frame by frame, for ParaView: meshes and the fields of each frame on each of them, and
  /// an XDMF index a mesh which lists the frames in the order of time. A time has one grid, or two with one of what is rigid.
  /// The rigid one comes first and has no scalars: ParaView opens with those of the other in colour. Throws AnalysisError when a
  /// file cannot be written.
  class FieldFiles
  {
  public:
    /// Writes the meshes and empty indices, as the frames with the help of other processes.
    FieldFiles(std::string folder, std::string name, std::vector<FieldMesh> meshes, FrameStorage storage = FrameStorage::files,
               Writers writers = {});

    /// Adds a frame, or replaces that of the same time [s]: fields of each mesh, in the order of the meshes.
    void write(double time, const std::vector<std::vector<Field>> &fields, const std::vector<FrameFact> &facts = {});

    /// Serialises what says which frames there are. Taken from an archive, later frames are removed; throws AnalysisError where
    /// one of them is gone. To be used with FrameStorage::files.
    void serialise_progress(Archive &archive);

  private:
    /// Collects what the index file (XDMF) of one mesh says.
    struct Index
    {
      std::string path;
      FieldMesh mesh;
      std::map<double, std::string> grids = {}; ///< of the frames written, by their time [s]
    };

    std::string mesh_file() const;
    std::string frame_file(unsigned int frame) const;
    std::string grid(const Index &index, double time, const std::string &place, const std::vector<Field> &fields,
                     const std::vector<FrameFact> &facts) const;
    std::string block(const FieldMesh &mesh, bool rigid, const std::string &time, const std::string &place,
                      const std::vector<Field> &fields, const std::vector<FrameFact> &facts) const;

    const std::string folder;
    const std::string name;
    const FrameStorage storage;
    const Writers writers;
    std::vector<Index> indices;
    unsigned int n_frames = 0;
  };
} // namespace sprag
