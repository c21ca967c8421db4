#include "model/port_forces.h"

#include "base/errors.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Places = std::pair<unsigned int, unsigned int>; // the first, and beyond the last

    /// Where the ports of a block stand among increasing ones.
    Places places_in(const PortCompliance::Block &block, const std::vector<unsigned int> &ports)
    {
      return { place_of(block.begin, ports), place_of(block.end(), ports) };
    }

    /// Product of a full matrix and one that couples each place with few others. Those are numbered so that they are close
    /// (Cuthill and McKee), and only the rows counted that columns next to each other have.
    void multiply_by_sparse(const FullMatrix<double> &full, const FullMatrix<double> &sparse, FullMatrix<double> &product)
    {
      constexpr unsigned int together = 48;
      const auto n                    = static_cast<unsigned int>(sparse.n());
      DynamicSparsityPattern pattern(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (sparse(i, j) != 0. || i == j)
          {
            pattern.add(i, j);
            pattern.add(j, i);
          }
      std::vector<types::global_dof_index> number(n);
      SparsityTools::reorder_Cuthill_McKee(pattern, number);
      std::vector<unsigned int> at(n), first(n, n), last(n, 0);
      for (unsigned int i = 0; i < n; ++i)
        at[number[i]] = i;
      for (unsigned int i = 0; i < n; ++i)
        for (auto other = pattern.begin(at[i]); other != pattern.end(at[i]); ++other)
        {
          first[i] = std::min(first[i], static_cast<unsigned int>(number[other->column()]));
          last[i]  = std::max(last[i], static_cast<unsigned int>(number[other->column()]));
        }
      for (unsigned int begin = 0; begin < n; begin += together)
      {
        const unsigned int end  = std::min(n, begin + together);
        const unsigned int low  = *std::min_element(first.begin() + begin, first.begin() + end);
        const unsigned int high = *std::max_element(last.begin() + begin, last.begin() + end) + 1;
        FullMatrix<double> of_full(n, high - low), of_sparse(high - low, end - begin), of_product(n, end - begin);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = low; k < high; ++k)
            of_full(i, k - low) = full(i, at[k]);
        for (unsigned int k = low; k < high; ++k)
          for (unsigned int j = begin; j < end; ++j)
            of_sparse(k - low, j - begin) = sparse(at[k], at[j]);
        of_full.mmult(of_product, of_sparse);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = begin; j < end; ++j)
            product(i, at[j]) = of_product(i, j - begin);
      }
    }

    void multiply(const FullMatrix<double> &compliance, const FullMatrix<double> &tangent, FullMatrix<double> &product)
    {
      constexpr unsigned int many = 256; // from where the zeros of the tangent are worth the search for them
      if (tangent.n() < many)
        compliance.mmult(product, tangent);
      else
        multiply_by_sparse(compliance, tangent, product);
    }

    /// M = 1 - G df/dz on some of the ports. Forces on a block of ports follow its own displacements and few others, say the turn
    /// of a joint. So M is factorised block by block, D, and what stands beside the blocks, in few columns C, enters by Woodbury:
    ///   M = D + E,   x = D^-1 (b - E x_C),   (1 + (D^-1 E)_C) x_C = (D^-1 b)_C.
    class PortMatrix
    {
    public:
      PortMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const FullMatrix<double> &tangent)
      {
        for (const auto &block : compliance.blocks())
          if (const auto places = places_in(block, ports); places.first < places.second)
            blocks.push_back(
                { places, block, LAPACKFullMatrix<double>(places.second - places.first), LAPACKFullMatrix<double>() });
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

      void solve(Vector<double> &values) const
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

      double determinant() const
      {
        double result = columns.empty() ? 1. : of_columns.determinant();
        for (const auto &block : blocks)
          result *= block.matrix.determinant();
        return result;
      }

    private:
      struct Block
      {
        Places places;
        PortCompliance::Block of_ports;
        LAPACKFullMatrix<double> matrix;
        LAPACKFullMatrix<double> answers; ///< D^-1 E, a column for each of C
      };

      std::vector<Block> blocks;
      std::vector<unsigned int> columns; ///< C
      LAPACKFullMatrix<double> of_columns;

      static bool holds(const Places &places, const unsigned int i)
      {
        return places.first <= i && i < places.second;
      }

      void find_columns(const FullMatrix<double> &tangent)
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

      void factorise(const std::vector<unsigned int> &ports, const FullMatrix<double> &tangent, Block &block) const
      {
        const auto [first, last] = block.places;
        const auto &of           = block.of_ports;
        const unsigned int n     = last - first;
        FullMatrix<double> loaded(n), of_block(n), product(n);
        of_block.fill(tangent, 0, 0, first, first);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            loaded(i, j) = (*of.matrix)(ports[first + i] - of.begin, ports[first + j] - of.begin);
        multiply(loaded, of_block, product);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            block.matrix(i, j) = (i == j ? 1. : 0.) - product(i, j);
        block.matrix.compute_lu_factorization();
        if (columns.empty())
          return;
        block.answers.reinit(n, static_cast<unsigned int>(columns.size()));
        for (unsigned int k = 0; k < columns.size(); ++k)
          if (!holds(block.places, columns[k]))
            for (unsigned int a = 0; a < n; ++a)
              if (const double force = tangent(first + a, columns[k]); force != 0.)
                for (unsigned int i = 0; i < n; ++i)
                  block.answers(i, k) -= loaded(i, a) * force;
        block.matrix.solve(block.answers);
      }

      /// Of D^-1 E.
      double answer(const unsigned int row, const unsigned int k) const
      {
        const auto block =
            std::find_if(blocks.begin(), blocks.end(), [&](const auto &candidate) { return holds(candidate.places, row); });
        return block->answers(row - block->places.first, k);
      }
    };
  } // namespace

  unsigned int place_of(const unsigned int port, const std::vector<unsigned int> &ports)
  {
    return static_cast<unsigned int>(std::lower_bound(ports.begin(), ports.end(), port) - ports.begin());
  }

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
    result.tangent.reinit(n, n);
    std::vector<unsigned int> places;
    for (const unsigned int port : forces.ports)
      places.push_back(place_of(port, result.ports));
    for (unsigned int i = 0; i < places.size(); ++i)
      result.values[places[i]] = forces.values[i];
    forces.tangent.scatter_matrix_to(places, places, result.tangent);
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
    Vector<double> change = displacements;
    try
    {
      PortMatrix(compliance, ports, tangent).solve(change);
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
    Vector<double> forces(change.size());
    tangent.vmult(forces, change);
    return forces;
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
      const auto [first, last] = places_in(block, ports);
      const auto [begin, end]  = places_in(block, selected);
      double *const of_block   = displacements.begin() + block.begin;
      for (unsigned int a = first; a < last; ++a)
      {
        const double force      = forces[a];
        const double *const row = &(*block.matrix)(ports[a] - block.begin, 0);
        for (unsigned int k = begin; k < end; ++k)
        {
          const unsigned int i = selected[k] - block.begin;
          of_block[i] += row[i] * force;
        }
      }
    }
  }

  Vector<double> port_correction(const PortCompliance &compliance, const PortForces &forces, const PortSelection &selected,
                                 const Vector<double> &mismatch)
  {
    // (1 - G df/dz) dz = mismatch on the loaded ports; the others follow from the change of the forces.
    Vector<double> result = mismatch;
    if (forces.ports.empty())
      return result;
    Vector<double> loaded(static_cast<unsigned int>(forces.ports.size()));
    for (unsigned int i = 0; i < loaded.size(); ++i)
      loaded[i] = mismatch[forces.ports[i]];
    const auto change_of_forces = port_reaction(compliance, forces.ports, forces.tangent, loaded);
    add_response(compliance, forces.ports, change_of_forces, selected, result);
    return result;
  }
} // namespace sprag
