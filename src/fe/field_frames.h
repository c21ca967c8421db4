#pragma once

#include "fe/elastic_body.h"

#include <deal.II/base/data_out_base.h>

#include <string>
#include <vector>

namespace sprag
{
  /// Displacement [mm] and von Mises stress [MPa] of a body in lever axes, frame by frame, as HDF5 with an XDMF index for
  /// ParaView: `folder`/fields.xdmf, `folder`/fields-0000.h5, ...
  class FieldFrames
  {
  public:
    /// Removes the frames of an earlier run from `folder`.
    FieldFrames(const ElasticBody<2> &body, std::string folder);

    /// Adds a frame and rewrites the index. `time` [s].
    void write(const dealii::Vector<double> &displacement, double time);

  private:
    const ElasticBody<2> &body;
    const std::string folder;
    std::vector<dealii::XDMFEntry> frames;
  };
} // namespace sprag
