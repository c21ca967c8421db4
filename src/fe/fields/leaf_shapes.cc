#include "fe/fields/leaf_shapes.h"

#include "base/errors.h"

#include <cmath>

namespace sprag
{
  LeafShapes::LeafShapes(const Scene &scene)
      : leaf(scene.spring.leaf, scene.analysis.plane)
      , of_body(leaf.body())
      , rest(leaf.rest())
  {
  }

  std::optional<dealii::Vector<double>> LeafShapes::displacement(const double turn)
  {
    const double least = 1e-9; // moves no point by more than a picture could show
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
} // namespace sprag
