#include "model/block_matrix.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// From so many on the zeros of a tangent are worth the search for them.
    constexpr unsigned int many_ports = 256;

    bool holds(const std::pair<unsigned int, unsigned int> &places, const unsigned int i)
    {
      return places.first <= i && i < places.second;
    }

    /// Numbers places so that those which a matrix couples are close (Cuthill and McKee), and finds how far they reach.
    struct CloseOrder
    {
      std::vector<unsigned int> at;    ///< place by its number
      std::vector<unsigned int> first; ///< number that the column of a number reaches
      std::vector<unsigned int> last;

      explicit CloseOrder(const FullMatrix<double> &matrix)
      {
        const auto n = static_cast<unsigned int>(matrix.n());
        DynamicSparsityPattern pattern(n, n);
        std::vector<types::global_dof_index> columns, number(n);
        for (unsigned int i = 0; i < n; ++i)
        {
          columns.clear();
          for (unsigned int j = 0; j < n; ++j)
            if (matrix(i, j) != 0. || matrix(j, i) != 0. || i == j)
              columns.push_back(j);
          pattern.add_entries(i, columns.begin(), columns.end(), true);
        }
        SparsityTools::reorder_Cuthill_McKee(pattern, number);
        at.resize(n);
        first.assign(n, n);
        last.assign(n, 0);
        for (unsigned int i = 0; i < n; ++i)
          at[number[i]] = i;
        for (unsigned int i = 0; i < n; ++i)
          for (auto other = pattern.begin(i); other != pattern.end(i); ++other)
          {
            const auto column = static_cast<unsigned int>(number[other->column()]);
            first[number[i]]  = std::min(first[number[i]], column);
            last[number[i]]   = std::max(last[number[i]], column);
          }
      }
    };

    /// Calls of_column(column, values) with each column of 1 - G A, where A couples each place with few others.
    template <class OfColumn>
    void subtract_sparse_product(const FullMatrix<double> &compliance, const FullMatrix<double> &tangent,
                                 const OfColumn &of_column)
    {
      constexpr unsigned int together = 48;
      const CloseOrder order(tangent);
      const auto n = static_cast<unsigned int>(tangent.n());
      for (unsigned int begin = 0; begin < n; begin += together)
      {
        const unsigned int end  = std::min(n, begin + together);
        const unsigned int low  = *std::min_element(order.first.begin() + begin, order.first.begin() + end);
        const unsigned int high = *std::max_element(order.last.begin() + begin, order.last.begin() + end) + 1;
        // G is symmetric: its rows are its columns.
        FullMatrix<double> rows(high - low, n), some(high - low, end - begin), product(end - begin, n);
        for (unsigned int k = low; k < high; ++k)
        {
          std::copy_n(&compliance(order.at[k], 0), n, &rows(k - low, 0));
          for (unsigned int j = begin; j < end; ++j)
            some(k - low, j - begin) = -tangent(order.at[k], order.at[j]);
        }
        some.Tmmult(product, rows);
        for (unsigned int j = begin; j < end; ++j)
        {
          product(j - begin, order.at[j]) += 1.;
          of_column(order.at[j], &product(j - begin, 0));
        }
      }
    }

  } // namespace

  template <class Number>
  BlockMatrix<Number>::BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                   const FullMatrix<double> &tangent)
  {
    for (const auto &block : compliance.blocks())
      if (const auto places = block.places_among(ports); places.first < places.second)
        blocks.push_back({ places, block, LAPACKFullMatrix<Number>(places.second - places.first), LAPACKFullMatrix<Number>() });
    find_columns(tangent);
    for (auto &block : blocks)
      factorise(ports, tangent, block);
    if (columns.empty())
      return;
    of_columns.reinit(static_cast<unsigned int>(columns.size()));
    for (unsigned int j = 0; j < columns.size(); ++j)
      for (unsigned int k = 0; k < columns.size(); ++k)
        of_columns(j, k) = (j == k ? 1. : 0.) + answer(columns[j], k);
    of_columns.compute_lu_factorization();
  }

  template <class Number>
  void BlockMatrix<Number>::solve(Vector<double> &values) const
  {
    for (const auto &[places, of_ports, matrix, answers] : blocks)
    {
      Vector<Number> of_block(values.begin() + places.first, values.begin() + places.second);
      matrix.solve(of_block);
      std::copy(of_block.begin(), of_block.end(), values.begin() + places.first);
    }
    if (columns.empty())
      return;
    Vector<double> of_others(static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      of_others[k] = values[columns[k]];
    of_columns.solve(of_others);
    for (const auto &[places, of_ports, matrix, answers] : blocks)
      for (unsigned int i = places.first; i < places.second; ++i)
        for (unsigned int k = 0; k < columns.size(); ++k)
          values[i] -= answers(i - places.first, k) * of_others[k];
  }

  template <class Number>
  double BlockMatrix<Number>::determinant() const
  {
    double result = columns.empty() ? 1. : of_columns.determinant();
    for (const auto &block : blocks)
      result *= block.matrix.determinant();
    return result;
  }

  template <class Number>
  void BlockMatrix<Number>::find_columns(const FullMatrix<double> &tangent)
  {
    const auto n = static_cast<unsigned int>(tangent.n());
    std::vector<char> counts(n, 0);
    for (const auto &[places, of_ports, matrix, answers] : blocks)
      for (unsigned int i = places.first; i < places.second; ++i)
      {
        const double *const row = &tangent(i, 0);
        for (unsigned int column = 0; column < places.first; ++column)
          counts[column] |= row[column] != 0.;
        for (unsigned int column = places.second; column < n; ++column)
          counts[column] |= row[column] != 0.;
      }
    for (unsigned int column = 0; column < n; ++column)
      if (counts[column])
        columns.push_back(column);
  }

  template <class Number>
  void BlockMatrix<Number>::factorise(const std::vector<unsigned int> &ports, const FullMatrix<double> &tangent,
                                      Block &block) const
  {
    const auto [first, last] = block.places;
    const auto &of           = block.of_ports;
    const unsigned int n     = last - first;
    FullMatrix<double> loaded(n), of_block(n), product(n < many_ports ? n : 0);
    of_block.fill(tangent, 0, 0, first, first);
    for (unsigned int i = 0; i < n; ++i)
    {
      const double *const row = &(*of.matrix)(ports[first + i] - of.begin, 0);
      for (unsigned int j = 0; j < n; ++j)
        loaded(i, j) = row[ports[first + j] - of.begin];
    }
    if (n < many_ports)
    {
      loaded.mmult(product, of_block);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          block.matrix(i, j) = static_cast<Number>((i == j ? 1. : 0.) - product(i, j));
    }
    else
      subtract_sparse_product(loaded, of_block,
                              [&](const unsigned int column, const double *const values)
                              { std::copy_n(values, n, &block.matrix(0, column)); });
    block.matrix.compute_lu_factorization();
    if (columns.empty())
      return;
    block.answers.reinit(n, static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      if (!holds(block.places, columns[k]))
        for (unsigned int a = 0; a < n; ++a)
          if (const double force = tangent(first + a, columns[k]); force != 0.)
            for (unsigned int i = 0; i < n; ++i)
              block.answers(i, k) -= static_cast<Number>(loaded(a, i) * force); // G is symmetric
    block.matrix.solve(block.answers);
  }

  /// Of D^-1 E.
  template <class Number>
  double BlockMatrix<Number>::answer(const unsigned int row, const unsigned int k) const
  {
    const auto block =
        std::find_if(blocks.begin(), blocks.end(), [&](const auto &candidate) { return holds(candidate.places, row); });
    return block->answers(row - block->places.first, k);
  }

  template class BlockMatrix<double>;
  template class BlockMatrix<float>;
} // namespace sprag
