#include "fe/field_frames.h"

#include "fe/leaf_body.h"
#include "leaf_beam.h"
#include "mpi_environment.h"

#include <deal.II/base/hdf5.h>

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace sprag;

// A guided leaf bends to an arc of the angle by which its hub turns: E t/2 angle/L at its surfaces, whatever the rotation. The
// stress of the solid differs from that of a beam by about the strain itself. Parabolas in place of the arc stretch by up to
// beta^2/24, beta the angle over an element, the longest of which is 1.7 times the mean one (the grading of meshes/leaf.geo).
TEST(FieldFrames, StressOfATurnedLeafIsThatOfBending)
{
  LeafSpring leaf;
  leaf.end           = LeafEnd::guided;
  leaf.poisson_ratio = 0.;
  LeafBody body(leaf, PlaneState::stress);
  const double turn = 0.2;
  const auto state  = body.steps(body.rest(), turn).back();
  const auto folder = std::filesystem::temp_directory_path() / ("sprag-leaf-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  FieldFrames(body.body(), folder.string()).write(state.displacement, 0.);

  dealii::HDF5::File file((folder / "fields-0000.h5").string(), dealii::HDF5::File::FileAccessMode::open);
  const auto nodes    = file.open_dataset("nodes").read<dealii::FullMatrix<double>>();
  const auto stress   = file.open_dataset("von_mises_stress").read<dealii::FullMatrix<double>>();
  const double strain = 0.5 * leaf.thickness * turn / leaf.length;
  const double beta   = 1.7 * turn / leaf_elements(leaf).along;
  unsigned int found  = 0;
  for (unsigned int i = 0; i < stress.m(); ++i)
    if (std::abs(std::abs(nodes(i, 1)) - 0.5 * leaf.thickness) < 1e-5)
    {
      EXPECT_NEAR(stress(i, 0), leaf.young_modulus * strain, leaf.young_modulus * (2. * strain * strain + beta * beta / 24.))
          << "at " << nodes(i, 0);
      ++found;
    }
  EXPECT_GE(found, 4 * leaf_elements(leaf).along);
  std::filesystem::remove_all(folder);
}
