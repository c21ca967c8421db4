#include "fe/solid/solid_lever.h"

#include "run_scene.h"
#include "scene/closed_form.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Model A on a coarse mesh without contraction, so that the plane is exact, in three dimensions.
  Scene solid_model_a(const double poisson_ratio)
  {
    Scene scene               = with_face_size(model_a(), 4.);
    scene.analysis.dimension  = 3;
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = poisson_ratio;
    scene.mesh.elements_across                            = 4;
    scene.drive                                           = Drive(DriveProfile::triangle, 0., 20., 112., 1.);
    return scene;
  }

  Scene tilted(Scene scene, const double tilt, const double skew = 0.)
  {
    scene.cylinder.tilt = tilt;
    scene.cylinder.skew = skew;
    return scene;
  }

  /// A run in three dimensions.
  struct SolidRun
  {
    explicit SolidRun(const Scene &scene)
    {
      Mesh plane;
      make_mesh(scene, plane);
      const SolidBody body(scene, plane, MPI_COMM_SELF);
      SolidLever lever(body, scene);
      run_quasi_static(lever, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                       [&](const State &state, const Row &row)
                       {
                         rows.push_back(row);
                         if (rows.size() == 10)
                           exactness = lever.exactness({ lever.sample(state) });
                       });
    }

    std::vector<Row> rows;
    SolidLever::Exactness exactness{};
  };

  double largest(const std::vector<Row> &rows, const Column column)
  {
    double result = 0.;
    for (const auto &row : rows)
      result = std::max(result, std::abs(row[column]));
    return result;
  }

  /// Of a column, over its largest value.
  double difference(const std::vector<Row> &a, const std::vector<Row> &b, const Column column)
  {
    EXPECT_EQ(a.size(), b.size());
    double result = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      result = std::max(result, std::abs(a[i][column] - b[i][column]));
    return result / largest(a, column);
  }
} // namespace

TEST(SolidLever, WithoutContractionItIsPlaneStress)
{
  const Scene scene = solid_model_a(0.);
  Scene plane       = scene;
  plane.analysis    = {};
  const SolidRun solid(scene);
  const auto rows = run_scene(plane);
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::friction_work })
    EXPECT_LT(difference(rows, solid.rows, column), 1e-6) << column_info(column).name;
  EXPECT_LT(solid.exactness.displacement, 1e-5);
}

TEST(SolidLever, OneHalfIsEnoughWhereBothAreAlike)
{
  const Scene scene = solid_model_a(0.3);
  const SolidRun half(scene), whole(tilted(scene, 1e-12));
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::largest_pressure, Column::elastic_energy })
    EXPECT_LT(difference(half.rows, whole.rows, column), 1e-6) << column_info(column).name;
}

TEST(SolidLever, AMirroredTiltGivesTheMirrorImage)
{
  const Scene scene = solid_model_a(0.3);
  const SolidRun one(tilted(scene, 2e-4)), other(tilted(scene, -2e-4));
  for (const Column column : { Column::P, Column::Q, Column::theta })
    EXPECT_LT(difference(one.rows, other.rows, column), 1e-6) << column_info(column).name;
  ASSERT_EQ(one.rows.size(), other.rows.size());
  const auto &last = one.rows[15], &mirrored = other.rows[15];
  EXPECT_GT(last.across[1], 1.); // zeta of the centre of pressure, towards the side that the axis comes closer to
  EXPECT_NEAR(last.across[1], -mirrored.across[1], 1e-4);
  EXPECT_NEAR(last.across[2], -mirrored.across[2], 1e-4 * last.across[2]);
}

// The spring carries the moment of all forces on the face about the pivot, k (theta - theta_0) = P s - F e, but for what the
// face's own displacements turn of it.
TEST(SolidLever, MomentsBalanceAboutThePivot)
{
  const Scene scene = tilted(solid_model_a(0.3), 2e-4, 1e-3);
  const SolidRun run(scene);
  const double rest = kinematics(scene.geometry, 0.).theta;
  for (const auto &row : run.rows)
    if (row[Column::P] > 0.1)
    {
      const double moment = scene.spring.stiffness * (row[Column::theta] - rest);
      EXPECT_NEAR(row[Column::P] * row[Column::s] + row[Column::F] * scene.geometry.interface_offset, moment, 2e-3 * moment);
    }
}
