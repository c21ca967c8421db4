// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_forces.h"

#include "base/errors.h"
#include "model/block_product.h"
#include "model/port_compliance.h"
#include "model/reduced_factors.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace sprag
{
  using namespace dealii;

  /// Some rows and the same columns of a tangent A = df/dz, where they are.
  struct PartOfTangent
  {
    const dealii::FullMatrix<double> &whole;
    const std::vector<unsigned int> &places; ///< in the whole

    double operator()(const unsigned int i, const unsigned int j) const
    {
      return whole(places[i], places[j]);
    }

    unsigned int n() const
    {
      return static_cast<unsigned int>(places.size());
    }
  };

  /// Factors of M = 1 - G A on some of the ports, A = df/dz. Forces on a block of ports follow its own displacements and few
  /// others, say the turn of a joint. So M is factorised block by block, D, and what stands beside the blocks, in few columns C,
  /// enters by Woodbury:
  ///   M = D + E,   x = D^-1 (b - E x_C),   (1 + (D^-1 E)_C) x_C = (D^-1 b)_C.
  class BlockMatrix
  {
  public:
    /// Throws an exception of deal.II where it is singular.
    BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const PartOfTangent &tangent);

    void solve(dealii::Vector<double> &values) const;

    double determinant() const;

  private:
    using Places = std::pair<unsigned int, unsigned int>; // the first, and beyond the last

    struct Block
    {
      Places places;
      PortCompliance::Block of_ports;
      dealii::LAPACKFullMatrix<double> matrix;
      dealii::LAPACKFullMatrix<double> answers; ///< D^-1 E, a column for each of C
    };

    std::vector<Block> blocks;
    std::vector<unsigned int> columns; ///< C
    dealii::LAPACKFullMatrix<double> of_columns;

    void find_columns(const PartOfTangent &tangent);
    void factorise(const std::vector<unsigned int> &ports, const PartOfTangent &tangent, Block &block) const;
    double answer(unsigned int row, unsigned int k) const;
  };

  namespace
  {
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

    /// 1 - G A by its definition.
    void fill(const ComplianceOfBlock &compliance, const TangentOfBlock &tangent, LAPACKFullMatrix<double> &result)
    {
      const unsigned int n = tangent.n;
      LAPACKFullMatrix<double> loaded(n), of_block(n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          loaded(i, j)   = -compliance(j, i); // G is symmetric
          of_block(i, j) = tangent(i, j);
        }
      loaded.mmult(result, of_block);
      for (unsigned int i = 0; i < n; ++i)
        result(i, i) += 1;
    }
  } // namespace

  BlockMatrix::BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const PartOfTangent &tangent)
  {
    for (const auto &block : compliance.blocks())
      if (const auto places = block.places_among(ports); places.first < places.second)
        blocks.push_back({ places, block, LAPACKFullMatrix<double>(places.second - places.first), LAPACKFullMatrix<double>() });
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

  void BlockMatrix::solve(Vector<double> &values) const
  {
    for (const auto &[places, of_ports, matrix, answers] : blocks)
    {
      Vector<double> of_block(values.begin() + places.first, values.begin() + places.second);
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

  double BlockMatrix::determinant() const
  {
    double result = columns.empty() ? 1. : of_columns.determinant();
    for (const auto &block : blocks)
      result *= block.matrix.determinant();
    return result;
  }

  void BlockMatrix::find_columns(const PartOfTangent &tangent)
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

  void BlockMatrix::factorise(const std::vector<unsigned int> &ports, const PartOfTangent &tangent, Block &block) const
  {
    const auto [first, last] = block.places;
    const ComplianceOfBlock compliance(block.of_ports, ports, first, last);
    const TangentOfBlock of_block{ tangent, first, last - first };
    fill(compliance, of_block, block.matrix);
    block.matrix.compute_lu_factorization();
    if (columns.empty())
      return;
    block.answers.reinit(of_block.n, static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      if (!holds(block.places, columns[k]))
        for (unsigned int a = 0; a < of_block.n; ++a)
          if (const double force = tangent(first + a, columns[k]); force != 0.)
            for (unsigned int i = 0; i < of_block.n; ++i)
              block.answers(i, k) -= compliance(a, i) * force; // G is symmetric
    block.matrix.solve(block.answers);
  }

  /// Of D^-1 E.
  double BlockMatrix::answer(const unsigned int row, const unsigned int k) const
  {
    const auto block =
        std::find_if(blocks.begin(), blocks.end(), [&](const auto &candidate) { return holds(candidate.places, row); });
    return block->answers(row - block->places.first, k);
  }

  /// Factors of M = 1 - G A on some of the ports, A = df/dz. Ports that follow no others, B (a hub on its spring, a support),
  /// have forces that follow all displacements: they border the matrix of the others, I.
  ///   S = M_BB - M_BI M_II^-1 M_IB,   x_B = S^-1 (b_B - M_BI M_II^-1 b_I),   x_I = M_II^-1 b_I - M_II^-1 M_IB x_B.
  class PortMatrix
  {
  public:
    /// Throws an exception of deal.II where it is singular.
    PortMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
               const dealii::FullMatrix<double> &tangent);

    void solve(dealii::Vector<double> &values) const;

    double determinant() const;

  private:
    using Places = std::vector<unsigned int>;

    void make_border(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                     const dealii::FullMatrix<double> &tangent);

    Places inner;  ///< I
    Places border; ///< B
    std::optional<BlockMatrix> of_inner;
    dealii::FullMatrix<double> below;           ///< M_BI
    dealii::FullMatrix<double> aside;           ///< M_II^-1 M_IB
    dealii::LAPACKFullMatrix<double> of_border; ///< S
  };

  namespace
  {
    FullMatrix<double> part(const FullMatrix<double> &matrix, const std::vector<unsigned int> &rows,
                            const std::vector<unsigned int> &columns)
    {
      if (rows.empty() || columns.empty())
        return FullMatrix<double>();
      FullMatrix<double> result(rows.size(), columns.size());
      result.extract_submatrix_from(matrix, rows, columns);
      return result;
    }

    std::vector<unsigned int> some_of(const std::vector<unsigned int> &ports, const std::vector<unsigned int> &places)
    {
      std::vector<unsigned int> result;
      for (const unsigned int place : places)
        result.push_back(ports[place]);
      return result;
    }
  } // namespace

  PortMatrix::PortMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                         const FullMatrix<double> &tangent)
  {
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(ports);
      for (unsigned int place = first; place < last; ++place)
        (block.matrix->m() == 1 ? border : inner).push_back(place);
    }
    if (!inner.empty())
      of_inner.emplace(compliance, some_of(ports, inner), PartOfTangent{ tangent, inner });
    if (!border.empty())
      make_border(compliance, ports, tangent);
  }

  void PortMatrix::make_border(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent)
  {
    const auto n = static_cast<unsigned int>(border.size()), n_inner = static_cast<unsigned int>(inner.size());
    const auto inner_ports = some_of(ports, inner);
    below                  = part(tangent, border, inner);
    aside.reinit(n_inner, n_inner > 0 ? n : 0);
    of_border.reinit(n);
    for (unsigned int b = 0; b < n; ++b)
    {
      const double own = compliance(ports[border[b]], ports[border[b]]);
      for (unsigned int i = 0; i < n_inner; ++i)
        below(b, i) *= -own;
      for (unsigned int c = 0; c < n; ++c)
        of_border(b, c) = (b == c ? 1. : 0.) - own * tangent(border[b], border[c]);
    }
    for (unsigned int b = 0; b < n && n_inner > 0; ++b)
    {
      Vector<double> forces(n_inner), displacements(compliance.size()), column(n_inner);
      for (unsigned int i = 0; i < n_inner; ++i)
        forces[i] = tangent(inner[i], border[b]);
      add_response(compliance, inner_ports, forces, inner_ports, displacements);
      for (unsigned int i = 0; i < n_inner; ++i)
        column[i] = -displacements[inner_ports[i]];
      of_inner->solve(column);
      for (unsigned int i = 0; i < n_inner; ++i)
        aside(i, b) = column[i];
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int i = 0; i < n_inner; ++i)
          of_border(c, b) -= below(c, i) * column[i];
    }
    of_border.compute_lu_factorization();
  }

  void PortMatrix::solve(Vector<double> &values) const
  {
    const auto n = static_cast<unsigned int>(border.size()), n_inner = static_cast<unsigned int>(inner.size());
    Vector<double> of_inside(n_inner), of_edge(n);
    for (unsigned int i = 0; i < n_inner; ++i)
      of_inside[i] = values[inner[i]];
    for (unsigned int b = 0; b < n; ++b)
      of_edge[b] = values[border[b]];
    if (n_inner > 0)
      of_inner->solve(of_inside);
    if (n > 0)
    {
      for (unsigned int b = 0; b < n; ++b)
        for (unsigned int i = 0; i < n_inner; ++i)
          of_edge[b] -= below(b, i) * of_inside[i];
      of_border.solve(of_edge);
      for (unsigned int i = 0; i < n_inner; ++i)
        for (unsigned int b = 0; b < n; ++b)
          of_inside[i] -= aside(i, b) * of_edge[b];
    }
    for (unsigned int i = 0; i < n_inner; ++i)
      values[inner[i]] = of_inside[i];
    for (unsigned int b = 0; b < n; ++b)
      values[border[b]] = of_edge[b];
  }

  double PortMatrix::determinant() const
  {
    return (of_inner ? of_inner->determinant() : 1.) * (border.empty() ? 1. : of_border.determinant());
  }

  namespace
  {
    constexpr std::size_t few_ports  = 12;  ///< up to so many to look for what is zero takes longer than to compute with it
    constexpr std::size_t many_ports = 128; ///< from so many on most of a Newton correction are its factors

    /// Solves (1 - G A) x = b on ports of a single block: x is b before, and the solution after. By factors, not by the inverse,
    /// which is no more accurate than the matrix is well conditioned.
    void solve_whole(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const FullMatrix<double> &tangent,
                     Vector<double> &x)
    {
      const auto n         = static_cast<unsigned int>(ports.size());
      const auto &of_ports = *compliance.blocks().front().matrix;
      LAPACKFullMatrix<double> matrix(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          double yields = i == j ? 1. : 0.;
          for (unsigned int k = 0; k < n; ++k)
            yields -= of_ports(ports[i], ports[k]) * tangent(k, j);
          matrix(i, j) = yields;
        }
      matrix.compute_lu_factorization();
      matrix.solve(x);
    }

    /// Forces of a tangent A that answer to displacements z, f = A (z + G f): by factors of single precision, at half the cost
    /// and less, whose errors are found in turn. What they may leave unbalanced is told by what it would move, as Newton's method
    /// looks at that: forces follow displacements so strongly that a small share of them is a large share of these. None where
    /// that fails: badly conditioned tangents do not let it.
    std::optional<Vector<double>> reaction_by_refinement(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                                         const FullMatrix<double> &tangent, const Vector<double> &displacements)
    try
    {
      constexpr unsigned int most_refinements = 12;
      constexpr double refined                = 1e-10; // what may be left, of the displacements
      constexpr double aim                    = 1e-3;  // of what is left, by a refinement
      const ReducedFactors factors(compliance, ports, tangent);
      Vector<double> result(displacements.size()), rest(displacements.size()), moved(displacements.size());
      Vector<double> of_all(compliance.size());
      factors.add_forces(displacements, rest);
      for (unsigned int i = 0; i < most_refinements; ++i)
      {
        factors.add_solution(rest, aim, result);
        of_all = 0.;
        add_response(compliance, ports, result, ports, of_all);
        for (unsigned int j = 0; j < moved.size(); ++j)
          moved[j] = displacements[j] + of_all[ports[j]];
        rest.equ(-1., result);
        factors.add_forces(moved, rest);
        if (factors.movement_by(rest) <= refined * factors.movement(displacements))
          return result;
      }
      return {};
    }
    catch (const ExceptionBase &)
    {
      return {};
    }
  } // namespace

  void sum_forces(const std::vector<PortForces> &loaded, std::vector<unsigned int> &place_of_port, PortForces &sum)
  {
    sum.ports.clear();
    for (const auto &some : loaded)
      sum.ports.insert(sum.ports.end(), some.ports.begin(), some.ports.end());
    std::sort(sum.ports.begin(), sum.ports.end());
    sum.ports.erase(std::unique(sum.ports.begin(), sum.ports.end()), sum.ports.end());
    const auto n = static_cast<unsigned int>(sum.ports.size());
    for (unsigned int a = 0; a < n; ++a)
      place_of_port[sum.ports[a]] = a;

    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    sum.has_tangent = true;
    for (const auto &some : loaded)
      for (unsigned int i = 0; i < some.ports.size(); ++i)
      {
        const unsigned int row = place_of_port[some.ports[i]];
        sum.values[row] += some.values[i];
        for (unsigned int j = 0; j < some.ports.size(); ++j)
          sum.tangent(row, place_of_port[some.ports[j]]) += some.tangent(i, j);
      }
  }

  void add_ports(const std::vector<unsigned int> &others, PortForces &forces)
  {
    if (std::includes(forces.ports.begin(), forces.ports.end(), others.begin(), others.end()))
      return;
    PortForces result;
    std::set_union(forces.ports.begin(), forces.ports.end(), others.begin(), others.end(), std::back_inserter(result.ports));
    const auto n = static_cast<unsigned int>(result.ports.size());
    result.values.reinit(n);
    std::vector<unsigned int> places;
    for (const unsigned int port : forces.ports)
      places.push_back(place_of(port, result.ports));
    for (unsigned int i = 0; i < places.size(); ++i)
      result.values[places[i]] = forces.values[i];
    result.has_tangent = forces.has_tangent;
    if (forces.has_tangent)
    {
      result.tangent.reinit(n, n);
      forces.tangent.scatter_matrix_to(places, places, result.tangent);
    }
    forces = std::move(result);
  }

  double port_determinant(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                          const FullMatrix<double> &tangent)
  {
    return PortMatrix(compliance, ports, tangent).determinant();
  }

  Vector<double> port_reaction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent, const Vector<double> &displacements)
  {
    try
    {
      if (ports.size() >= many_ports)
        if (const auto forces = reaction_by_refinement(compliance, ports, tangent, displacements))
          return *forces;
      Vector<double> change = displacements, forces(displacements.size());
      if (ports.size() <= few_ports && compliance.blocks().size() == 1)
        solve_whole(compliance, ports, tangent, change);
      else
        PortMatrix(compliance, ports, tangent).solve(change);
      tangent.vmult(forces, change);
      return forces;
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
  }

  PortSelection all_ports(const unsigned int number)
  {
    PortSelection result(number);
    std::iota(result.begin(), result.end(), 0u);
    return result;
  }

  void add_response(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const Vector<double> &forces,
                    const PortSelection &selected, Vector<double> &displacements)
  {
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(ports);
      const auto [begin, end]  = block.places_among(selected);
      const auto rows          = ranges_of(selected.begin() + begin, selected.begin() + end);
      const double *values     = forces.begin() + first;
      for (const auto &loaded : ranges_of(ports.begin() + first, ports.begin() + last))
      {
        const NumberRange columns{ loaded.begin - block.begin, loaded.end - block.begin };
        for (const auto &row : rows)
          add_block_product(*block.matrix, { row.begin - block.begin, row.end - block.begin }, columns, values,
                            displacements.begin() + row.begin);
        values += loaded.size();
      }
    }
  }

  Vector<double> port_correction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                 const FullMatrix<double> &tangent, const PortSelection &selected, const Vector<double> &mismatch)
  {
    // (1 - G df/dz) dz = mismatch on the loaded ports; the others follow from the change of the forces.
    Vector<double> result = mismatch;
    if (ports.empty())
      return result;
    Vector<double> loaded(static_cast<unsigned int>(ports.size()));
    for (unsigned int i = 0; i < loaded.size(); ++i)
      loaded[i] = mismatch[ports[i]];
    add_response(compliance, ports, port_reaction(compliance, ports, tangent, loaded), selected, result);
    return result;
  }
} // namespace sprag
