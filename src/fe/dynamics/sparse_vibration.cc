// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_vibration.h"

#include "base/errors.h"
#include "base/text.h"
#include "model/structure/eigenvalues.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// State of the first-order problem: displacements, velocities and the tractions of friction's delays.
    struct SparseState
    {
      Vector<double> q, rate, traction;

      void add(const double factor, const SparseState &other)
      {
        q.add(factor, other.q);
        rate.add(factor, other.rate);
        if (traction.size() > 0)
          traction.add(factor, other.traction);
      }

      void scale(const double factor)
      {
        q *= factor;
        rate *= factor;
        if (traction.size() > 0)
          traction *= factor;
      }

      double operator*(const SparseState &other) const
      {
        return q * other.q + rate * other.rate + (traction.size() > 0 ? traction * other.traction : 0.);
      }
    };

    /// The linearised problem E s' = A s of a sparse structure under forces at its interface, s = (q, q', tau): products with
    /// A^-1 E, whose eigenvalues are 1 / lambda.
    ///
    /// States are measured by their energy, q^T K q + q'^T M q' + tau^2 over the stiffness of stick, K with the contact's
    /// springs. Without friction and damping the products are skew in it: their eigenvectors are orthogonal, and what is stiff is
    /// small.
    class InverseProblem
    {
    public:
      /// Arguments must outlive the problem. Throws AnalysisError if there is a mode without stiffness.
      InverseProblem(const SparseStructure &sparse_structure, const LinearisedForces &interface_forces)
          : structure(sparse_structure)
          , forces(interface_forces)
          , stiffness(forces.stiffness())
          , damping(forces.damping())
          , n_forces(static_cast<unsigned int>(forces.dofs.size()))
          , springs(n_forces, n_forces)
          , portable(n_forces)
      {
        if (n_forces > 0)
        {
          find_springs();
          find_responses();
        }
        for (const auto &delay : forces.delays)
          tractions.push_back(delay.time * delay.force.l2_norm() / delay.rate_row.l2_norm());
      }

      /// Returns the size of the state.
      unsigned int size() const
      {
        return 2 * structure.n_coordinates() + n_delays();
      }

      SparseState zero() const
      {
        return { Vector<double>(structure.n_coordinates()), Vector<double>(structure.n_coordinates()),
                 Vector<double>(n_delays()) };
      }

      /// Returns the state that leads to the given one: displacements -K^-1 (C q + M q' + delayed tractions).
      SparseState apply(const SparseState &state) const
      {
        SparseState result{ displacements(state), state.q, Vector<double>(n_delays()) };
        if (n_delays() == 0)
          return result;
        const auto before = loaded_displacements(state.q);
        const auto after  = loaded_displacements(result.q);
        for (unsigned int k = 0; k < n_delays(); ++k)
        {
          const auto &delay  = forces.delays[k];
          result.traction[k] = delay.stiffness_row * after + delay.rate_row * before - delay.time * state.traction[k];
        }
        return result;
      }

      /// Returns the energy's derivative: its product with a state is twice their mutual energy.
      SparseState momenta(const SparseState &state) const
      {
        SparseState result = zero();
        structure.stiffness_product(state.q, result.q);
        add_interface_forces(springs, state.q, result.q);
        mass_product(state.rate, result.rate);
        for (unsigned int k = 0; k < n_delays(); ++k)
          result.traction[k] = tractions[k] * state.traction[k];
        return result;
      }

      /// Returns square q^T M q + q'^T M q'. Unlike energy it does not see round-off of displacements, of which stiffness makes
      /// 1e-9 of it.
      double mass_form(const SparseState &state, const double square) const
      {
        Vector<double> momentum(structure.n_coordinates());
        mass_product(state.q, momentum);
        const double displacement_part = momentum * state.q;
        mass_product(state.rate, momentum);
        return square * displacement_part + momentum * state.rate;
      }

    private:
      const SparseStructure &structure;
      const LinearisedForces &forces;
      const FullMatrix<double> stiffness;
      const FullMatrix<double> damping;
      const unsigned int n_forces;
      FullMatrix<double> springs;            ///< of the contact, those that are not negative
      std::vector<double> tractions;         ///< energy of the delays' tractions by their square
      std::vector<Vector<double>> responses; ///< of the structure to unit forces at the interface
      LAPACKFullMatrix<double> portable;     ///< factors of 1 - G df/dz

      unsigned int n_delays() const
      {
        return static_cast<unsigned int>(forces.delays.size());
      }

      void find_springs()
      {
        LAPACKFullMatrix<double> symmetric(n_forces);
        for (unsigned int a = 0; a < n_forces; ++a)
          for (unsigned int b = 0; b < n_forces; ++b)
            symmetric(a, b) = -0.5 * (forces.pressure(a, b) + forces.pressure(b, a));
        Vector<double> values;
        FullMatrix<double> vectors;
        symmetric.compute_eigenvalues_symmetric(0., std::numeric_limits<double>::max(), 0., values, vectors);
        for (unsigned int i = 0; i < values.size(); ++i)
          for (unsigned int a = 0; a < n_forces; ++a)
            for (unsigned int b = 0; b < n_forces; ++b)
              springs(a, b) += values[i] * vectors(a, i) * vectors(b, i);
      }

      void find_responses()
      {
        FullMatrix<double> compliance(n_forces, n_forces);
        Vector<double> load(structure.n_coordinates());
        for (unsigned int b = 0; b < n_forces; ++b)
        {
          load = 0.;
          structure.interface().add_force(forces.dofs[b], 1., load);
          responses.emplace_back(structure.n_coordinates());
          structure.solve_statics(load, responses.back());
          const auto z = loaded_displacements(responses.back());
          for (unsigned int a = 0; a < n_forces; ++a)
            compliance(a, b) = z[a];
        }
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

      void mass_product(const Vector<double> &rate, Vector<double> &momentum) const
      {
        structure.mass_product(rate, momentum);
        add_interface_forces(forces.inertia, rate, momentum);
      }

      /// The rotational spring is so soft beside the contact that solutions without the contact have lost half their digits: what
      /// they leave out of balance is solved for once more.
      Vector<double> displacements(const SparseState &state) const
      {
        Vector<double> load(structure.n_coordinates()), left(structure.n_coordinates()), correction(structure.n_coordinates()),
            result(structure.n_coordinates());
        structure.damping_product(state.q, load);
        mass_product(state.rate, left);
        load += left;
        load *= -1.;
        add_interface_forces(damping, state.q, load);
        add_delayed(state.traction, load);
        solve(load, result);

        constexpr unsigned int corrections = 2;
        for (unsigned int i = 0; i < corrections; ++i)
        {
          structure.stiffness_product(result, left);
          left.sadd(-1., 1., load);
          add_interface_forces(stiffness, result, left);
          solve(left, correction);
          result += correction;
        }
        return result;
      }

      /// Adds what the rates of tractions take off the forces that follow displacements and velocities at once.
      void add_delayed(const Vector<double> &rates, Vector<double> &sum) const
      {
        if (n_delays() == 0)
          return;
        Vector<double> values(n_forces);
        for (unsigned int k = 0; k < n_delays(); ++k)
          values.add(-forces.delays[k].time * rates[k], forces.delays[k].force);
        for (unsigned int a = 0; a < n_forces; ++a)
          structure.interface().add_force(forces.dofs[a], values[a], sum);
      }

      Vector<double> loaded_displacements(const Vector<double> &q) const
      {
        const auto all = structure.interface().displacements(q);
        Vector<double> z(n_forces);
        for (unsigned int a = 0; a < z.size(); ++a)
          z[a] = all[forces.dofs[a]];
        return z;
      }

      void add_interface_forces(const FullMatrix<double> &matrix, const Vector<double> &q, Vector<double> &sum) const
      {
        if (n_forces == 0)
          return;
        const auto z = loaded_displacements(q);
        Vector<double> values(z.size());
        matrix.vmult(values, z);
        for (unsigned int a = 0; a < n_forces; ++a)
          structure.interface().add_force(forces.dofs[a], values[a], sum);
      }

      /// With the stiffness of structure and forces: f = A (1 - G A)^-1 z where the structure alone went to z.
      void solve(const Vector<double> &right_hand_side, Vector<double> &q) const
      {
        structure.solve_statics(right_hand_side, q);
        if (n_forces == 0)
          return;
        auto z = loaded_displacements(q);
        portable.solve(z);
        Vector<double> values(n_forces);
        stiffness.vmult(values, z);
        for (unsigned int a = 0; a < n_forces; ++a)
          q.add(values[a], responses[a]);
      }
    };

    using Complex = std::complex<double>;

    /// Relative residual at which the method of Arnoldi has found an eigenpair. Solutions have errors of this size.
    constexpr double tolerance = 1e-12;

    struct RitzPair
    {
      Complex value; ///< of the inverse, imaginary part <= 0
      std::array<Vector<double>, 2> vector;
      double residual; ///< over the value's size
    };

    /// The method of Arnoldi in the energy's product, without restarts: problem * V = V H + last * e^T.
    class KrylovSpace
    {
    public:
      KrylovSpace(const InverseProblem &inverse_problem, const unsigned int largest)
          : problem(inverse_problem)
          , most(std::min(largest, problem.size()))
          , projected(most + 1, most)
      {
        exhausted = !start();
      }

      unsigned int size() const
      {
        return n;
      }

      /// Returns true if the subspace cannot grow.
      bool is_full() const
      {
        return exhausted || n == most;
      }

      void grow()
      {
        SparseState next    = problem.apply(basis[n]);
        const double before = std::sqrt(std::max(0., problem.momenta(next) * next));
        Vector<double> column(n + 1);
        const double left = orthogonalise(next, column);
        for (unsigned int i = 0; i <= n; ++i)
          projected(i, n) = column[i];
        ++n;
        if (left > 1e-13 * before)
        {
          projected(n, n - 1) = left;
          next.scale(1. / left);
          basis.push_back(std::move(next));
        }
        else
          exhausted = !start();
      }

      /// Ritz pairs by decreasing size. One of a complex pair stands for both.
      std::vector<RitzPair> pairs() const
      {
        FullMatrix<double> square(n, n);
        square.fill(projected);
        std::vector<RitzPair> result;
        for (auto &pair : eigenpairs(square))
        {
          pair.vector[1] *= -1.;
          const double last = n < basis.size() ? projected(n, n - 1) : 0.;
          const double tail = std::hypot(pair.vector[0][n - 1], pair.vector[1][n - 1]);
          result.push_back({ std::conj(pair.value), pair.vector, last * tail / std::abs(pair.value) });
        }
        std::sort(result.begin(), result.end(),
                  [](const auto &a, const auto &b) { return std::abs(a.value) > std::abs(b.value); });
        return result;
      }

      SparseState combined(const Vector<double> &factors) const
      {
        SparseState result = problem.zero();
        for (unsigned int i = 0; i < n; ++i)
          result.add(factors[i], basis[i]);
        return result;
      }

    private:
      const InverseProblem &problem;
      const unsigned int most;
      unsigned int n        = 0; ///< columns that are known
      unsigned int n_starts = 0;
      bool exhausted        = false;
      std::vector<SparseState> basis;
      FullMatrix<double> projected;

      /// Subtracts what lies in the space, twice, as once leaves round-off of the first; returns the energy's root of the rest.
      double orthogonalise(SparseState &state, Vector<double> &parts) const
      {
        for (unsigned int pass = 0; pass < 2; ++pass)
        {
          const auto momenta = problem.momenta(state);
          for (unsigned int i = 0; i < basis.size(); ++i)
          {
            const double part = basis[i] * momenta;
            parts[i] += part;
            state.add(-part, basis[i]);
          }
        }
        return std::sqrt(std::max(0., problem.momenta(state) * state));
      }

      /// Another direction, the same in every run; false if there is none left.
      bool start()
      {
        SparseState state = problem.zero();
        ++n_starts;
        for (unsigned int i = 0; i < state.q.size(); ++i)
          state.rate[i] = 1. + 0.5 * std::sin(n_starts * (1. + i));
        state               = problem.apply(problem.apply(state));
        const double before = std::sqrt(std::max(0., problem.momenta(state) * state));
        Vector<double> parts(static_cast<unsigned int>(basis.size()));
        const double left = orthogonalise(state, parts);
        if (!(left > 1e-10 * before))
          return false;
        state.scale(1. / left);
        basis.push_back(std::move(state));
        return true;
      }
    };

    /// Far enough within the decaying half for what its residual leaves open. A damped layer and friction's delays have bands of
    /// such eigenvalues, close to each other, that no space of this kind tells apart.
    bool surely_decays(const RitzPair &pair)
    {
      constexpr double condition = 10.;
      return pair.value.real() < -condition * pair.residual * std::abs(pair.value);
    }

    /// Pairs that are found, up to the first that is not and may grow.
    std::vector<RitzPair> found_pairs(const KrylovSpace &space)
    {
      std::vector<RitzPair> result;
      for (auto &pair : space.pairs())
        if (pair.residual <= tolerance)
          result.push_back(std::move(pair));
        else if (!surely_decays(pair))
          break;
      return result;
    }

    unsigned int n_vibrations(const std::vector<RitzPair> &pairs)
    {
      return static_cast<unsigned int>(
          std::count_if(pairs.begin(), pairs.end(), [](const auto &pair) { return pair.value.imag() < 0.; }));
    }

    StructureMode refined(const RitzPair &pair, const KrylovSpace &space, const InverseProblem &problem)
    {
      const SparseState before[] = { space.combined(pair.vector[0]), space.combined(pair.vector[1]) };
      const SparseState after[]  = { problem.apply(before[0]), problem.apply(before[1]) };
      StructureMode mode;
      mode.eigenvalue = { (1. / pair.value).real(), std::abs((1. / pair.value).imag()) };
      double change   = 0.;
      double whole    = 0.;
      for (unsigned int part = 0; part < 2; ++part)
      {
        SparseState left = after[part];
        left.add(-pair.value.real(), before[part]);
        left.add(part == 0 ? pair.value.imag() : -pair.value.imag(), before[1 - part]);
        change += problem.mass_form(left, std::norm(mode.eigenvalue));
        whole += problem.mass_form(after[part], std::norm(mode.eigenvalue));
        mode.coordinates[part] = after[part].q;
      }
      mode.residual = std::sqrt(change / whole);
      return mode;
    }
  } // namespace

  std::vector<StructureMode> sparse_vibrations(const SparseStructure &structure, const LinearisedForces &forces,
                                               const unsigned int number)
  {
    const InverseProblem problem(structure, forces);
    KrylovSpace space(problem, 12 * number + 100);
    std::vector<RitzPair> pairs;
    while (n_vibrations(pairs) < number && !space.is_full())
    {
      const unsigned int growth = std::max(10u, space.size() / 8);
      for (unsigned int i = 0; i < growth && !space.is_full(); ++i)
        space.grow();
      if (space.size() > number)
        pairs = found_pairs(space);
    }
    const bool all = space.size() == problem.size();
    if (n_vibrations(pairs) < number && !all)
      throw AnalysisError("only " + std::to_string(n_vibrations(pairs)) + " of " + std::to_string(number) +
                          " vibrations were found. Try fewer Stability/Modes.");

    std::vector<StructureMode> result;
    for (const auto &pair : pairs)
    {
      auto mode = refined(pair, space, problem);
      if (mode.residual < largest_backward_error)
        result.push_back(std::move(mode));
      else if (!all && (mode.eigenvalue.imag() > 0. || mode.eigenvalue.real() > 0.))
        throw AnalysisError("the vibration at " + rounded_text(mode.eigenvalue.imag() / (2. * M_PI)) +
                            " Hz was found with a backward error of " + rounded_text(mode.residual) + ", more than " +
                            rounded_text(largest_backward_error) + ". Try fewer Stability/Modes or a larger Mesh/Face size.");
    }
    return result;
  }
} // namespace sprag
