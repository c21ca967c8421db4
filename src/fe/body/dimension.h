// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

namespace sprag
{
  template <int dim>
  class ElasticBody;

  // Runs have two dimensions. Outside of fe nothing says so but these names.
  using Mesh      = dealii::Triangulation<2>;
  using MeshPoint = dealii::Point<2>;
  using Body      = ElasticBody<2>;
} // namespace sprag
