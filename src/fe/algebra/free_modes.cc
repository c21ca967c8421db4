// SPDX-License-Identifier: GPL-3.0-only
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
    /// Largest |K phi - omega^2 M phi| over (|K| + omega^2 |M|) |phi| that is admitted as it is.
    constexpr double largest_residual = 1e-10;

    /// Largest error of a shape in energy that is admitted where the residual is larger; its square is the relative error of
    /// omega^2.
    constexpr double largest_shape_error = 1e-2;

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

    Vec view(Vector<double> &values)
    {
      Vec result = nullptr;
      check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(values.size()), values.begin(), &result));
      return result;
    }

    double eigenpair(EPS eps, const PetscInt i, Vector<double> &shape)
    {
      PetscScalar value = 0.;
      Vec vector        = view(shape);
      check(EPSGetEigenpair(eps, i, &value, nullptr, vector, nullptr));
      check(VecDestroy(&vector));
      return value;
    }

    /// Returns the length of phi - omega^2 K^-1 M phi over that of phi, both measured by the energy phi^T K phi. With phi the sum
    /// of the mode and of e_j times others, its square is the sum of e_j^2 omega_j^2/omega^2 over stiffer modes, which is by how
    /// much Rayleigh's quotient is off. The residual of the forces says less: round-off of the stiffest elements makes it large
    /// in slender levers, and no frequency feels that.
    double shape_error(EPS eps, const PETScWrappers::SparseMatrix &stiffness, const double omega_squared, Vector<double> &shape)
    {
      ST transformation = nullptr;
      check(EPSGetST(eps, &transformation));
      const auto energy = [&](Vec motion)
      {
        Vec force          = nullptr;
        PetscScalar result = 0.;
        check(VecDuplicate(motion, &force));
        check(MatMult(stiffness, motion, force));
        check(VecDot(motion, force, &result));
        check(VecDestroy(&force));
        return result;
      };
      Vector<double> image(shape.size());
      Vec phi = view(shape), difference = view(image);
      check(STApply(transformation, phi, difference)); // K^-1 M phi
      check(VecAYPX(difference, -omega_squared, phi));
      const double error = std::sqrt(energy(difference) / energy(phi));
      check(VecDestroy(&phi));
      check(VecDestroy(&difference));
      return error;
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
    const bool is_dense = 3 * static_cast<PetscInt>(n) > size; // a small problem, or most of a problem
    if (is_dense)
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
      // One of the two suffices: round-off of stiff elements spoils the first, of a soft rotation below them the second.
      const auto has_shape = [&]
      { return shape_error(solver.eps, stiffness, modes.stiffness.back(), modes.shapes.back()) < largest_shape_error; };
      if (!(residual < largest_residual) && (is_dense || !has_shape()))
        throw AnalysisError("vibration mode " + std::to_string(i + 1) + " was found with a residual of only " +
                            number_text(residual));
      orient(modes.shapes.back());
    }
    return modes;
  }
} // namespace sprag
