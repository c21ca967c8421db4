// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/nested_dissection.h"

#include "fe/body/elastic_body.h"
#include "mpi_environment.h"
#include "verification/block.h"

#include <deal.II/dofs/dof_tools.h>

#include <gtest/gtest.h>
#include <numeric>
#include <set>

using namespace sprag;

namespace
{
  /// Entries of the lower factor of a matrix whose unknowns are eliminated at these places, from 1, by elimination of its graph.
  std::size_t count_factor_entries(const MatrixRows &matrix, const std::vector<int> &order)
  {
    std::vector<std::set<int>> later(order.size()); // places that are coupled with each place and eliminated after it
    for (std::size_t i = 0; i < order.size(); ++i)
      for (PetscInt j = matrix.begin[i]; j < matrix.begin[i + 1]; ++j)
        if (order[matrix.column[j]] > order[i])
          later[order[i] - 1].insert(order[matrix.column[j]]);
    std::size_t result = 0;
    for (const auto &coupled : later)
    {
      result += coupled.size() + 1;
      if (!coupled.empty())
        later[*coupled.begin() - 1].insert(std::next(coupled.begin()), coupled.end());
    }
    return result;
  }
} // namespace

// A square of m x m nodes has some 7.75 m^2 log2 m entries by nested dissection (George 1973), m^3 by lines. The body has m = 65.
TEST(NestedDissection, LeavesFewEntriesInTheFactorOfASquare)
{
  dealii::Triangulation<2> triangulation;
  std::vector<double> lines(33);
  std::iota(lines.begin(), lines.end(), 0.);
  make_block(lines, lines, triangulation);
  BodyProperties properties;
  properties.degree    = 2;
  properties.constants = { { material_id::lever, { 20., 0.3 } } };
  const ElasticBody<2> body(triangulation, properties);
  dealii::PETScWrappers::SparseMatrix stiffness;
  body.reinit(stiffness);
  stiffness.compress(dealii::VectorOperation::add);
  std::vector<dealii::Point<2>> places(body.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), places);

  const MatrixRows rows(stiffness);
  const auto order = nested_dissection(rows, places);
  std::vector<int> natural(body.n_dofs());
  std::iota(natural.begin(), natural.end(), 1);
  EXPECT_EQ(std::set<int>(order.begin(), order.end()), std::set<int>(natural.begin(), natural.end()));
  const double m = 65., expected = 7.75 * 4. * m * m * std::log2(m); // two unknowns a node make four times as many entries
  const auto entries = static_cast<double>(count_factor_entries(rows, order));
  EXPECT_LT(entries, expected);
  EXPECT_GT(entries, 0.25 * expected);
}
