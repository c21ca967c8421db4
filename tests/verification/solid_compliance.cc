// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/solid_run.h"

using namespace sprag;

namespace
{
  /// Displacements of all degrees of freedom by a unit force on one.
  std::vector<double> response(const SolidBody &body, const unsigned int dof)
  {
    std::vector<double> result(body.n_dofs(), 0.);
    result[dof] = 1.;
    body.respond(result);
    return result;
  }
} // namespace

// Columns of nodes that are alike are solved for once, beside a mesh whose lengths change along the face some others by the rows
// of those; a block in the wrong place or the wrong way round is far beyond what the smooth part leaves out. The ends of the face
// are not looked at: no contact is admitted there.
TEST(SolidCompliance, BetweenDofsItIsThatOfTheWholeBody)
{
  Scene scene                 = solid_model_a(0.3);
  scene.mesh.faces_in_contact = 4.; // shorter ones at the beginning of the way
  Mesh plane;
  make_mesh(scene, plane);
  const SolidBody body(scene, plane);
  ASSERT_TRUE(body.has_near_layer());
  const auto &nodes  = body.friction_face().nodes;
  const double begin = nodes.front().position[0] + 4. * body.near_layer_depth(),
               end   = nodes.back().position[0] - 4. * body.near_layer_depth();
  DofSelection inner;
  for (unsigned int dof = 0; dof < 3 * nodes.size(); ++dof)
    if (const double xi = nodes[dof / 3].position[0]; xi > begin && xi < end)
      inner.push_back(dof);
  LayeredCompliance compliance(body, begin, end);
  const auto found = compliance.among(inner);

  const auto inner_dof = [&](const unsigned int place) { return nodes[inner[place] / 3].dofs[inner[place] % 3]; };
  double worst = 0., largest = 0.;
  for (unsigned int column = 1; column < inner.size(); column += 31) // by and by in all directions and places across
    if (!body.is_held(inner_dof(column)))
    {
      const auto exact = response(body, inner_dof(column));
      for (unsigned int row = 0; row < inner.size(); ++row)
      {
        worst   = std::max(worst, std::abs(exact[inner_dof(row)] - found(row, column)));
        largest = std::max(largest, std::abs(exact[inner_dof(row)]));
      }
    }
  EXPECT_LT(worst, 5e-4 * largest);
}
