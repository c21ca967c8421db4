#pragma once

#include "fe/field_frames.h"
#include "fe/leaf_body.h"

#include <string>

namespace sprag
{
  /// Fields of a scene's leaf spring, `folder`/leaf-0000.h5, ...: in the axes of the lever at rest, in equilibrium at the turn of
  /// the hub; its vibrations are left out.
  class LeafFrames
  {
  public:
    LeafFrames(const Scene &scene, const std::string &folder);

    /// Adds a frame. `theta` [rad] is the inclination of the lever at its hub, `time` [s]. None where no equilibrium is found: a
    /// frame less must not end a run.
    void write(double theta, double time);

  private:
    const double rest_inclination;
    LeafBody leaf;
    FieldFrames frames;
  };
} // namespace sprag
