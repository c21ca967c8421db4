// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/modal_vibration.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "model/structure/eigenvalues.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;

    /// The problem A s = lambda E s in s = (q, q', u, tau).
    class StateProblem
    {
    public:
      StateProblem(const ModalData &data_, const LinearisedForces &forces_)
          : data(data_)
          , forces(forces_)
          , n(static_cast<unsigned int>(data.stiffness.size()))
          , n_forces(static_cast<unsigned int>(forces.dofs.size()))
      {
        for (unsigned int a = 0; a < n_forces; ++a)
          if (forces.dofs[a] < data.face_compliance.m())
            ++n_static;
        if (n_forces > 0)
        {
          shapes.reinit(n_forces, n);
          shapes.extract_submatrix_from(data.shapes, forces.dofs, all_dofs(n));
        }
        assemble();
      }

      /// Eigenpairs of A^-1 E: 1 / lambda.
      std::vector<Eigenpair> inverse_pairs(const bool vectors) const
      {
        LAPACKFullMatrix<double> a(size());
        LAPACKFullMatrix<double> e(size());
        a = state_matrix;
        e = rate_matrix;
        try
        {
          a.compute_lu_factorization();
          a.solve(e);
        }
        catch (const ExceptionBase &)
        {
          throw AnalysisError("the slide is at the limit of its stability: it has a mode without stiffness");
        }
        FullMatrix<double> quotient(size(), size());
        quotient = e;
        return eigenpairs(quotient, vectors);
      }

      StructureMode mode(const Complex lambda, const Eigenpair &pair) const
      {
        StructureMode result;
        result.eigenvalue = lambda;
        for (unsigned int part = 0; part < 2; ++part)
        {
          result.coordinates[part].reinit(n);
          std::copy(pair.vector[part].begin(), pair.vector[part].begin() + n, result.coordinates[part].begin());
          result.face_force[part].reinit(static_cast<unsigned int>(data.face_compliance.m()));
        }
        const auto state    = complex_state(pair);
        const auto by_modes = modal_amplitudes(state);
        auto z              = by_modes;
        for (unsigned int a = 0; a < n_static; ++a)
          z[a] += state[2 * n + a];
        const auto f = forces.forces(lambda, z);
        for (unsigned int a = 0; a < n_static; ++a)
        {
          const Complex elastic                = f[a] / (1. + lambda * data.relaxation);
          result.face_force[0][forces.dofs[a]] = elastic.real();
          result.face_force[1][forces.dofs[a]] = elastic.imag();
        }
        result.residual = backward_error(lambda, state, by_modes, f);
        return result;
      }

    private:
      const ModalData &data;
      const LinearisedForces &forces;
      const unsigned int n;
      const unsigned int n_forces;
      unsigned int n_static = 0; ///< of the forces, the first ones
      FullMatrix<double> shapes; ///< a row a force
      FullMatrix<double> state_matrix;
      FullMatrix<double> rate_matrix;

      unsigned int size() const
      {
        return 2 * n + n_static + n_delays();
      }

      unsigned int n_delays() const
      {
        return static_cast<unsigned int>(forces.delays.size());
      }

      /// Adds factor * left * middle * right at a block.
      static void add_product(const FullMatrix<double> &left, const FullMatrix<double> &middle, const FullMatrix<double> &right,
                              const double factor, const unsigned int row, const unsigned int column, FullMatrix<double> &sum)
      {
        if (middle.m() == 0 || left.m() == 0 || right.n() == 0)
          return;
        FullMatrix<double> half(left.m(), middle.n());
        FullMatrix<double> whole(left.m(), right.n());
        left.mmult(half, middle);
        half.mmult(whole, right);
        sum.add(whole, factor, row, column);
      }

      void assemble()
      {
        const unsigned int at_u = 2 * n;
        FullMatrix<double> transposed(n, n_forces);
        transposed.copy_transposed(shapes);
        FullMatrix<double> into_static(n_forces, n_static);
        FullMatrix<double> compliance(n_static, n_forces);
        for (unsigned int a = 0; a < n_static; ++a)
        {
          into_static(a, a) = 1.;
          for (unsigned int b = 0; b < n_static; ++b)
            compliance(a, b) = data.face_compliance(forces.dofs[a], forces.dofs[b]);
        }
        state_matrix.reinit(size(), size());
        rate_matrix.reinit(size(), size());
        for (unsigned int i = 0; i < n; ++i)
        {
          state_matrix(i, n + i) = 1.;
          rate_matrix(i, i)      = 1.;
          state_matrix(n + i, i) -= data.stiffness[i];
          rate_matrix(n + i, n + i) += 1.;
          for (unsigned int j = 0; j < n; ++j)
            state_matrix(n + i, n + j) -= data.damping(i, j);
        }
        for (unsigned int a = 0; a < n_static; ++a)
        {
          state_matrix(at_u + a, at_u + a) -= 1.;
          rate_matrix(at_u + a, at_u + a) += data.relaxation;
        }
        const auto stiffness = forces.immediate_stiffness();
        const auto damping   = forces.immediate_damping();
        add_product(transposed, stiffness, shapes, 1., n, 0, state_matrix);
        add_product(transposed, damping, shapes, 1., n, n, state_matrix);
        add_product(transposed, stiffness, into_static, 1., n, at_u, state_matrix);
        add_product(transposed, damping, into_static, -1., n, at_u, rate_matrix);
        add_product(transposed, forces.inertia, shapes, 1., n, n, rate_matrix);
        add_product(compliance, stiffness, shapes, 1., at_u, 0, state_matrix);
        add_product(compliance, damping, shapes, 1., at_u, n, state_matrix);
        add_product(compliance, stiffness, into_static, 1., at_u, at_u, state_matrix);
        add_product(compliance, damping, into_static, -1., at_u, at_u, rate_matrix);
        if (n_delays() > 0)
          assemble_delays(transposed, into_static, compliance);
      }

      /// time tau' + tau = stiffness_row . z + rate_row . z', and tau's forces.
      void assemble_delays(const FullMatrix<double> &transposed, const FullMatrix<double> &into_static,
                           const FullMatrix<double> &compliance)
      {
        const unsigned int at_u   = 2 * n;
        const unsigned int at_tau = at_u + n_static;
        FullMatrix<double> force(n_forces, n_delays()), stiffness(n_delays(), n_forces), rate(n_delays(), n_forces);
        const FullMatrix<double> one_force = dealii::IdentityMatrix(n_forces);
        const FullMatrix<double> one_delay = dealii::IdentityMatrix(n_delays());
        for (unsigned int i = 0; i < n_delays(); ++i)
        {
          const auto &delay = forces.delays[i];
          state_matrix(at_tau + i, at_tau + i) -= 1.;
          rate_matrix(at_tau + i, at_tau + i) += delay.time;
          for (unsigned int a = 0; a < n_forces; ++a)
          {
            force(a, i)     = delay.force[a];
            stiffness(i, a) = delay.stiffness_row[a];
            rate(i, a)      = delay.rate_row[a];
          }
        }
        add_product(transposed, force, one_delay, 1., n, at_tau, state_matrix);
        add_product(compliance, force, one_delay, 1., at_u, at_tau, state_matrix);
        add_product(stiffness, one_force, shapes, 1., at_tau, 0, state_matrix);
        add_product(rate, one_force, shapes, 1., at_tau, n, state_matrix);
        add_product(stiffness, one_force, into_static, 1., at_tau, at_u, state_matrix);
        add_product(rate, one_force, into_static, -1., at_tau, at_u, rate_matrix);
      }

      static std::vector<Complex> complex_state(const Eigenpair &pair)
      {
        std::vector<Complex> result;
        for (unsigned int i = 0; i < pair.vector[0].size(); ++i)
          result.emplace_back(pair.vector[0][i], pair.vector[1][i]);
        return result;
      }

      /// Interface displacements by the modes alone.
      std::vector<Complex> modal_amplitudes(const std::vector<Complex> &state) const
      {
        std::vector<Complex> result(n_forces);
        for (unsigned int a = 0; a < n_forces; ++a)
          for (unsigned int i = 0; i < n; ++i)
            result[a] += shapes(a, i) * state[i];
        return result;
      }

      /// Residual in modes and static shapes over the sum of the terms' sizes, by their parts in the displacements.
      double backward_error(const Complex lambda, const std::vector<Complex> &state, const std::vector<Complex> &by_modes,
                            const std::vector<Complex> &f) const
      {
        double modal_norm  = 0.;
        double static_norm = 0.;
        for (unsigned int a = 0; a < n_static; ++a)
        {
          modal_norm += std::norm(by_modes[a]);
          static_norm += std::norm(state[2 * n + a]);
        }
        if (static_norm == 0.)
          return modal_error(lambda, state, f);
        modal_norm  = std::sqrt(modal_norm);
        static_norm = std::sqrt(static_norm);
        return (modal_norm * modal_error(lambda, state, f) + static_norm * static_error(lambda, state, f)) /
               (modal_norm + static_norm);
      }

      double modal_error(const Complex lambda, const std::vector<Complex> &state, const std::vector<Complex> &f) const
      {
        double residual = 0.;
        double size     = 0.;
        for (unsigned int i = 0; i < n; ++i)
        {
          const Complex q = state[i];
          Complex damped, driven;
          double damped_size = 0., driven_size = 0.;
          for (unsigned int j = 0; j < n; ++j)
          {
            const Complex term = lambda * data.damping(i, j) * state[j];
            damped += term;
            damped_size += std::abs(term);
          }
          for (unsigned int a = 0; a < n_forces; ++a)
          {
            driven += shapes(a, i) * f[a];
            driven_size += std::abs(shapes(a, i) * f[a]);
          }
          residual += std::norm(lambda * lambda * q + damped + data.stiffness[i] * q - driven);
          size += std::pow(std::abs(lambda * lambda * q) + damped_size + data.stiffness[i] * std::abs(q) + driven_size, 2);
        }
        return std::sqrt(residual / size);
      }

      double static_error(const Complex lambda, const std::vector<Complex> &state, const std::vector<Complex> &f) const
      {
        double residual = 0.;
        double size     = 0.;
        for (unsigned int a = 0; a < n_static; ++a)
        {
          const Complex u = state[2 * n + a];
          Complex elastic;
          double elastic_size = 0.;
          for (unsigned int b = 0; b < n_static; ++b)
          {
            const Complex term = data.face_compliance(forces.dofs[a], forces.dofs[b]) * f[b];
            elastic += term;
            elastic_size += std::abs(term);
          }
          residual += std::norm(u + lambda * data.relaxation * u - elastic);
          size += std::pow((1. + std::abs(lambda) * data.relaxation) * std::abs(u) + elastic_size, 2);
        }
        return std::sqrt(residual / size);
      }
    };
  } // namespace

  std::vector<StructureMode> modal_vibrations(const ModalData &data, const LinearisedForces &forces, const bool shapes)
  {
    constexpr double widest     = 1e-10;
    constexpr double free_creep = 1e-10;
    const double highest_rate   = std::sqrt(*std::max_element(data.stiffness.begin(), data.stiffness.end()));
    const auto joined           = forces.with_joined_delays(highest_rate);
    const StateProblem problem(data, joined);
    const auto pairs    = problem.inverse_pairs(shapes);
    const double lowest = largest(pairs, [](const auto &pair) { return pair.value; });
    std::vector<StructureMode> result;
    for (auto pair : pairs)
    {
      if (std::abs(pair.value) <= widest * lowest)
        continue;
      const Complex lambda = std::conj(1. / pair.value);
      // Static shapes creep back without any force on them, which leaves their elastic force 0 / 0.
      if (std::abs(1. + lambda * data.relaxation) <= free_creep)
        continue;
      if (!shapes)
      {
        result.emplace_back().eigenvalue = lambda;
        continue;
      }
      pair.vector[1] *= -1.;
      result.push_back(problem.mode(lambda, pair));
    }
    std::sort(result.begin(), result.end(),
              [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
    return result;
  }
} // namespace sprag
