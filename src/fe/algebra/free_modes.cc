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

    /// Shift-and-invert at 0 with MUMPS; a small problem, or most of a problem, is solved as a dense one.
    class Eigensolver
    {
    public:
      Eigensolver(const PETScWrappers::SparseMatrix &stiffness, const PETScWrappers::SparseMatrix &mass, const unsigned int n)
          : size(static_cast<PetscInt>(stiffness.m()))
      {
        check(EPSCreate(PETSC_COMM_SELF, &eps));
        check(EPSSetOperators(eps, stiffness, mass));
        check(EPSSetProblemType(eps, EPS_GHEP));
        check(EPSSetDimensions(eps, std::min(static_cast<PetscInt>(n), size), PETSC_DEFAULT, PETSC_DEFAULT));
        check(EPSSetTolerances(eps, 1e-12, 1000));
        if (3 * static_cast<PetscInt>(n) > size)
        {
          check(EPSSetWhichEigenpairs(eps, EPS_SMALLEST_MAGNITUDE));
          check(EPSSetType(eps, EPSLAPACK));
        }
        else
          invert_at_zero();
        check(EPSSolve(eps));
      }
      Eigensolver &operator=(Eigensolver &&) = delete;
      ~Eigensolver()
      {
        EPSDestroy(&eps);
      }

      unsigned int n_converged() const
      {
        PetscInt result = 0;
        check(EPSGetConverged(eps, &result));
        return static_cast<unsigned int>(result);
      }

      double residual(const unsigned int i) const
      {
        PetscReal result = 0.;
        check(EPSComputeError(eps, static_cast<PetscInt>(i), EPS_ERROR_BACKWARD, &result));
        return result;
      }

      double eigenpair(const unsigned int i, Vector<double> &shape) const
      {
        PetscScalar value = 0.;
        Vec vector        = nullptr;
        shape.reinit(static_cast<unsigned int>(size));
        check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, shape.begin(), &vector));
        check(EPSGetEigenpair(eps, static_cast<PetscInt>(i), &value, nullptr, vector, nullptr));
        check(VecDestroy(&vector));
        return value;
      }

    private:
      void invert_at_zero()
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

      EPS eps = nullptr;
      const PetscInt size;
    };

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
    const Eigensolver solver(stiffness, mass, n);
    const unsigned int wanted = std::min(n, static_cast<unsigned int>(stiffness.m()));
    if (solver.n_converged() < wanted)
      throw AnalysisError("only " + std::to_string(solver.n_converged()) + " of " + std::to_string(wanted) +
                          " vibration modes were found");
    FreeModes modes;
    for (unsigned int i = 0; i < wanted; ++i)
    {
      modes.shapes.emplace_back();
      modes.stiffness.push_back(solver.eigenpair(i, modes.shapes.back()));
      const double residual = solver.residual(i) / modes.shapes.back().l2_norm();
      if (!(residual < largest_residual))
        throw AnalysisError("vibration mode " + std::to_string(i + 1) + " was found with a residual of only " +
                            number_text(residual));
      orient(modes.shapes.back());
    }
    return modes;
  }
} // namespace sprag
