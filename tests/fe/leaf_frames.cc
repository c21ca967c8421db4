#include "fe/leaf_frames.h"

#include "mpi_environment.h"
#include "scenes.h"

#include <deal.II/base/hdf5.h>

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace sprag;

// The hub turns as the lever does: when theta grows, xi turns towards eta. What is clamped in it turns along as a rigid body, and
// what the joint holds stays where it was.
TEST(LeafFrames, ClampTurnsWithTheLeverFromTheInclinationAtRest)
{
  Scene scene            = model_a();
  scene.spring.type      = SpringType::leaf;
  const LeafSpring &leaf = scene.spring.leaf;
  const double theta_0   = std::asin((56. - 45.6) / 185.5);
  const double turn      = 0.03;
  const auto folder      = std::filesystem::temp_directory_path() / ("sprag-leaf-frames-" + std::to_string(::getpid()));
  const double half      = 0.5 * leaf.thickness;
  const double tolerance = 1e-6 * leaf.length * turn; // single precision, and that of the equilibrium
  std::filesystem::create_directory(folder);
  LeafFrames frames(scene, folder.string());
  frames.write(theta_0, 0.);
  frames.write(theta_0 + turn, 0.5);

  for (const auto &[name, angle] : { std::pair("leaf-0000.h5", 0.), std::pair("leaf-0001.h5", turn) })
  {
    dealii::HDF5::File file((folder / name).string(), dealii::HDF5::File::FileAccessMode::open);
    const auto nodes        = file.open_dataset("nodes").read<dealii::FullMatrix<double>>();
    const auto displacement = file.open_dataset("displacement").read<dealii::FullMatrix<double>>();
    unsigned int clamped = 0, joined = 0;
    for (unsigned int i = 0; i < nodes.m(); ++i)
    {
      const double xi = nodes(i, 0), eta = nodes(i, 1);
      EXPECT_LE(std::abs(eta), half + 1e-6);
      if (std::abs(xi + leaf.clamp_distance) < 1e-6)
      {
        ++clamped;
        EXPECT_NEAR(displacement(i, 0), (std::cos(angle) - 1.) * xi - std::sin(angle) * eta, tolerance);
        EXPECT_NEAR(displacement(i, 1), std::sin(angle) * xi + (std::cos(angle) - 1.) * eta, tolerance);
      }
      else if (std::abs(xi + leaf.clamp_distance + leaf.length) < 1e-6)
      {
        ++joined;
        EXPECT_NEAR(displacement(i, 1), 0., tolerance);
      }
    }
    EXPECT_GE(clamped, 5u);
    EXPECT_GE(joined, 5u);
  }
  std::filesystem::remove_all(folder);
}
