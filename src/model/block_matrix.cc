#include "model/block_matrix.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/lapack_templates.h>
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

    /// Tangent of the ports of one block.
    struct TangentOfBlock
    {
      const PartOfTangent &tangent;
      unsigned int first; ///< of the block
      unsigned int n;

      double operator()(const unsigned int i, const unsigned int j) const
      {
        return tangent(first + i, first + j);
      }
    };

    /// Compliance of the ports of one block.
    struct ComplianceOfBlock
    {
      const FullMatrix<double> &matrix;
      std::vector<unsigned int> rows; ///< of the ports

      ComplianceOfBlock(const PortCompliance::Block &block, const std::vector<unsigned int> &ports, const unsigned int first,
                        const unsigned int last)
          : matrix(*block.matrix)
      {
        for (unsigned int i = first; i < last; ++i)
          rows.push_back(ports[i] - block.begin);
      }

      double operator()(const unsigned int i, const unsigned int j) const
      {
        return matrix(rows[i], rows[j]);
      }
    };

    /// Numbers places so that those which a matrix couples are close (Cuthill and McKee), and finds how far they reach.
    struct CloseOrder
    {
      std::vector<unsigned int> at;    ///< place by its number
      std::vector<unsigned int> first; ///< number that the column of a number reaches
      std::vector<unsigned int> last;

      explicit CloseOrder(const TangentOfBlock &tangent)
          : at(tangent.n)
          , first(tangent.n, tangent.n)
          , last(tangent.n, 0)
      {
        const auto pattern = pattern_of(tangent);
        std::vector<types::global_dof_index> number(tangent.n);
        SparsityTools::reorder_Cuthill_McKee(pattern, number);
        for (unsigned int i = 0; i < tangent.n; ++i)
          at[number[i]] = i;
        for (unsigned int i = 0; i < tangent.n; ++i)
          for (auto other = pattern.begin(i); other != pattern.end(i); ++other)
          {
            const auto column = static_cast<unsigned int>(number[other->column()]);
            first[number[i]]  = std::min(first[number[i]], column);
            last[number[i]]   = std::max(last[number[i]], column);
          }
      }

    private:
      static DynamicSparsityPattern pattern_of(const TangentOfBlock &tangent)
      {
        std::vector<std::vector<unsigned int>> coupled(tangent.n);
        for (unsigned int i = 0; i < tangent.n; ++i)
          for (unsigned int j = 0; j < tangent.n; ++j)
            if (i == j || tangent(i, j) != 0.)
            {
              coupled[i].push_back(j);
              coupled[j].push_back(i);
            }
        DynamicSparsityPattern result(tangent.n, tangent.n);
        for (unsigned int i = 0; i < tangent.n; ++i)
          result.add_entries(i, coupled[i].begin(), coupled[i].end());
        return result;
      }
    };

    /// 1 - G A by its definition, computed with the numbers of the result.
    template <class Number>
    void fill(const ComplianceOfBlock &compliance, const TangentOfBlock &tangent, LAPACKFullMatrix<Number> &result)
    {
      const unsigned int n = tangent.n;
      LAPACKFullMatrix<Number> loaded(n), of_block(n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          loaded(i, j)   = static_cast<Number>(-compliance(j, i)); // G is symmetric
          of_block(i, j) = static_cast<Number>(tangent(i, j));
        }
      loaded.mmult(result, of_block);
      for (unsigned int i = 0; i < n; ++i)
        result(i, i) += 1;
    }

    /// The same where A couples each place with few others.
    template <class Number>
    void fill_by_close_order(const ComplianceOfBlock &compliance, const TangentOfBlock &tangent, LAPACKFullMatrix<Number> &result)
    {
      constexpr unsigned int together = 48;
      const CloseOrder order(tangent);
      const unsigned int n = tangent.n;
      // Columns in that order; G is symmetric, so that its rows are its columns.
      std::vector<Number> ordered(static_cast<std::size_t>(n) * n), some, product(static_cast<std::size_t>(n) * together);
      auto next = ordered.begin();
      for (const unsigned int place : order.at)
      {
        const double *const row = &compliance.matrix(compliance.rows[place], 0);
        next                    = std::transform(compliance.rows.begin(), compliance.rows.end(), next,
                                                 [&](const unsigned int i) { return static_cast<Number>(row[i]); });
      }
      const types::blas_int size = n;
      const Number minus_one = -1, zero = 0;
      for (unsigned int begin = 0; begin < n; begin += together)
      {
        const unsigned int end  = std::min(n, begin + together);
        const unsigned int low  = *std::min_element(order.first.begin() + begin, order.first.begin() + end);
        const unsigned int high = *std::max_element(order.last.begin() + begin, order.last.begin() + end) + 1;
        some.clear();
        for (unsigned int j = begin; j < end; ++j)
          for (unsigned int k = low; k < high; ++k)
            some.push_back(static_cast<Number>(tangent(order.at[k], order.at[j])));
        const types::blas_int columns = end - begin, reached = high - low;
        gemm("N", "N", &size, &columns, &reached, &minus_one, &ordered[static_cast<std::size_t>(low) * n], &size, some.data(),
             &reached, &zero, product.data(), &size);
        for (unsigned int j = begin; j < end; ++j)
        {
          const auto column = product.begin() + static_cast<std::ptrdiff_t>(j - begin) * n;
          column[order.at[j]] += 1;
          std::copy_n(column, n, &result(0, order.at[j]));
        }
      }
    }
  } // namespace

  template <class Number>
  BlockMatrix<Number>::BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                   const PartOfTangent &tangent)
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
  void BlockMatrix<Number>::find_columns(const PartOfTangent &tangent)
  {
    const unsigned int n = tangent.n();
    std::vector<char> counts(n, 0);
    for (const auto &[places, of_ports, matrix, answers] : blocks)
      for (unsigned int i = places.first; i < places.second; ++i)
      {
        for (unsigned int column = 0; column < places.first; ++column)
          counts[column] |= tangent(i, column) != 0.;
        for (unsigned int column = places.second; column < n; ++column)
          counts[column] |= tangent(i, column) != 0.;
      }
    for (unsigned int column = 0; column < n; ++column)
      if (counts[column])
        columns.push_back(column);
  }

  template <class Number>
  void BlockMatrix<Number>::factorise(const std::vector<unsigned int> &ports, const PartOfTangent &tangent, Block &block) const
  {
    const auto [first, last] = block.places;
    const ComplianceOfBlock compliance(block.of_ports, ports, first, last);
    const TangentOfBlock of_block{ tangent, first, last - first };
    if (of_block.n < many_ports)
      fill(compliance, of_block, block.matrix);
    else
      fill_by_close_order(compliance, of_block, block.matrix);
    block.matrix.compute_lu_factorization();
    if (columns.empty())
      return;
    block.answers.reinit(of_block.n, static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      if (!holds(block.places, columns[k]))
        for (unsigned int a = 0; a < of_block.n; ++a)
          if (const double force = tangent(first + a, columns[k]); force != 0.)
            for (unsigned int i = 0; i < of_block.n; ++i)
              block.answers(i, k) -= static_cast<Number>(compliance(a, i) * force); // G is symmetric
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
