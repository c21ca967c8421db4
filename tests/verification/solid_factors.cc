// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "fe/solid/solid_body.h"
#include "scene/scene.h"
#include "verification/solid_run.h"

#include <filesystem>
#include <limits>
#include <unistd.h>

using namespace sprag;

// Factors of single precision, in files or in memory, against those of double precision.

namespace
{
  Scene tilted_model_a()
  {
    return tilted(solid_model_a(0.3), 2e-4);
  }

  /// A force at one node of the friction face in each direction, there and at another.
  SparseColumns forces_on_face(const SolidBody &body, const bool near)
  {
    const auto &nodes = body.friction_face().nodes;
    SparseColumns result;
    for (const std::size_t node : { nodes.size() / 5, nodes.size() / 2 })
      for (const unsigned int dof : nodes[node].dofs)
      {
        result.add(near ? static_cast<unsigned int>(body.number_near(dof)) : dof, 1.);
        result.end_column();
      }
    return result;
  }

  double size_of(const std::vector<double> &values)
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
    const double size = size_of(a);
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i] -= b[i];
    return size_of(a) / size;
  }

  struct Responses
  {
    std::vector<double> whole, dense, near;
  };

  Responses responses_with(const FactorSettings &settings)
  {
    const Scene scene = tilted_model_a();
    Mesh plane;
    make_mesh(scene, plane);
    const SolidBody body(scene, plane, settings);
    EXPECT_TRUE(body.has_skin());
    std::vector<double> load(body.n_dofs(), 0.);
    load[body.friction_face().nodes.front().dofs[1]] = 1e-12; // far below what single precision tells from nothing
    body.respond(load);
    return { body.respond(forces_on_face(body, false)), load, body.respond_near(forces_on_face(body, true)) };
  }

  /// What is refined misses 2e-9 at most, the factors of double precision themselves some 1e-11.
  TEST(SolidFactors, OfSinglePrecisionFindWhatPreciseOnesFind)
  {
    const auto precise = responses_with({ false, {} }), single = responses_with({ true, {} });
    EXPECT_LT(difference(precise.whole, single.whole), 2e-9);
    EXPECT_LT(difference(precise.dense, single.dense), 2e-9);
    EXPECT_LT(difference(precise.near, single.near), 2e-9);
  }

  TEST(SolidFactors, InFilesFindTheSameAndLeaveNothing)
  {
    namespace fs         = std::filesystem;
    const auto folder    = fs::temp_directory_path() / ("sprag-factors-" + std::to_string(::getpid()));
    const auto in_memory = responses_with({ true, {} });
    fs::create_directories(folder);
    {
      const Scene scene = tilted_model_a();
      Mesh plane;
      make_mesh(scene, plane);
      const SolidBody body(scene, plane, { true, folder.string() });
      EXPECT_FALSE(fs::is_empty(folder));
      EXPECT_LT(difference(in_memory.whole, body.respond(forces_on_face(body, false))), 1e-10);
    }
    EXPECT_TRUE(fs::is_empty(folder));
    fs::remove_all(folder);
  }

  /// Where pivots vanish in single precision, nothing sensible comes of it; the body then takes double precision.
  TEST(SolidFactors, ThatFindNoNumbersAreKnown)
  {
    const Scene scene = tilted_model_a();
    Mesh plane;
    make_mesh(scene, plane);
    const SolidBody body(scene, plane, { false, {} });
    const auto nothing = [](const std::vector<double> &loads)
    { return std::vector<float>(loads.size(), std::numeric_limits<float>::quiet_NaN()); };
    const dealii::AffineConstraints<double> free;
    Refinement refinement({ body.cell_mapping(), body.dofs(), free, body.body_properties() }, {}, {}, nothing);
    std::vector<double> loads(body.n_dofs(), 1.);
    EXPECT_FALSE(refinement.find_soft_motions(loads));
    EXPECT_THROW(refinement.refined(loads, nothing(loads)), AnalysisError);
  }

  /// Stiffness times the displacements is the load: assembly and what refines by its cells know the same stiffness.
  TEST(SolidFactors, WhatIsLeftOfALoadIsFoundByTheCells)
  {
    const Scene scene = tilted_model_a();
    Mesh plane;
    make_mesh(scene, plane);
    const SolidBody body(scene, plane, { false, {} });
    dealii::AffineConstraints<double> held;
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      if (body.is_held(dof))
        held.add_line(dof);
    held.close();
    const StiffnessProduct stiffness({ body.cell_mapping(), body.dofs(), held, body.body_properties() }, {}, {});
    std::vector<double> left(body.n_dofs(), 0.);
    left[body.friction_face().nodes.front().dofs[0]] = 1.;
    auto displacements                               = left;
    body.respond(displacements);
    stiffness.subtract(displacements, left);
    EXPECT_LT(size_of(left), 1e-8);
  }
} // namespace
