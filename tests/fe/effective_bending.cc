// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/effective_bending.h"

#include "fe/bar.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double E = 70000.;

  Bar slender()
  {
    Bar bar;
    bar.length = 60.;
    bar.layer  = 0.;
    bar.n      = 60;
    return bar;
  }
} // namespace

/// A layer as stiff as the metal is metal.
TEST(EffectiveBending, CountsALayerThatCarries)
{
  Bar bar   = slender();
  bar.layer = 0.5;
  dealii::Triangulation<2> triangulation;
  make_bar(bar, triangulation);
  auto properties                          = bar_properties(bar, 0.3);
  properties.constants[material_id::layer] = properties.constants[material_id::lever];
  const auto found                         = effective_bending(ElasticBody<2>(triangulation, properties), 30., 60.);
  const double EI                          = E * bar.width * std::pow(bar.depth + bar.layer, 3) / 12.;
  EXPECT_NEAR(found.stiffness, EI, 6e-3 * EI);
  EXPECT_NEAR(found.neutral_axis_offset, bar.offset + 0.5 * (bar.depth + bar.layer), 5e-3 * bar.depth);
}
