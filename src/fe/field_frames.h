#pragma once

#include "fe/elastic_body.h"

#include <deal.II/base/data_out_base.h>

#include <string>
#include <vector>

namespace sprag
{
  /// Displacement [mm], von Mises stress [MPa] and part (material_id) of a body in the axes of its mesh, frame by frame, as HDF5
  /// with an XDMF index for ParaView: `folder`/fields.xdmf, `folder`/fields-0000.h5, ..., or under another name.
  /// A cell of degree p is p x p quadrilaterals with (p + 1)^2 nodes that it shares with no other. Fields are rounded to single
  /// precision.
  class FieldFrames
  {
  public:
    /// Removes the frames of that name by an earlier run from `folder`. The body must outlive them.
    FieldFrames(const ElasticBody<2> &body, std::string folder, std::string name = "fields");

    /// Adds a frame and rewrites the index. `time` [s].
    void write(const dealii::Vector<double> &displacement, double time);

  private:
    const ElasticBody<2> &body;
    const std::string folder;
    const std::string name;
    dealii::Vector<float> part; ///< of each cell
    std::vector<dealii::XDMFEntry> frames;
  };
} // namespace sprag
