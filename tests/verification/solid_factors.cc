// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/solid_body.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/solid_run.h"

#include <filesystem>
#include <unistd.h>

using namespace sprag;

// Factors in files against those in memory, and against the stiffness of the cells.

namespace
{
  Scene tilted_model_a()
  {
    return tilted(solid_model_a(0.3), 2e-4);
  }

  /// A force at one node of the friction face in each direction, there and at another.
  SparseColumns forces_on_face(const SolidBody &body)
  {
    const auto &nodes = body.friction_face().nodes;
    SparseColumns result;
    for (const std::size_t node : { nodes.size() / 5, nodes.size() / 2 })
      for (const unsigned int dof : nodes[node].dofs)
      {
        result.add(dof, 1.);
        result.end_column();
      }
    return result;
  }

  double magnitude(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  /// Largest difference over the largest value.
  double difference(std::vector<double> a, const std::vector<double> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    const double size = magnitude(a);
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i] -= b[i];
    return magnitude(a) / size;
  }

  TEST(SolidFactors, InFilesFindTheSameAndLeaveNothing)
  {
    namespace fs      = std::filesystem;
    const auto folder = fs::temp_directory_path() / ("sprag-factors-" + std::to_string(::getpid()));
    const Scene scene = tilted_model_a();
    const MadeMesh plane(scene);
    const SolidBody in_memory(scene, plane);
    fs::create_directories(folder);
    {
      const SolidBody body(scene, plane, folder.string());
      EXPECT_FALSE(fs::is_empty(folder));
      EXPECT_LT(difference(in_memory.respond(forces_on_face(in_memory)), body.respond(forces_on_face(body))), 1e-10);
    }
    EXPECT_TRUE(fs::is_empty(folder));
    fs::remove_all(folder);
  }

} // namespace
