#pragma once

#include "fe/fields/body_fields.h"
#include "fe/leaf/leaf_body.h"

#include <optional>

namespace sprag
{
  /// Shapes of a scene's leaf spring, in the axes of the lever at rest: in equilibrium at a turn of the hub, its vibrations left
  /// out.
  class LeafShapes
  {
  public:
    explicit LeafShapes(const Scene &scene);

    const BodyFields &fields() const
    {
      return of_body;
    }

    /// Displacement at a turn from rest [rad], the hub's rotation included; none where no equilibrium is found: a picture less
    /// must not end a run.
    std::optional<dealii::Vector<double>> displacement(double turn);

  private:
    LeafBody leaf;
    const BodyFields of_body;
    const LeafBody::State rest;
  };
} // namespace sprag
