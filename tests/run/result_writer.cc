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

TEST(ResultWriter, AddsStatusAndWhatEveryRunTells)
{
  const TemporaryFolder temporary;
  const std::string folder = temporary.path / "run";
  PhaseTimer timer;
  const Scene scene = model_a();
  ResultWriter writer(scene, { folder, true }, timer, columns);
  writer.append(std::vector<double>{ 1. });
  Warnings warnings;
  const auto end = writer.finish("stopped", { { { "number", 2., "1", "of a test" } }, { { "own", 3., "1", "fact" } } }, warnings);
  EXPECT_EQ(end.summary.size(), 2u);
  EXPECT_EQ(end.meta.front().name, "own");
  EXPECT_GT(end.meta.size(), 5u);
  const auto file = hdf5::open_file(folder + "/result.h5");
  EXPECT_EQ(hdf5::read_text(file, "summary/status"), "stopped");
  EXPECT_EQ(hdf5::read_text(file, "meta/version"), version());
}

TEST(FinishInAnyCase, TellsHowTheStepsEndedAndPassesAFailureOn)
{
  std::string status;
  const auto finish = [&](const std::string &end) { status = end; };
  finish_in_any_case([] {}, finish);
  EXPECT_EQ(status, "completed");
  EXPECT_THROW(finish_in_any_case([] { throw AnalysisError("no solution"); }, finish), AnalysisError);
  EXPECT_EQ(status, "no solution");
}

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
