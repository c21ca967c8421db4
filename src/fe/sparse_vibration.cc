#include "fe/sparse_vibration.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <slepceps.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;

    /// Change of the lowest mode by an inverse iteration. In a higher one round-off of the lowest comes back as many times as its
    /// frequency is higher.
    constexpr double largest_residual = 1e-4;

    /// Frequency that rates are divided by, over the lowest. What is stiff moves from q to q' / frequency and no further, at an
    /// eigenvalue 1 / frequency that is none: it must be smaller than those wanted.
    constexpr double span = 1000.;

    void check(const PetscErrorCode code)
    {
      if (code != 0)
        throw AnalysisError("the eigenvalue solver failed (PETSc error " + std::to_string(code) + ")");
    }

    /// The linearised problem: products with its inverse, and residuals.
    class InverseProblem
    {
    public:
      InverseProblem(const SparseOperator &structure_, const PortPerturbation &forces_)
          : structure(structure_)
          , forces(forces_)
          , stiffness(forces.stiffness())
          , damping(forces.damping())
          , n_forces(static_cast<unsigned int>(forces.ports.size()))
          , work(structure.size)
          , load(structure.size)
          , portable(n_forces)
      {
        find_responses();
      }

      unsigned int size() const
      {
        return structure.size;
      }

      /// Circular frequency of the size of the lowest one, by the power method.
      double low_frequency()
      {
        constexpr unsigned int iterations = 5;
        const Vector<double> none(size());
        Vector<double> q(size());
        Vector<double> next(size());
        q            = 1.;
        double ratio = 1.;
        for (unsigned int i = 0; i < iterations; ++i)
        {
          apply(none, q, next);
          ratio = next.l2_norm() / q.l2_norm();
          q.equ(1. / next.l2_norm(), next);
        }
        return 1. / std::sqrt(ratio);
      }

      /// -K^-1 (C q + M q'). The rotational spring is so soft beside the contact that solutions without the contact have lost
      /// half their digits: what they leave out of balance is solved for once more.
      void apply(const Vector<double> &q, const Vector<double> &rate, Vector<double> &result)
      {
        structure.damping(q, load);
        structure.mass(rate, work);
        load += work;
        load *= -1.;
        add_port_forces(damping, 1., q, load);
        add_port_forces(forces.inertia, -1., rate, load);
        solve(load, result);

        constexpr unsigned int corrections = 2;
        Vector<double> left(size());
        Vector<double> correction(size());
        for (unsigned int i = 0; i < corrections; ++i)
        {
          structure.stiffness(result, work);
          left = load;
          left -= work;
          add_port_forces(stiffness, 1., result, left);
          solve(left, correction);
          result += correction;
        }
      }

      /// Makes phi -K^-1 (lambda^2 M + lambda C) phi, forces included, which takes out what stiff modes it is mixed with. Returns
      /// by how much of its size that changed it. (Of the forces K phi the stiff ones would drown all others.)
      double refine(const Complex lambda, ComplexVector &phi)
      {
        const ComplexVector rate = multiple(lambda, phi);
        ComplexVector answer{ { Vector<double>(size()), Vector<double>(size()) } };
        for (unsigned int part = 0; part < 2; ++part)
          apply(phi[part], rate[part], answer[part]);
        ComplexVector refined = multiple(lambda, answer);
        double change         = 0.;
        double whole          = 0.;
        for (unsigned int part = 0; part < 2; ++part)
        {
          whole += refined[part].norm_sqr();
          phi[part] -= refined[part];
          change += phi[part].norm_sqr();
        }
        phi = refined;
        return std::sqrt(change / whole);
      }

    private:
      const SparseOperator &structure;
      const PortPerturbation &forces;
      const FullMatrix<double> stiffness;
      const FullMatrix<double> damping;
      const unsigned int n_forces;
      Vector<double> work;
      Vector<double> load;
      std::vector<Vector<double>> responses; ///< of the structure to unit forces on the ports
      LAPACKFullMatrix<double> portable;     ///< factors of 1 - G df/dz

      void find_responses()
      {
        FullMatrix<double> compliance(n_forces, n_forces);
        for (unsigned int b = 0; b < n_forces; ++b)
        {
          load = 0.;
          structure.ports.add_force(forces.ports[b], 1., load);
          responses.emplace_back(size());
          structure.solve(load, responses.back());
          const auto z = loaded_ports(responses.back());
          for (unsigned int a = 0; a < n_forces; ++a)
            compliance(a, b) = z[a];
        }
        if (n_forces == 0)
          return;
        FullMatrix<double> matrix(n_forces, n_forces);
        compliance.mmult(matrix, stiffness);
        matrix *= -1.;
        for (unsigned int a = 0; a < n_forces; ++a)
          matrix(a, a) += 1.;
        portable = matrix;
        try
        {
          portable.compute_lu_factorization();
        }
        catch (const ExceptionBase &)
        {
          throw AnalysisError("the slide is at the limit of its stability: it has a mode without stiffness");
        }
      }

      static ComplexVector multiple(const Complex factor, const ComplexVector &vector)
      {
        ComplexVector result{ { vector[0], vector[1] } };
        result[0].sadd(factor.real(), -factor.imag(), vector[1]);
        result[1].sadd(factor.real(), factor.imag(), vector[0]);
        return result;
      }

      Vector<double> loaded_ports(const Vector<double> &q) const
      {
        const auto all = structure.ports.displacements(q);
        Vector<double> z(n_forces);
        for (unsigned int a = 0; a < z.size(); ++a)
          z[a] = all[forces.ports[a]];
        return z;
      }

      void add_port_forces(const FullMatrix<double> &matrix, const double factor, const Vector<double> &q,
                           Vector<double> &sum) const
      {
        if (n_forces == 0)
          return;
        const auto z = loaded_ports(q);
        Vector<double> values(z.size());
        matrix.vmult(values, z);
        for (unsigned int a = 0; a < n_forces; ++a)
          structure.ports.add_force(forces.ports[a], factor * values[a], sum);
      }

      /// With the stiffness of structure and forces: f = A (1 - G A)^-1 z where the structure alone went to z.
      void solve(const Vector<double> &right_hand_side, Vector<double> &q) const
      {
        structure.solve(right_hand_side, q);
        if (n_forces == 0)
          return;
        auto z = loaded_ports(q);
        portable.solve(z);
        Vector<double> values(n_forces);
        stiffness.vmult(values, z);
        for (unsigned int a = 0; a < n_forces; ++a)
          q.add(values[a], responses[a]);
      }
    };

    /// The problem in (q, q' / frequency).
    struct ScaledProblem
    {
      InverseProblem &of;
      double frequency;
    };

    PetscErrorCode multiply(Mat matrix, Vec from, Vec to)
    {
      ScaledProblem *problem = nullptr;
      MatShellGetContext(matrix, &problem);
      const unsigned int n    = problem->of.size();
      const PetscScalar *read = nullptr;
      PetscScalar *write      = nullptr;
      VecGetArrayRead(from, &read);
      Vector<double> q(read, read + n);
      Vector<double> rate(read + n, read + 2 * n);
      VecRestoreArrayRead(from, &read);
      rate *= problem->frequency;
      Vector<double> result(n);
      problem->of.apply(q, rate, result);
      q /= problem->frequency;
      VecGetArray(to, &write);
      std::copy(result.begin(), result.end(), write);
      std::copy(q.begin(), q.end(), write + n);
      VecRestoreArray(to, &write);
      return 0;
    }

    /// Complex pairs count once. Of the last restart: the solver is asked to stop before it tells of this one.
    struct ModeCount
    {
      unsigned int wanted;
      unsigned int found = 0;
    };

    PetscErrorCode count_modes(EPS, PetscInt, PetscInt converged, PetscScalar *, PetscScalar *imaginary, PetscReal *, PetscInt,
                               void *count)
    {
      auto &modes = *static_cast<ModeCount *>(count);
      modes.found = static_cast<unsigned int>(
          std::count_if(imaginary, imaginary + converged, [](const PetscScalar part) { return part >= 0.; }));
      return 0;
    }

    PetscErrorCode stop_at_number(EPS eps, PetscInt restart, PetscInt most, PetscInt converged, PetscInt wanted,
                                  EPSConvergedReason *reason, void *count)
    {
      const auto &modes = *static_cast<const ModeCount *>(count);
      EPSStoppingBasic(eps, restart, most, converged, wanted, reason, nullptr);
      if (*reason == EPS_CONVERGED_ITERATING && modes.found >= modes.wanted)
        *reason = EPS_CONVERGED_USER;
      return 0;
    }

    class Eigensolver
    {
    public:
      Eigensolver(InverseProblem &inverse, const unsigned int number)
          : n(inverse.size())
          , modes{ number }
          , lowest(inverse.low_frequency())
          , problem{ inverse, span * lowest }
      {
        const auto rows = static_cast<PetscInt>(2 * n);
        check(MatCreateShell(PETSC_COMM_SELF, rows, rows, rows, rows, &problem, &matrix));
        check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)));
        check(MatCreateVecs(matrix, &real, &imaginary));
        check(EPSCreate(PETSC_COMM_SELF, &eps));
        check(EPSSetOperators(eps, matrix, nullptr));
        check(EPSSetProblemType(eps, EPS_NHEP));
        check(EPSSetWhichEigenpairs(eps, EPS_LARGEST_MAGNITUDE));
        check(EPSSetDimensions(eps, std::min(static_cast<PetscInt>(2 * number), rows), PETSC_DEFAULT, PETSC_DEFAULT));
        check(EPSSetTolerances(eps, 1e-10, 50));
        if (3 * 2 * number > 2 * n)
          check(EPSSetType(eps, EPSLAPACK));
        else
        {
          check(EPSSetType(eps, EPSKRYLOVSCHUR));
          check(EPSMonitorSet(eps, &count_modes, &modes, nullptr));
          check(EPSSetStoppingTestFunction(eps, &stop_at_number, &modes, nullptr));
        }
        start_alike();
        check(EPSSolve(eps));
      }
      Eigensolver(const Eigensolver &)            = delete;
      Eigensolver &operator=(const Eigensolver &) = delete;
      ~Eigensolver()
      {
        EPSDestroy(&eps);
        MatDestroy(&matrix);
        VecDestroy(&real);
        VecDestroy(&imaginary);
      }

      unsigned int n_converged() const
      {
        PetscInt result = 0;
        check(EPSGetConverged(eps, &result));
        return static_cast<unsigned int>(result);
      }

      /// Of the size of the lowest.
      double frequency() const
      {
        return lowest;
      }

      /// Eigenvalue of the inverse and the first half of its vector.
      Complex pair(const unsigned int i, ComplexVector &vector) const
      {
        PetscScalar value_real = 0., value_imaginary = 0.;
        check(EPSGetEigenpair(eps, static_cast<PetscInt>(i), &value_real, &value_imaginary, real, imaginary));
        const Vec parts[] = { real, imaginary };
        for (unsigned int part = 0; part < 2; ++part)
        {
          const PetscScalar *values = nullptr;
          check(VecGetArrayRead(parts[part], &values));
          vector[part] = Vector<double>(values, values + n);
          check(VecRestoreArrayRead(parts[part], &values));
        }
        return { value_real, value_imaginary };
      }

    private:
      /// The same start in every run, so that results are the same to the last bit.
      void start_alike()
      {
        PetscScalar *values = nullptr;
        check(VecGetArray(real, &values));
        for (unsigned int i = 0; i < 2 * n; ++i)
          values[i] = 1. + 0.5 * std::sin(1. + i);
        check(VecRestoreArray(real, &values));
        check(EPSSetInitialSpace(eps, 1, &real));
      }

      const unsigned int n;
      ModeCount modes;
      const double lowest;
      ScaledProblem problem;
      EPS eps       = nullptr;
      Mat matrix    = nullptr;
      Vec real      = nullptr;
      Vec imaginary = nullptr;
    };
  } // namespace

  std::vector<StructureMode> sparse_vibrations(const SparseOperator &structure, const PortPerturbation &forces,
                                               const unsigned int number)
  {
    InverseProblem problem(structure, forces);
    const Eigensolver solver(problem, number);
    std::vector<StructureMode> result;
    for (unsigned int i = 0; i < solver.n_converged(); ++i)
    {
      StructureMode mode;
      const Complex inverse = solver.pair(i, mode.coordinates);
      if (inverse.imag() > 0.)
        continue; // its conjugate has Im lambda > 0
      mode.eigenvalue = { (1. / inverse).real(), std::abs((1. / inverse).imag()) };
      mode.residual   = problem.refine(mode.eigenvalue, mode.coordinates);
      if (!(mode.residual < largest_residual * std::max(1., std::abs(mode.eigenvalue) / solver.frequency())))
        throw AnalysisError("the vibration at " + rounded_text(mode.eigenvalue.imag() / (2. * M_PI)) +
                            " Hz was found with a backward error of only " + rounded_text(mode.residual) +
                            ". Try fewer Stability/Modes.");
      result.push_back(std::move(mode));
    }
    if (result.size() < std::min(number, problem.size()))
      throw AnalysisError("only " + std::to_string(result.size()) + " of " + std::to_string(number) +
                          " vibrations were found. Try fewer Stability/Modes.");
    std::sort(result.begin(), result.end(),
              [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
    return result;
  }
} // namespace sprag
