// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/mumps.h"

#include "base/errors.h"

namespace sprag
{
  Mumps::Mumps(const MatrixKind kind_)
      : kind(kind_)
  {
  }

  Mumps::~Mumps()
  {
    MatDestroy(&factor);
  }

  void Mumps::check(const PetscErrorCode code, const char *what) const
  {
    if (code != 0)
      throw AnalysisError(std::string("the direct solver failed in ") + what + " (PETSc error " + std::to_string(code) + ")");
  }

  void Mumps::check_factor(const char *what) const
  {
    MatFactorError error = MAT_FACTOR_NOERROR;
    PetscInt info        = 0;
    check(MatFactorGetError(factor, &error), what);
    check(MatMumpsGetInfog(factor, 1, &info), what);
    if (error != MAT_FACTOR_NOERROR || info < 0)
      throw AnalysisError(std::string("the direct solver failed in ") + what + " (MUMPS INFOG(1) = " + std::to_string(info) +
                          ", MatFactorError = " + std::to_string(error) + ")");
  }

  void Mumps::symbolic(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info), "set-up");
    check(kind == MatrixKind::general ? MatLUFactorSymbolic(factor, matrix, nullptr, nullptr, &info)
                                      : MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info),
          "analysis");
    check_factor("analysis");
  }

  void Mumps::numeric(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info), "set-up");
    check(kind == MatrixKind::general ? MatLUFactorNumeric(factor, matrix, &info)
                                      : MatCholeskyFactorNumeric(factor, matrix, &info),
          "factorisation");
    check_factor("factorisation");
  }

  void Mumps::factorise(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    if (factor == nullptr)
    {
      if (kind == MatrixKind::positive_definite)
        check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE), "set-up");
      const auto type = kind == MatrixKind::general ? MAT_FACTOR_LU : MAT_FACTOR_CHOLESKY;
      check(MatGetFactor(matrix, MATSOLVERMUMPS, type, &factor), "set-up");
      symbolic(matrix);
    }
    numeric(matrix);
  }

  dealii::FullMatrix<double> Mumps::factorise_with_schur_complement(const dealii::PETScWrappers::SparseMatrix &matrix,
                                                                    const std::vector<unsigned int> &indices)
  {
    const std::vector<PetscInt> petsc_indices(indices.begin(), indices.end());
    const auto n = static_cast<PetscInt>(indices.size());
    IS schur_set = nullptr;
    check(MatDestroy(&factor), "set-up");
    check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_LU, &factor), "set-up");
    check(ISCreateGeneral(PETSC_COMM_SELF, n, petsc_indices.data(), PETSC_COPY_VALUES, &schur_set), "set-up");
    check(MatFactorSetSchurIS(factor, schur_set), "set-up");
    check(ISDestroy(&schur_set), "set-up");
    symbolic(matrix);
    numeric(matrix);

    Mat schur = nullptr;
    MatFactorSchurStatus status;
    check(MatFactorCreateSchurComplement(factor, &schur, &status), "the Schur complement");
    const PetscScalar *values = nullptr;
    check(MatDenseGetArrayRead(schur, &values), "the Schur complement");
    dealii::FullMatrix<double> result(indices.size(), indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      for (std::size_t j = 0; j < indices.size(); ++j)
        result(i, j) = values[j * indices.size() + i];
    check(MatDenseRestoreArrayRead(schur, &values), "the Schur complement");
    check(MatDestroy(&schur), "the Schur complement");
    return result;
  }

  void Mumps::solve(const dealii::Vector<double> &right_hand_side, dealii::Vector<double> &solution) const
  {
    const auto n = static_cast<PetscInt>(right_hand_side.size());
    Vec b        = nullptr;
    Vec x        = nullptr;
    solution.reinit(right_hand_side.size());
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, right_hand_side.begin(), &b), "a solve");
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, solution.begin(), &x), "a solve");
    check(MatSolve(factor, b, x), "a solve");
    check_factor("a solve");
    check(VecDestroy(&b), "a solve");
    check(VecDestroy(&x), "a solve");
  }

  std::vector<double> Mumps::solve(std::vector<double> columns) const
  {
    PetscInt n = 0;
    check(MatGetSize(factor, &n, nullptr), "a solve");
    const auto number = static_cast<PetscInt>(columns.size()) / n;
    std::vector<double> result(columns.size());
    Mat b = nullptr, x = nullptr;
    check(MatCreateSeqDense(PETSC_COMM_SELF, n, number, columns.data(), &b), "a solve");
    check(MatCreateSeqDense(PETSC_COMM_SELF, n, number, result.data(), &x), "a solve");
    check(MatMatSolve(factor, b, x), "a solve");
    check_factor("a solve");
    check(MatDestroy(&b), "a solve");
    check(MatDestroy(&x), "a solve");
    return result;
  }

  std::vector<double> Mumps::entries_of_inverse(const std::map<unsigned int, std::vector<unsigned int>> &wanted) const
  {
    constexpr PetscInt inverse_entries = 30; // of ICNTL
    PetscInt n                         = 0;
    check(MatGetSize(factor, &n, nullptr), "the inverse");
    std::vector<PetscInt> begins(static_cast<std::size_t>(n) + 1), columns;
    auto row = wanted.begin();
    for (PetscInt i = 0; i < n; ++i)
    {
      if (row != wanted.end() && static_cast<PetscInt>(row->first) == i)
      {
        columns.insert(columns.end(), row->second.begin(), row->second.end());
        ++row;
      }
      begins[static_cast<std::size_t>(i) + 1] = static_cast<PetscInt>(columns.size());
    }
    std::vector<double> result(columns.size());
    Mat entries = nullptr;
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, begins.data(), columns.data(), result.data(), &entries),
          "the inverse");
    check(MatMumpsGetInverseTranspose(factor, entries), "the inverse");
    check_factor("the inverse");
    check(MatMumpsSetIcntl(factor, inverse_entries, 0), "the inverse"); // later solves are of all entries again
    check(MatDestroy(&entries), "the inverse");
    return result;
  }
} // namespace sprag
