#include "fe/algebra/mumps.h"

#include "base/errors.h"

namespace sprag
{
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

  void Mumps::numeric(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info), "set-up");
    check(MatLUFactorNumeric(factor, matrix, &info), "factorisation");
    check_factor("factorisation");
  }

  void Mumps::factorise(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    if (factor == nullptr)
    {
      MatFactorInfo info;
      check(MatFactorInfoInitialize(&info), "set-up");
      check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_LU, &factor), "set-up");
      check(MatLUFactorSymbolic(factor, matrix, nullptr, nullptr, &info), "analysis");
      check_factor("analysis");
    }
    numeric(matrix);
  }

  dealii::FullMatrix<double> Mumps::factorise_with_schur_complement(const dealii::PETScWrappers::SparseMatrix &matrix,
                                                                    const std::vector<unsigned int> &indices)
  {
    const std::vector<PetscInt> petsc_indices(indices.begin(), indices.end());
    const auto n = static_cast<PetscInt>(indices.size());
    MatFactorInfo info;
    IS schur_set = nullptr;
    check(MatDestroy(&factor), "set-up");
    check(MatFactorInfoInitialize(&info), "set-up");
    check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_LU, &factor), "set-up");
    check(ISCreateGeneral(PETSC_COMM_SELF, n, petsc_indices.data(), PETSC_COPY_VALUES, &schur_set), "set-up");
    check(MatFactorSetSchurIS(factor, schur_set), "set-up");
    check(ISDestroy(&schur_set), "set-up");
    check(MatLUFactorSymbolic(factor, matrix, nullptr, nullptr, &info), "analysis");
    check_factor("analysis");
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
} // namespace sprag
