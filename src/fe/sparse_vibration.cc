#include "fe/sparse_vibration.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <slepceps.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;

    constexpr double largest_residual = 1e-8;

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
          , work(structure.size)
          , load(structure.size)
      {
      }

      unsigned int size() const
      {
        return structure.size;
      }

      void apply(const Vector<double> &q, const Vector<double> &rate, Vector<double> &result)
      {
        structure.damping(q, load);
        structure.mass(rate, work);
        load += work;
        load *= -1.;
        add_port_forces(damping, 1., q, load);
        add_port_forces(forces.inertia, -1., rate, load);
        structure.solve(load, result);
        add_contact_answer(result);
      }

      double residual(const Complex lambda, const ComplexVector &phi)
      {
        // lambda^2 M phi + lambda C phi + K phi, forces included.
        const Complex factors[] = { lambda * lambda, lambda, 1. };
        ComplexVector sum{ { Vector<double>(size()), Vector<double>(size()) } };
        double scale = 0.;
        for (unsigned int k = 0; k < 3; ++k)
        {
          double norm = 0.;
          for (unsigned int part = 0; part < 2; ++part)
          {
            const auto product = product_of(k, phi[part]);
            norm += std::norm(factors[k]) * product.norm_sqr();
            const Complex f = part == 0 ? factors[k] : factors[k] * Complex(0., 1.);
            sum[0].add(f.real(), product);
            sum[1].add(f.imag(), product);
          }
          scale += std::sqrt(norm);
        }
        return std::sqrt(sum[0].norm_sqr() + sum[1].norm_sqr()) / scale;
      }

    private:
      const SparseOperator &structure;
      const PortPerturbation &forces;
      const FullMatrix<double> stiffness;
      const FullMatrix<double> damping;
      Vector<double> work;
      Vector<double> load;

      Vector<double> product_of(const unsigned int k, const Vector<double> &q)
      {
        Vector<double> result(size());
        (k == 0 ? structure.mass : k == 1 ? structure.damping : structure.stiffness)(q, result);
        add_port_forces(k == 0 ? forces.inertia : k == 1 ? damping : stiffness, k == 0 ? 1. : -1., q, result);
        return result;
      }

      Vector<double> loaded_ports(const Vector<double> &q) const
      {
        const auto all = structure.ports.displacements(q);
        Vector<double> z(static_cast<unsigned int>(forces.ports.size()));
        for (unsigned int a = 0; a < z.size(); ++a)
          z[a] = all[forces.ports[a]];
        return z;
      }

      void add_forces(const Vector<double> &values, Vector<double> &sum) const
      {
        for (unsigned int a = 0; a < values.size(); ++a)
          structure.ports.add_force(forces.ports[a], values[a], sum);
      }

      void add_port_forces(const FullMatrix<double> &matrix, const double factor, const Vector<double> &q,
                           Vector<double> &sum) const
      {
        if (forces.ports.empty())
          return;
        const auto z = loaded_ports(q);
        Vector<double> values(z.size());
        matrix.vmult(values, z);
        values *= factor;
        add_forces(values, sum);
      }

      /// The structure alone went to `q`; what the contact's stiffness adds.
      void add_contact_answer(Vector<double> &q)
      {
        if (forces.ports.empty())
          return;
        const auto z      = loaded_ports(q);
        const auto values = port_reaction(structure.compliance, forces.ports, stiffness, z);
        Vector<double> own(size());
        add_forces(values, own);
        structure.solve(own, work);
        q += work;
      }
    };

    PetscErrorCode multiply(Mat matrix, Vec from, Vec to)
    {
      InverseProblem *problem = nullptr;
      MatShellGetContext(matrix, &problem);
      const unsigned int n    = problem->size();
      const PetscScalar *read = nullptr;
      PetscScalar *write      = nullptr;
      VecGetArrayRead(from, &read);
      const Vector<double> q(read, read + n);
      const Vector<double> rate(read + n, read + 2 * n);
      VecRestoreArrayRead(from, &read);
      Vector<double> result(n);
      problem->apply(q, rate, result);
      VecGetArray(to, &write);
      std::copy(result.begin(), result.end(), write);
      std::copy(q.begin(), q.end(), write + n);
      VecRestoreArray(to, &write);
      return 0;
    }

    class Eigensolver
    {
    public:
      Eigensolver(InverseProblem &problem, const unsigned int number)
          : n(problem.size())
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
        check(EPSSetTolerances(eps, 1e-12, 300));
        check(EPSSetType(eps, 3 * 2 * number > 2 * n ? EPSLAPACK : EPSKRYLOVSCHUR));
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

      /// Eigenvalue of the inverse and the second half of its vector, lambda times the first and so the more exact one.
      Complex pair(const unsigned int i, ComplexVector &vector) const
      {
        PetscScalar value_real = 0., value_imaginary = 0.;
        check(EPSGetEigenpair(eps, static_cast<PetscInt>(i), &value_real, &value_imaginary, real, imaginary));
        const Vec parts[] = { real, imaginary };
        for (unsigned int part = 0; part < 2; ++part)
        {
          const PetscScalar *values = nullptr;
          check(VecGetArrayRead(parts[part], &values));
          vector[part] = Vector<double>(values + n, values + 2 * n);
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
      mode.eigenvalue = 1. / inverse;
      mode.residual   = problem.residual(mode.eigenvalue, mode.coordinates);
      if (!(mode.residual < largest_residual))
        throw AnalysisError("the vibration at " + rounded_text(mode.eigenvalue.imag() / (2. * M_PI)) +
                            " Hz was found with a backward error of only " + rounded_text(mode.residual) +
                            ". Try fewer Stability/Modes.");
      result.push_back(std::move(mode));
    }
    if (result.empty())
      throw AnalysisError("no vibration was found: the eigenvalue solver did not converge. Try more Stability/Modes.");
    std::sort(result.begin(), result.end(),
              [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
    return result;
  }
} // namespace sprag
