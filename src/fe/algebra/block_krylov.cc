#include "fe/algebra/block_krylov.h"

#include "base/errors.h"

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
    constexpr unsigned int width = 4;     ///< of a block
    constexpr double converged   = 1e-13; ///< residual over the value
    constexpr double round_off   = 1e-15; ///< over the largest value

    using Columns = std::vector<double>;

    /// A^T B of columns with n numbers, as rows of A's columns.
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
      const int rows = static_cast<int>(n), columns = static_cast<int>(c.n()), of_a = static_cast<int>(c.m());
      const double once = 1.;
      gemm("N", "T", &rows, &columns, &of_a, &factor, a.data(), &rows, &c(0, 0), &columns, &once, b.data(), &rows);
    }

    /// By pieces, whose sums round off less than one of all.
    double product(const double *a, const double *b, const std::size_t n)
    {
      constexpr std::size_t piece = 256;
      double result               = 0.;
      for (std::size_t begin = 0; begin < n; begin += piece)
        result += std::inner_product(a + begin, a + std::min(n, begin + piece), b + begin, 0.);
      return result;
    }

    /// A basis with V^T M V = 1 that grows block by block, and the operator K^-1 M in it.
    class KrylovSpace
    {
    public:
      explicit KrylovSpace(const Pencil &of)
          : pencil(of)
          , n(of.size)
      {
        std::mt19937 numbers;
        Columns first(width * n);
        for (double &value : first)
          value = static_cast<double>(numbers()) / static_cast<double>(std::mt19937::max()) - 0.5;
        add(pencil.inverse_stiffness(pencil.mass(std::move(first))));
      }

      unsigned int dimension() const
      {
        return width * static_cast<unsigned int>(blocks.size());
      }

      /// Adds what the operator makes of the last block.
      void grow()
      {
        add(pencil.inverse_stiffness(blocks.back().inertia));
      }

      struct Ritz
      {
        Vector<double> values; ///< of the operator, increasing; without the last block, of which it is not known
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

      /// Leaves of all but the last block so many of the vectors with the largest values, which goes on as if these had been
      /// found first (thick restart).
      void keep(const Ritz &ritz, const unsigned int number)
      {
        std::vector<Block> kept(number / width);
        std::vector<std::vector<double>> kept_operator;
        for (unsigned int k = 0; k < number; ++k)
        {
          const unsigned int place = ritz.values.size() - 1 - k;
          const auto &vector       = ritz.vectors[place];
          auto &[columns, inertia] = kept[k / width];
          const auto add_to        = [](Columns more, Columns &all) { all.insert(all.end(), more.begin(), more.end()); };
          add_to(combination(vector, &Block::columns), columns);
          add_to(combination(vector, &Block::inertia), inertia);
          auto &made_of = kept_operator.emplace_back(number + width, 0.);
          made_of[k]    = ritz.values[place];
          for (unsigned int i = 0; i < width; ++i)
            made_of[number + i] = onto_last_block(vector, i);
        }
        kept.push_back(std::move(blocks.back()));
        blocks            = std::move(kept);
        operator_in_space = std::move(kept_operator);
      }

      Columns combination(const Vector<double> &amounts) const
      {
        return combination(amounts, &Block::columns);
      }

    private:
      struct Block
      {
        Columns columns;
        Columns inertia; ///< M times these
      };

      const Pencil &pencil;
      const std::size_t n;
      std::vector<Block> blocks;
      std::vector<std::vector<double>> operator_in_space; ///< of each column, what it becomes by all, the next block's included

      Columns combination(const Vector<double> &amounts, Columns Block::*const of) const
      {
        Columns result(n, 0.);
        for (unsigned int i = 0; i < amounts.size(); ++i)
        {
          const double *const column = &(blocks[i / width].*of)[i % width * n];
          for (std::size_t k = 0; k < n; ++k)
            result[k] += amounts[i] * column[k];
        }
        return result;
      }

      /// The share of a column of the last block in what the operator makes of a vector of the others.
      double onto_last_block(const Vector<double> &vector, const unsigned int column) const
      {
        const unsigned int row = vector.size() + column;
        double sum             = 0.;
        for (unsigned int i = 0; i < vector.size(); ++i)
          sum += row < operator_in_space[i].size() ? operator_in_space[i][row] * vector[i] : 0.;
        return sum;
      }

      /// Adds a block, orthogonal to all and in itself, and notes what it was made of.
      void add(Columns columns)
      {
        const unsigned int before = dimension();
        Columns inertia           = pencil.mass(columns);
        const auto first          = orthonormalise(columns, inertia);
        inertia                   = pencil.mass(columns); // what cancelled in the columns did not do so alike in this
        const auto second         = orthonormalise(columns, inertia);
        for (unsigned int j = 0; j < width && before > 0; ++j)
        {
          auto &made_of = operator_in_space.emplace_back(before + width, 0.);
          for (unsigned int i = 0; i < before + width; ++i)
          {
            made_of[i] = i < before ? first(i, j) : 0.;
            for (unsigned int k = 0; k < width; ++k)
              made_of[i] += second(i, k) * first(before + k, j);
          }
        }
        blocks.push_back({ std::move(columns), std::move(inertia) });
      }

      /// Returns how the columns, as they were, are made of the space and of what they become.
      FullMatrix<double> orthonormalise(Columns &columns, Columns &inertia) const
      {
        FullMatrix<double> made_of(dimension() + width, width);
        for (unsigned int b = 0; b < blocks.size(); ++b)
        {
          const auto shares = products(blocks[b].columns, inertia, n);
          add_combinations(-1., blocks[b].columns, shares, n, columns);
          add_combinations(-1., blocks[b].inertia, shares, n, inertia);
          made_of.fill(shares, b * width);
        }
        for (unsigned int j = 0; j < width; ++j)
        {
          for (unsigned int i = 0; i < j; ++i)
          {
            const double share = made_of(dimension() + i, j) = product(&columns[i * n], &inertia[j * n], n);
            for (std::size_t k = 0; k < n; ++k)
            {
              columns[j * n + k] -= share * columns[i * n + k];
              inertia[j * n + k] -= share * inertia[i * n + k];
            }
          }
          const double size = made_of(dimension() + j, j) = std::sqrt(product(&columns[j * n], &inertia[j * n], n));
          if (!(size > 0.))
            throw AnalysisError("the space in which vibration modes are sought does not grow");
          for (std::size_t k = j * n; k < (j + 1) * n; ++k)
          {
            columns[k] /= size;
            inertia[k] /= size;
          }
        }
        return made_of;
      }
    };
  } // namespace

  std::vector<Eigenpair> lowest_eigenpairs(const Pencil &pencil, const unsigned int wanted)
  {
    constexpr unsigned int most_restarts = 100;
    const unsigned int kept              = (wanted / width + 3) * width;
    const unsigned int most              = 4 * kept;
    KrylovSpace space(pencil);
    for (unsigned int restarts = 0;;)
    {
      space.grow();
      const auto ritz          = space.ritz();
      const auto &values       = ritz.values;
      const unsigned int found = values.size();
      unsigned int first       = found; // of those that are wanted, which have the largest values
      while (first > 0 && found - first < wanted &&
             ritz.residuals[first - 1] < converged * values[first - 1] + round_off * values[found - 1])
        --first;
      if (found - first == wanted)
      {
        std::vector<Eigenpair> result;
        for (unsigned int i = found; i-- > first;)
          result.push_back({ 1. / values[i], space.combination(ritz.vectors[i]) });
        return result;
      }
      if (space.dimension() < most)
        continue;
      if (++restarts > most_restarts)
        throw AnalysisError("only " + std::to_string(found - first) + " of " + std::to_string(wanted) +
                            " vibration modes were found");
      space.keep(ritz, kept);
    }
  }
} // namespace sprag
