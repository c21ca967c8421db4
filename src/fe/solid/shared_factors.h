// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <dmumps_c.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace sprag
{
  /// The lower triangle of a symmetric matrix, each rank some of its entries. Entries of one place add up.
  struct SymmetricEntries
  {
    unsigned int size = 0; ///< of the matrix
    std::vector<int> row;  ///< from 1, as MUMPS counts
    std::vector<int> column;
    std::vector<double> value;
  };

  /// Some sparse columns, one after another.
  struct SparseColumns
  {
    std::vector<int> begin{ 1 }; ///< of each column among the entries, from 1, and beyond the last
    std::vector<int> row;        ///< from 1
    std::vector<double> value;

    int size() const
    {
      return static_cast<int>(begin.size()) - 1;
    }

    /// Adds an entry to the column under way.
    void add(const unsigned int of_row, const double of_value)
    {
      row.push_back(static_cast<int>(of_row) + 1);
      value.push_back(of_value);
    }

    void end_column()
    {
      begin.push_back(static_cast<int>(row.size()) + 1);
    }
  };

  /// Cholesky factors of a symmetric positive definite matrix that all ranks hold together. MUMPS is called directly: PETSc's
  /// interface to it has no ordering for long bodies and no sparse right-hand sides, which are most of the work here.
  /// All functions throw AnalysisError, naming the status, when a factorisation or solve fails.
  class SharedFactors
  {
  public:
    /// With a folder the factors are kept in files there, which the destructor removes, else in memory.
    explicit SharedFactors(MPI_Comm ranks, const std::string &folder = "");
    SharedFactors(const SharedFactors &)            = delete;
    SharedFactors &operator=(const SharedFactors &) = delete;
    ~SharedFactors();

    /// Factorises. To be called by all ranks; frees the entries.
    void factorise(SymmetricEntries entries);

    /// Solves with some columns, one after another, in place. To be called by the first rank while the others take_part().
    void solve(std::vector<double> &columns) const;

    /// Returns the solutions for sparse columns, one after another, likewise.
    std::vector<double> solve(const SparseColumns &columns) const;

    /// Takes part in a solve of the first rank.
    void take_part() const;

    unsigned int size() const
    {
      return n;
    }

  private:
    void call(int job, const char *what) const;

    mutable DMUMPS_STRUC_C mumps;
    unsigned int n = 0;
  };
} // namespace sprag
