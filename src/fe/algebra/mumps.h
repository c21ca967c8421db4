// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <dmumps_c.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <map>
#include <string>
#include <vector>

namespace sprag
{
  /// Known property of a matrix, by which its factorisation is chosen.
  enum class MatrixKind
  {
    general,           ///< LU
    tangent,           ///< LU without scaling, of Newton's method, which corrects round-off
    positive_definite, ///< and symmetric: Cholesky, half of the time and memory
    solid_stiffness    ///< the same with an ordering for long bodies and three displacements a node
  };

  /// Entries of a matrix, or of one triangle of a symmetric one, each rank some of them. Entries of one place add up.
  struct MatrixEntries
  {
    unsigned int size = 0; ///< of the matrix
    std::vector<int> row;  ///< from 1, as MUMPS counts
    std::vector<int> column;
    std::vector<double> value;

    /// Allocates that many.
    void reserve(const std::size_t number)
    {
      row.reserve(number);
      column.reserve(number);
      value.reserve(number);
    }

    /// Adds an entry, by indices from 0.
    void add(const unsigned int row_index, const unsigned int column_index, const double entry)
    {
      row.push_back(static_cast<int>(row_index) + 1);
      column.push_back(static_cast<int>(column_index) + 1);
      value.push_back(entry);
    }
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
    void add(const unsigned int row_index, const double entry)
    {
      row.push_back(static_cast<int>(row_index) + 1);
      value.push_back(entry);
    }

    void end_column()
    {
      begin.push_back(static_cast<int>(row.size()) + 1);
    }
  };

  /// Factors of a real matrix by MUMPS, which all of some ranks hold together. MUMPS is called directly: PETSc's interface to it
  /// has no ordering for long bodies and no sparse right-hand sides, which are most of the work in three dimensions.
  /// All functions throw AnalysisError, naming the status, when a factorisation or solve fails.
  class Mumps
  {
  public:
    /// With a folder the factors are kept in files there, which the destructor removes, else in memory.
    explicit Mumps(MatrixKind kind = MatrixKind::general, MPI_Comm ranks = MPI_COMM_SELF, const std::string &folder = "");
    Mumps(const Mumps &)            = delete;
    Mumps &operator=(const Mumps &) = delete;
    ~Mumps();

    /// Factorises; the ordering is kept for matrices of the same pattern. To be called by all ranks; frees the entries.
    void factorise(MatrixEntries entries);

    /// Factorises a sequential matrix. The first time unknowns are eliminated in an `order` if there is one, see
    /// nested_dissection(); later that order is kept.
    void factorise(const dealii::PETScWrappers::SparseMatrix &matrix, std::vector<int> order = {});

    /// Factorises a general matrix and returns its Schur complement on `indices`, which stay in that order: the stiffness left on
    /// them when all others are eliminated. Solves are not possible.
    dealii::FullMatrix<double> factorise_with_schur_complement(const dealii::PETScWrappers::SparseMatrix &matrix,
                                                               const std::vector<unsigned int> &indices);

    // The first rank calls these while the others take_part().

    void solve(const dealii::Vector<double> &right_hand_side, dealii::Vector<double> &solution) const;

    /// Solves with some columns, one after another, in place.
    void solve(std::vector<double> &columns) const;

    /// Returns the solutions for sparse columns, one after another.
    std::vector<double> solve(SparseColumns columns) const;

    /// Takes part in a solve of the first rank.
    void take_part() const;

    /// Finds entries of the inverse of a symmetric matrix on a single rank, in the requested order: `positions` holds increasing
    /// columns by their row. Only the parts of the factors between rows and columns are visited.
    std::vector<double> compute_inverse_entries(const std::map<unsigned int, std::vector<unsigned int>> &positions) const;

  private:
    void set(int setting, int value) const;
    void call(int job, const char *what) const;
    void solve(double *columns, std::size_t number) const;
    void solve(SparseColumns &columns, double *solution) const;

    const MatrixKind kind;
    mutable DMUMPS_STRUC_C mumps;
    bool is_ordered = false;
  };
} // namespace sprag
