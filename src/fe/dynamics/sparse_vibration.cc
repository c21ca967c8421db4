// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_vibration.h"

#include "base/eigenvalues.h"
#include "base/errors.h"
#include "base/text.h"
#include "fe/dynamics/inverse_problem.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
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

      /// Whether it cannot grow.
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

      /// By decreasing size. Of a complex pair one stands for both.
      std::vector<RitzPair> pairs() const
      {
        FullMatrix<double> square(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            square(i, j) = projected(i, j);
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

  std::vector<StructureMode> sparse_vibrations(const SparseOperator &structure, const PortPerturbation &forces,
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
