// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/block_krylov.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int width = krylov_block_width;
    constexpr double converged   = 1e-13; ///< residual over the value
    constexpr double round_off   = 1e-15; ///< over the largest value

    using Columns = std::vector<double>;

    /// Returns A^T B, where the columns of both have n numbers.
    FullMatrix<double> products(const Columns &a, const Columns &b, const std::size_t n)
    {
      const int rows = static_cast<int>(a.size() / n), columns = static_cast<int>(b.size() / n), length = static_cast<int>(n);
      const double once = 1., none = 0.;
      FullMatrix<double> result(rows, columns); // row by row, which is column by column of what is transposed
      gemm("T", "N", &columns, &rows, &length, &once, b.data(), &length, a.data(), &length, &none, &result(0, 0), &columns);
      return result;
    }

    /// B += factor A C.
    void add_combinations(const double factor, const Columns &a, const FullMatrix<double> &c, const std::size_t n, Columns &b)
    {
      const int rows = static_cast<int>(n), columns = static_cast<int>(c.n()), n_inner = static_cast<int>(c.m());
      const double once = 1.;
      gemm("N", "T", &rows, &columns, &n_inner, &factor, a.data(), &rows, &c(0, 0), &columns, &once, b.data(), &rows);
    }

    /// Product of two vectors by pieces, whose sums have less round-off than one sum of all.
    double product(const double *a, const double *b, const std::size_t n)
    {
      constexpr std::size_t piece = 256;
      double result               = 0.;
      for (std::size_t begin = 0; begin < n; begin += piece)
        result += std::inner_product(a + begin, a + std::min(n, begin + piece), b + begin, 0.);
      return result;
    }

    /// A basis with V^T M V = 1 that grows block by block, and the operator K^-1 M in it.
    class BlockSpace
    {
    public:
      /// Allocates that many columns.
      BlockSpace(const Pencil &pencil_, const unsigned int most)
          : pencil(pencil_)
          , n(pencil_.size)
      {
        basis.reserve(most * n);
        inertia.reserve(most * n);
        std::mt19937 numbers;
        Columns first(width * n);
        for (double &value : first)
          value = static_cast<double>(numbers()) / static_cast<double>(std::mt19937::max()) - 0.5;
        add(pencil.inverse_stiffness(pencil.mass(std::move(first))));
      }

      unsigned int dimension() const
      {
        return static_cast<unsigned int>(basis.size() / n);
      }

      /// Applies the operator to the last block and adds the result as the next one.
      void grow()
      {
        add(pencil.inverse_stiffness(last_block(inertia)));
      }

      struct Ritz
      {
        Vector<double> values; ///< eigenvalues, increasing; the last block, whose image is not known yet, is left out
        std::vector<Vector<double>> vectors;
        std::vector<double> residuals; ///< sizes, in the norm of M
      };

      Ritz ritz() const
      {
        const unsigned int known = dimension() - width;
        LAPACKFullMatrix<double> matrix(known);
        for (unsigned int i = 0; i < known; ++i)
          for (unsigned int j = 0; j < known; ++j)
            matrix(i, j) = operator_in_space[std::max(i, j)][std::min(i, j)]; // a column knows all rows before the next block
        Ritz result;
        FullMatrix<double> vectors;
        matrix.compute_eigenvalues_symmetric(0., matrix.frobenius_norm(), 0., result.values, vectors);
        for (unsigned int j = 0; j < result.values.size(); ++j)
        {
          auto &vector = result.vectors.emplace_back(known);
          for (unsigned int i = 0; i < known; ++i)
            vector[i] = vectors(i, j);
          double squares = 0.;
          for (unsigned int i = 0; i < width; ++i)
            squares += std::pow(onto_last_block(vector, i), 2);
          result.residuals.push_back(std::sqrt(squares));
        }
        return result;
      }

      /// Restarts the iteration (thick restart): keeps the last block and, in place of all others, `number` Ritz vectors with the
      /// largest values.
      void keep(const Ritz &ritz, const unsigned int number)
      {
        FullMatrix<double> vectors(dimension() - width, number);
        std::vector<std::vector<double>> kept_operator;
        for (unsigned int k = 0; k < number; ++k)
        {
          const unsigned int place = ritz.values.size() - 1 - k;
          for (unsigned int i = 0; i < vectors.m(); ++i)
            vectors(i, k) = ritz.vectors[place][i];
          // The Ritz value alone is stored: the last block's own columns hold the coupling with it, as the operator is
          // symmetric.
          kept_operator.emplace_back(number, 0.)[k] = ritz.values[place];
        }
        for (auto *const columns : { &basis, &inertia })
        {
          const auto last = last_block(*columns);
          Columns kept(number * n, 0.);
          add_combinations(1., *columns, vectors, n, kept);
          columns->assign(kept.begin(), kept.end());
          columns->insert(columns->end(), last.begin(), last.end());
        }
        operator_in_space = std::move(kept_operator);
      }

      Columns combination(const Vector<double> &amounts) const
      {
        Columns result(n, 0.);
        for (unsigned int i = 0; i < amounts.size(); ++i)
          for (std::size_t k = 0; k < n; ++k)
            result[k] += amounts[i] * basis[i * n + k];
        return result;
      }

    private:
      const Pencil &pencil;
      const std::size_t n;
      Columns basis;
      Columns inertia; ///< M times this
      std::vector<std::vector<double>>
          operator_in_space; ///< of each column, its image by coefficients of the basis, the next block included

      Columns last_block(const Columns &basis_columns) const
      {
        return Columns(basis_columns.end() - static_cast<std::ptrdiff_t>(width * n), basis_columns.end());
      }

      /// Returns the coefficient of a column of the last block in the image of a vector of the other blocks.
      double onto_last_block(const Vector<double> &vector, const unsigned int column) const
      {
        const unsigned int row = vector.size() + column;
        double sum             = 0.;
        for (unsigned int i = 0; i < vector.size(); ++i)
          sum += row < operator_in_space[i].size() ? operator_in_space[i][row] * vector[i] : 0.;
        return sum;
      }

      /// Makes a block orthonormal to the basis and in itself, adds it, and stores its former coefficients as the operator's.
      void add(Columns block)
      {
        const unsigned int before = dimension();
        Columns inertia_block     = pencil.mass(block);
        const auto first          = orthonormalise(block, inertia_block);
        inertia_block     = pencil.mass(block); // computed anew, as cancellation left other round-off in it than in the block
        const auto second = orthonormalise(block, inertia_block);
        for (unsigned int j = 0; j < width && before > 0; ++j)
        {
          auto &coefficients = operator_in_space.emplace_back(before + width, 0.);
          for (unsigned int i = 0; i < before + width; ++i)
          {
            coefficients[i] = i < before ? first(i, j) : 0.;
            for (unsigned int k = 0; k < width; ++k)
              coefficients[i] += second(i, k) * first(before + k, j);
          }
        }
        basis.insert(basis.end(), block.begin(), block.end());
        inertia.insert(inertia.end(), inertia_block.begin(), inertia_block.end());
      }

      /// Makes a block orthogonal to the basis and in itself. Returns how its columns, as they were, are made of the basis and of
      /// what they become.
      FullMatrix<double> orthonormalise(Columns &block, Columns &inertia_block) const
      {
        const unsigned int before = dimension();
        FullMatrix<double> coefficients(before + width, width);
        if (before > 0)
        {
          const auto shares = products(basis, inertia_block, n);
          add_combinations(-1., basis, shares, n, block);
          add_combinations(-1., inertia, shares, n, inertia_block);
          coefficients.fill(shares);
        }
        for (unsigned int j = 0; j < width; ++j)
        {
          double *const column = &block[j * n], *const inertia_column = &inertia_block[j * n];
          for (unsigned int i = 0; i < j; ++i)
          {
            const double share = coefficients(before + i, j) = product(&block[i * n], inertia_column, n);
            for (std::size_t k = 0; k < n; ++k)
            {
              column[k] -= share * block[i * n + k];
              inertia_column[k] -= share * inertia_block[i * n + k];
            }
          }
          const double size = coefficients(before + j, j) = std::sqrt(product(column, inertia_column, n));
          if (!(size > 0.))
            throw AnalysisError("the space in which vibration modes are sought does not grow");
          for (std::size_t k = 0; k < n; ++k)
          {
            column[k] /= size;
            inertia_column[k] /= size;
          }
        }
        return coefficients;
      }
    };

    std::vector<NormalMode> lowest_pairs(const Pencil &pencil, const unsigned int n_modes)
    {
      constexpr unsigned int most_restarts = 100;
      const unsigned int most              = most_columns(n_modes);
      BlockSpace space(pencil, most);
      for (unsigned int restarts = 0;;)
      {
        space.grow();
        const auto ritz          = space.ritz();
        const auto &values       = ritz.values;
        const unsigned int found = values.size();
        unsigned int first       = found; // converged pair of the n_modes with the largest values
        while (first > 0 && found - first < n_modes &&
               ritz.residuals[first - 1] < converged * values[first - 1] + round_off * values[found - 1])
          --first;
        if (found - first == n_modes)
        {
          std::vector<NormalMode> result;
          for (unsigned int i = found; i-- > first;)
            result.push_back({ 1. / values[i], space.combination(ritz.vectors[i]) });
          return result;
        }
        if (space.dimension() < most)
          continue;
        if (++restarts > most_restarts)
          throw AnalysisError("only " + std::to_string(found - first) + " of " + std::to_string(n_modes) +
                              " vibration modes were found");
        space.keep(ritz, kept_columns(n_modes));
      }
    }

    /// All pairs, of K^-1 M phi = phi/lambda with dense matrices.
    std::vector<NormalMode> all_pairs(const Pencil &pencil)
    {
      const int n = static_cast<int>(pencil.size), kind = 2, work_size = 40 * n; // kind: A B x = lambda x
      Columns unit(pencil.size * pencil.size, 0.), values(pencil.size), work(static_cast<std::size_t>(work_size));
      for (std::size_t i = 0; i < pencil.size; ++i)
        unit[i * (pencil.size + 1)] = 1.;
      auto vectors = pencil.inverse_stiffness(unit), mass = pencil.mass(std::move(unit));
      int info = 0;
      sygv(&kind, "V", "U", &n, vectors.data(), &n, mass.data(), &n, values.data(), work.data(), &work_size, &info);
      if (info != 0)
        throw AnalysisError("LAPACK does not find the vibration modes");
      std::vector<NormalMode> result;
      for (std::size_t i = pencil.size; i-- > 0;)
        result.push_back({ 1. / values[i], Columns(&vectors[i * pencil.size], &vectors[i * pencil.size] + n) });
      return result;
    }

    void orient(std::vector<double> &mode)
    {
      constexpr double tie_tolerance = 1e-6; // relative difference of displacements, as those of both sides in a mode that twists
      double largest                 = 0.;
      for (const double value : mode)
        if (std::abs(value) > (1. + tie_tolerance) * std::abs(largest))
          largest = value;
      if ((std::abs(mode.back()) < 1e-8 * std::abs(largest) ? largest : mode.back()) < 0.)
        for (double &value : mode)
          value = -value;
    }

    /// Throws AnalysisError where |phi - lambda K^-1 M phi| over |phi| is too large.
    void require_residuals(const Pencil &pencil, const std::vector<NormalMode> &modes)
    {
      // Times lambda over the lowest, by which round-off grows there. Solves with more or fewer columns differ by some 1e-11 of
      // the softest motion.
      constexpr double largest_residual = 1e-9;
      Columns images;
      for (const auto &mode : modes)
        images.insert(images.end(), mode.vector.begin(), mode.vector.end());
      images = pencil.inverse_stiffness(pencil.mass(std::move(images)));
      for (std::size_t j = 0; j < modes.size(); ++j)
      {
        const auto &[value, mode] = modes[j];
        double difference = 0., size = 0.;
        for (std::size_t i = 0; i < mode.size(); ++i)
        {
          difference = std::max(difference, std::abs(value * images[j * mode.size() + i] - mode[i]));
          size       = std::max(size, std::abs(mode[i]));
        }
        if (!(difference < largest_residual * value / modes.front().value * size))
          throw AnalysisError("vibration mode " + std::to_string(j + 1) + " was found with a residual of only " +
                              number_text(difference / size));
      }
    }
  } // namespace

  Pencil::Product column_by_column(const std::size_t size, std::function<Vector<double>(const Vector<double> &)> product)
  {
    return [size, product = std::move(product)](Columns columns)
    {
      for (auto column = columns.begin(); column != columns.end(); column += static_cast<std::ptrdiff_t>(size))
      {
        const auto image = product(Vector<double>(column, column + static_cast<std::ptrdiff_t>(size)));
        std::copy(image.begin(), image.end(), column);
      }
      return columns;
    };
  }

  std::vector<NormalMode> normal_modes(const Pencil &pencil, const unsigned int n_modes)
  {
    auto modes = most_columns(n_modes) < pencil.size ? lowest_pairs(pencil, n_modes) : all_pairs(pencil);
    modes.resize(std::min<std::size_t>(n_modes, modes.size()));
    for (auto &mode : modes)
      orient(mode.vector);
    require_residuals(pencil, modes);
    return modes;
  }
} // namespace sprag
