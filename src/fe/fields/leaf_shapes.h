// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "fe/fields/body_fields.h"
#include "fe/leaf/leaf_body.h"
#include "scene/scene.h"

#include <cmath>
#include <optional>

namespace sprag
{
  struct Scene;

  /// Shapes of a scene's leaf spring, in the axes of the lever at rest: in equilibrium at a turn of the hub, its vibrations left
  /// out.
  class LeafShapes
  {
  public:
    explicit LeafShapes(const Scene &scene)
        : leaf(scene.spring.leaf, scene.spring.leaf.plane)
        , of_body(leaf.body())
        , rest(leaf.rest())
    {
    }

    const BodyFields &fields() const
    {
      return of_body;
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
    const BodyFields of_body;
    const LeafBody::State rest;
  };
} // namespace sprag
