#include "fe/algebra/free_modes.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <slepceps.h>
#include <string>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Of |K phi - omega^2 M phi| over (|K| + omega^2 |M|) |phi|.
    constexpr double largest_residual = 1e-10;

    void check(const PetscErrorCode code)
    {
      if (code != 0)
        throw AnalysisError("the eigenvalue solver failed (PETSc error " + std::to_string(code) + ")");
    }

    /// Owner of PETSc's solver.
    struct Eigensolver
    {
      EPS eps = nullptr;

      Eigensolver()
      {
        check(EPSCreate(PETSC_COMM_SELF, &eps));
      }
      Eigensolver &operator=(Eigensolver &&) = delete;
      ~Eigensolver()
      {
        EPSDestroy(&eps);
      }
    };

    /// Shift-and-invert at 0 with MUMPS.
    void invert_at_zero(EPS eps)
    {
      ST transformation = nullptr;
      KSP solver        = nullptr;
      PC factors        = nullptr;
      check(EPSSetType(eps, EPSKRYLOVSCHUR));
      check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
      check(EPSSetTarget(eps, 0.));
      check(EPSGetST(eps, &transformation));
      check(STSetType(transformation, STSINVERT));
      check(STGetKSP(transformation, &solver));
      check(KSPSetType(solver, KSPPREONLY));
      check(KSPGetPC(solver, &factors));
      check(PCSetType(factors, PCLU));
      check(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS));
    }

    double eigenpair(EPS eps, const PetscInt i, Vector<double> &shape)
    {
      PetscScalar value = 0.;
      Vec vector        = nullptr;
      check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(shape.size()), shape.begin(), &vector));
      check(EPSGetEigenpair(eps, i, &value, nullptr, vector, nullptr));
      check(VecDestroy(&vector));
      return value;
    }

    /// In the direction of a positive last coordinate, or largest where that is nothing.
    void orient(Vector<double> &shape)
    {
      double reference = shape[shape.size() - 1];
      if (std::abs(reference) < 1e-8 * shape.linfty_norm())
        reference = *std::max_element(shape.begin(), shape.end(),
                                      [](const double a, const double b) { return std::abs(a) < std::abs(b); });
      if (reference < 0.)
        shape *= -1.;
    }
  } // namespace

  FreeModes free_modes(const PETScWrappers::SparseMatrix &stiffness, const PETScWrappers::SparseMatrix &mass,
                       const unsigned int n)
  {
    const auto size   = static_cast<PetscInt>(stiffness.m());
    const auto wanted = std::min(static_cast<PetscInt>(n), size);
    const Eigensolver solver;
    check(EPSSetOperators(solver.eps, stiffness, mass));
    check(EPSSetProblemType(solver.eps, EPS_GHEP));
    check(EPSSetDimensions(solver.eps, wanted, PETSC_DEFAULT, PETSC_DEFAULT));
    check(EPSSetTolerances(solver.eps, 1e-12, 1000));
    if (3 * static_cast<PetscInt>(n) > size) // a small problem, or most of a problem, is solved as a dense one
    {
      check(EPSSetWhichEigenpairs(solver.eps, EPS_SMALLEST_MAGNITUDE));
      check(EPSSetType(solver.eps, EPSLAPACK));
    }
    else
      invert_at_zero(solver.eps);
    check(EPSSolve(solver.eps));
    PetscInt converged = 0;
    check(EPSGetConverged(solver.eps, &converged));
    if (converged < wanted)
      throw AnalysisError("only " + std::to_string(converged) + " of " + std::to_string(wanted) + " vibration modes were found");
    FreeModes modes;
    for (PetscInt i = 0; i < wanted; ++i)
    {
      modes.shapes.emplace_back(stiffness.m());
      modes.stiffness.push_back(eigenpair(solver.eps, i, modes.shapes.back()));
      PetscReal error = 0.;
      check(EPSComputeError(solver.eps, i, EPS_ERROR_BACKWARD, &error));
      const double residual = error / modes.shapes.back().l2_norm();
      if (!(residual < largest_residual))
        throw AnalysisError("vibration mode " + std::to_string(i + 1) + " was found with a residual of only " +
                            number_text(residual));
      orient(modes.shapes.back());
    }
    return modes;
  }
} // namespace sprag
