// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/shared_writing.h"

#include "base/errors.h"
#include "mpi_environment.h"
#include "results/hdf5.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace sprag;

namespace
{
  constexpr std::size_t rows = 2 * hdf5::rows_together + 5, width = 3;

  std::vector<float> numbers()
  {
    std::vector<float> result(rows * width);
    std::iota(result.begin(), result.end(), 1.f);
    return result;
  }
} // namespace

// The test robustness/ranks.py compares files of several processes with this one.
TEST(SharedWriting, RowsOfSeveralChunksAreReadBackAsTheyWere)
{
  const TemporaryFolder folder;
  const std::string path = folder.path / "rows.h5";
  const auto values      = numbers();
  {
    const auto file = hdf5::create_file(path);
    hdf5::create_rows<float>(file, "some", rows, width);
    hdf5::create_rows<float>(file, "none", 0, 1);
  }
  write_rows(path, { { "/some", rows, width * sizeof(float), values.data() }, { "/none", 0, sizeof(float), nullptr } }, {});

  const auto file = hdf5::open_to_read(path);
  const hdf5::Handle some(H5Dopen2(file.id(), "some", H5P_DEFAULT), H5Dclose);
  std::vector<float> found(values.size());
  ASSERT_GE(H5Dread(some.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, found.data()), 0);
  EXPECT_EQ(found, values);
}

TEST(SharedWriting, AFileThatIsGoneIsTold)
{
  const TemporaryFolder folder;
  const std::string path = folder.path / "gone.h5";
  try
  {
    write_rows(path, {}, {});
    FAIL();
  }
  catch (const AnalysisError &error)
  {
    EXPECT_NE(std::string(error.what()).find(path + ": No such file"), std::string::npos) << error.what();
  }
}
