// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_structure.h"

#include "base/ranges.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Dofs in a row of a block. Smaller ones make more calls of the solver, larger ones more entries that are not needed.
    constexpr unsigned int block_size = 128;
  } // namespace

  SurfaceCompliance::SurfaceCompliance(std::shared_ptr<const Mumps> stiffness, std::vector<unsigned int> dofs)
      : factors(std::move(stiffness))
      , body_dofs(std::move(dofs))
  {
    const auto n = static_cast<unsigned int>(body_dofs.size());
    for (unsigned int surface_dof = 0; surface_dof < n; ++surface_dof)
      surface_dof_map[body_dofs[surface_dof]] = surface_dof;
    for (unsigned int begin = 0; begin < n; begin += block_size)
      ranges.push_back({ begin, std::min(n, begin + block_size) });
  }

  void SurfaceCompliance::find_blocks(const std::vector<BlockPair> &pairs)
  {
    const auto missing = filtered(pairs, [&](const BlockPair &pair) { return blocks.count(pair) == 0; });
    if (!missing.empty())
      find(missing);
  }

  double &SurfaceCompliance::entry(const unsigned int row, const unsigned int column)
  {
    const BlockPair block(row / block_size, column / block_size);
    return block.first < block.second ? entry(column, row) : blocks.at(block)(row % block_size, column % block_size);
  }

  void SurfaceCompliance::serialise_history(Archive &archive)
  {
    auto known = searches;
    archive(known);
    if (!archive.reads())
      return;
    blocks.clear();
    searches.clear();
    for (const auto &together : known)
      find(together);
  }

  void SurfaceCompliance::find(const std::vector<BlockPair> &needed)
  {
    searches.push_back(needed);
    // A row costs much, an entry little: the rows are those of dofs that are new.
    std::map<unsigned int, DofSelection> columns; // by the block of the rows, in the order of the degrees of freedom
    for (const auto &[first, second] : needed)
    {
      const bool first_is_new = blocks.count({ first, first }) == 0;
      const auto column_range = ranges[first_is_new ? second : first];
      auto &row_dofs          = columns[first_is_new ? first : second];
      for (unsigned int column = column_range.begin; column < column_range.end; ++column)
        row_dofs.push_back(column);
    }
    for (const auto &[first, second] : needed)
      blocks[{ first, second }].reinit(ranges[first].size(), ranges[second].size());

    std::map<unsigned int, std::vector<unsigned int>> entries; // degrees of freedom
    for (auto &[block, surface_dofs] : columns)
    {
      std::sort(surface_dofs.begin(), surface_dofs.end(),
                [&](const unsigned int a, const unsigned int b) { return body_dofs[a] < body_dofs[b]; });
      const auto dofs = mapped(surface_dofs, [&](const unsigned int surface_dof) { return body_dofs[surface_dof]; });
      for (unsigned int row = ranges[block].begin; row < ranges[block].end; ++row)
        entries[body_dofs[row]] = dofs;
    }
    const auto values = factors->compute_inverse_entries(entries);
    auto value        = values.begin();
    for (const auto &row_entries : entries)
    {
      const unsigned int row = surface_dof_map.at(row_entries.first);
      for (const unsigned int column : columns.at(row / block_size))
        entry(row, column) = *value++;
    }
  }

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const InterfaceLayout &layout_, const JointSprings &springs_)
      : StaticStructure(body_, body_.factorised(), layout_, springs_)
  {
  }

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const std::shared_ptr<const Mumps> &factors_,
                                   const InterfaceLayout &layout_, const JointSprings &springs_)
      : StaticInterface(layout_, springs_,
                        { std::make_shared<SurfaceCompliance>(factors_, face_dofs(body_.friction_face())),
                          std::make_shared<SurfaceCompliance>(factors_, face_dofs(body_.cylinder_face())) })
      , body(body_)
      , factors(factors_)
      , sensors(body, make_response(factors))
  {
  }

  std::vector<BodyDisplacements> StaticStructure::body_displacements(const std::vector<StaticState> &states) const
  {
    return by_states(factors->solve(body_loads(body, on_levers(states))), body.n_dofs());
  }

  std::vector<double> StaticStructure::sensor_forces(const unsigned int lever, const Vector<double> &,
                                                     const DofLoads &forces) const
  {
    return sensors(on_surface(forces, lever));
  }
} // namespace sprag
