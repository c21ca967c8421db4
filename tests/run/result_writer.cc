// SPDX-License-Identifier: GPL-3.0-only
#include "program/result_writer.h"

#include "base/archive.h"
#include "base/version.h"
#include "mpi_environment.h"
#include "program/checkpoint.h"
#include "program/output_folder.h"
#include "results/hdf5.h"
#include "scenes.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const std::vector<ColumnInfo> columns = { { "x", "mm", "position" } };
} // namespace

TEST(Checkpoint, OfABuildWithOtherFieldsIsNone)
{
  const TemporaryFolder folder;
  std::string first = "a text more", key = "0123456789abcdef";
  std::size_t rows = 10;
  Archive archive;
  archive(first, key, key, rows, key);
  folder.write(checkpoint_name, sealed(archive.bytes()));
  EXPECT_FALSE(has_checkpoint(folder.path, model_a()));
}
