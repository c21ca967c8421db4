// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/mumps.h"

#include "base/errors.h"
#include "fe/algebra/matrix_rows.h"

#include <cstring>
#include <utility>

namespace sprag
{
  namespace
  {
    // Jobs and settings of MUMPS by their numbers in its users' guide.
    constexpr int initialise = -1, terminate = -2, analyse = 1, decompose = 2, back_substitute = 3;
    constexpr int print_level = 4, element_input = 5, ordering = 7, scaling = 8, memory_margin = 14, compression = 15,
                  distribution     = 18;
    constexpr int schur_complement = 19, sparse_columns = 20, factors_in_files = 22, columns_together = 27,
                  parallel_analysis = 28;
    constexpr int inverse_entries   = 30;

    std::string describe_status(const int status)
    {
      if (status == -13 || status == -9)
        return "): there is not enough memory";
      return status == -90 ? "): the factors could not be written or read" : ")";
    }
  } // namespace

  Mumps::Mumps(const MatrixKind kind_, const MPI_Comm ranks, const std::string &folder)
      : kind(kind_)
  {
    std::memset(&mumps, 0, sizeof mumps);
    mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(ranks));
    mumps.par          = 1;
    mumps.sym          = kind < MatrixKind::positive_definite ? 0 : 1;
    call(initialise, "set-up");
    for (const int output : { 1, 2, 3 })
      set(output, -1);
    set(print_level, 0);
    set(element_input, 0);
    set(factors_in_files, folder.empty() ? 0 : 1);
    std::strncpy(mumps.ooc_tmpdir, folder.c_str(), sizeof mumps.ooc_tmpdir - 1);
    std::strncpy(mumps.ooc_prefix, "factors", sizeof mumps.ooc_prefix - 1);
    if (kind == MatrixKind::tangent)
      set(scaling, 0);
    if (kind != MatrixKind::solid_stiffness)
      return;
    set(ordering, 4);          // PORD, which is best for long bodies
    set(memory_margin, 30);    // per cent that the analysis may have missed
    set(compression, -3);      // ordered by nodes of three displacements
    set(distribution, 3);      // entries where they are
    set(columns_together, 64); // more gain little
    set(parallel_analysis, 1); // sequential
  }

  Mumps::~Mumps()
  {
    mumps.job = terminate;
    dmumps_c(&mumps);
  }

  void Mumps::set(const int setting, const int value) const
  {
    mumps.icntl[setting - 1] = value;
  }

  void Mumps::call(const int job, const char *what) const
  {
    mumps.job = job;
    dmumps_c(&mumps);
    const int status = mumps.infog[0];
    if (status < 0)
      throw AnalysisError(std::string("the direct solver failed in ") + what + " (MUMPS INFOG(1) = " + std::to_string(status) +
                          ", INFOG(2) = " + std::to_string(mumps.infog[1]) + describe_status(status));
  }

  void Mumps::factorise(MatrixEntries entries)
  {
    mumps.n   = static_cast<MUMPS_INT>(entries.size);
    mumps.nnz = mumps.nnz_loc = static_cast<MUMPS_INT8>(entries.row.size());
    mumps.irn = mumps.irn_loc = entries.row.data();
    mumps.jcn = mumps.jcn_loc = entries.column.data();
    mumps.a = mumps.a_loc = entries.value.data();
    if (!is_ordered)
      call(analyse, "analysis");
    is_ordered = true;
    call(decompose, "factorisation");
    mumps.irn = mumps.irn_loc = mumps.jcn = mumps.jcn_loc = nullptr;
    mumps.a = mumps.a_loc = nullptr;
  }

  void Mumps::factorise(const dealii::PETScWrappers::SparseMatrix &matrix, std::vector<int> order)
  {
    if (!order.empty())
      set(ordering, 1); // in perm_in
    mumps.perm_in = order.data();
    const MatrixRows rows(matrix);
    MatrixEntries entries;
    entries.size = rows.n;
    entries.reserve(static_cast<std::size_t>(rows.begin[rows.n]));
    for (PetscInt row = 0; row < rows.n; ++row)
      for (PetscInt i = rows.begin[row]; i < rows.begin[row + 1]; ++i)
        if (mumps.sym == 0 || rows.column[i] >= row)
          entries.add(row, rows.column[i], rows[i]);
    factorise(std::move(entries));
    mumps.perm_in = nullptr;
  }

  dealii::FullMatrix<double> Mumps::factorise_with_schur_complement(const dealii::PETScWrappers::SparseMatrix &matrix,
                                                                    const std::vector<unsigned int> &indices)
  {
    const auto n = static_cast<MUMPS_INT>(indices.size());
    std::vector<MUMPS_INT> from_1;
    for (const unsigned int index : indices)
      from_1.push_back(static_cast<MUMPS_INT>(index) + 1);
    dealii::FullMatrix<double> transposed(n, n), result(n, n);
    set(schur_complement, 3); // by columns
    mumps.size_schur = mumps.schur_lld = n;
    mumps.listvar_schur                = from_1.data();
    mumps.schur                        = &transposed(0, 0);
    mumps.nprow = mumps.npcol = 1;
    mumps.mblock = mumps.nblock = 100;
    factorise(matrix);
    result.copy_transposed(transposed);
    return result;
  }

  void Mumps::solve(double *const columns, const std::size_t number) const
  {
    set(sparse_columns, 0);
    mumps.rhs  = columns;
    mumps.lrhs = mumps.n;
    mumps.nrhs = static_cast<MUMPS_INT>(number);
    call(back_substitute, "back-substitution");
  }

  void Mumps::solve(const dealii::Vector<double> &right_hand_side, dealii::Vector<double> &solution) const
  {
    solution = right_hand_side;
    solve(solution.begin(), 1);
  }

  void Mumps::solve(std::vector<double> &columns) const
  {
    solve(columns.data(), columns.size() / mumps.n);
  }

  void Mumps::solve(SparseColumns &columns, double *const solution) const
  {
    mumps.nz_rhs      = static_cast<MUMPS_INT>(columns.row.size());
    mumps.irhs_ptr    = columns.begin.data();
    mumps.irhs_sparse = columns.row.data();
    mumps.rhs_sparse  = columns.value.data();
    mumps.rhs         = solution;
    mumps.lrhs        = mumps.n;
    mumps.nrhs        = columns.size();
    call(back_substitute, "back-substitution");
  }

  std::vector<double> Mumps::solve(SparseColumns columns) const
  {
    std::vector<double> result(static_cast<std::size_t>(mumps.n) * columns.size());
    set(sparse_columns, 1);
    solve(columns, result.data());
    return result;
  }

  void Mumps::take_part() const
  {
    call(back_substitute, "back-substitution");
  }

  std::vector<double> Mumps::compute_inverse_entries(const std::map<unsigned int, std::vector<unsigned int>> &positions) const
  {
    SparseColumns entries;
    auto row = positions.begin();
    for (MUMPS_INT i = 0; i < mumps.n; ++i)
    {
      if (row != positions.end() && row->first == static_cast<unsigned int>(i))
        for (const unsigned int column : (row++)->second)
          entries.add(column, 0.);
      entries.end_column();
    }
    set(inverse_entries, 1);
    solve(entries, nullptr);
    set(inverse_entries, 0); // later solves are of all entries again
    return entries.value;
  }
} // namespace sprag
