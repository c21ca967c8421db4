// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <memory>

namespace sprag
{
  /// Starts MPI, and PETSc with it, before the first case of a test program and ends it after the last: including this file is
  /// enough.
  class MPIEnvironment : public ::testing::Environment
  {
  public:
    void SetUp() override
    {
      static char name[]      = "test";
      static char *pointers[] = { name, nullptr };
      int count               = 1;
      char **arguments        = pointers;
      session                 = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(count, arguments, 1);
    }

    void TearDown() override
    {
      session.reset();
    }

  private:
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> session;
  };

  inline ::testing::Environment *const mpi_environment = ::testing::AddGlobalTestEnvironment(new MPIEnvironment);
} // namespace sprag
