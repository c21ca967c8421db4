// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_structure.h"

#include "base/ranges.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Dofs in a row of a block. Smaller ones make more calls of the solver, larger ones more entries that are not needed.
    constexpr unsigned int block_size = 128;
  } // namespace

  SurfaceCompliance::SurfaceCompliance(const Mumps &stiffness, std::vector<unsigned int> dofs)
      : factors(stiffness)
      , body_dofs(std::move(dofs))
  {
    for (unsigned int surface_dof = 0; surface_dof < body_dofs.size(); ++surface_dof)
      surface_dof_map[body_dofs[surface_dof]] = surface_dof;
  }

  unsigned int SurfaceCompliance::n_block_dofs(const unsigned int block) const
  {
    return std::min(block_size, static_cast<unsigned int>(body_dofs.size()) - block * block_size);
  }

  DofSelection SurfaceCompliance::block_dofs(const unsigned int block) const
  {
    DofSelection result(n_block_dofs(block));
    std::iota(result.begin(), result.end(), block * block_size);
    return result;
  }

  DofSelection SurfaceCompliance::whole_blocks(const DofSelection &surface_dofs) const
  {
    std::set<unsigned int> touched;
    for (const unsigned int surface_dof : surface_dofs)
      touched.insert(surface_dof / block_size);
    DofSelection result;
    for (const unsigned int block : touched)
    {
      const auto own_dofs = block_dofs(block);
      result.insert(result.end(), own_dofs.begin(), own_dofs.end());
    }
    return result;
  }

  FullMatrix<double> SurfaceCompliance::among(const DofSelection &whole_blocks)
  {
    std::vector<unsigned int> begins; // of the blocks among the dofs
    for (unsigned int i = 0; i < whole_blocks.size(); i += n_block_dofs(whole_blocks[i] / block_size))
      begins.push_back(i);
    const auto block_at = [&](const unsigned int begin) { return whole_blocks[begin] / block_size; };
    std::vector<Block> missing;
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row && blocks.count({ block_at(row), block_at(column) }) == 0)
          missing.emplace_back(block_at(row), block_at(column));
    if (!missing.empty())
      find(missing);
    FullMatrix<double> matrix(static_cast<unsigned int>(whole_blocks.size()));
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row)
        {
          const auto &block = blocks.at({ block_at(row), block_at(column) });
          for (unsigned int i = 0; i < block.m(); ++i)
            for (unsigned int j = 0; j < block.n(); ++j)
              matrix(row + i, column + j) = matrix(column + j, row + i) = block(i, j);
        }
    return matrix;
  }

  double &SurfaceCompliance::entry(const unsigned int row, const unsigned int column)
  {
    const Block block(row / block_size, column / block_size);
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

  void SurfaceCompliance::find(const std::vector<Block> &needed)
  {
    searches.push_back(needed);
    // A row costs much, an entry little: the rows are those of dofs that are new.
    std::map<unsigned int, DofSelection> columns; // by the block of the rows, in the order of the degrees of freedom
    for (const auto &[first, second] : needed)
    {
      const bool first_is_new = blocks.count({ first, first }) == 0;
      const auto column_dofs  = block_dofs(first_is_new ? second : first);
      auto &row_dofs          = columns[first_is_new ? first : second];
      row_dofs.insert(row_dofs.end(), column_dofs.begin(), column_dofs.end());
    }
    for (const auto &[first, second] : needed)
      blocks[{ first, second }].reinit(n_block_dofs(first), n_block_dofs(second));

    std::map<unsigned int, std::vector<unsigned int>> entries; // degrees of freedom
    for (auto &[block, surface_dofs] : columns)
    {
      std::sort(surface_dofs.begin(), surface_dofs.end(),
                [&](const unsigned int a, const unsigned int b) { return body_dofs[a] < body_dofs[b]; });
      const auto dofs = mapped(surface_dofs, [&](const unsigned int surface_dof) { return body_dofs[surface_dof]; });
      for (const unsigned int row : block_dofs(block))
        entries[body_dofs[row]] = dofs;
    }
    const auto values = factors.compute_inverse_entries(entries);
    auto value        = values.begin();
    for (const auto &row_entries : entries)
    {
      const unsigned int row = surface_dof_map.at(row_entries.first);
      for (const unsigned int column : columns.at(row / block_size))
        entry(row, column) = *value++;
    }
  }

  namespace
  {
    /// The compliances may be made after this.
    FaceResponse face_response(const FrictionFace<2> &mesh_face, std::array<SurfaceCompliance, 2> *const faces,
                               const unsigned int i)
    {
      return { 2 * static_cast<unsigned int>(mesh_face.nodes.size()),
               [=](const DofSelection &some) { return (*faces)[i].whole_blocks(some); },
               [=](const DofSelection &blocks) { return (*faces)[i].among(blocks); } };
    }
  } // namespace

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const InterfaceLayout &layout_, const JointSprings &springs_)
      : StaticInterface(layout_, springs_,
                        { face_response(body_.friction_face(), &faces, 0), face_response(body_.cylinder_face(), &faces, 1) })
      , body(body_)
      , surface(surface_dofs(body))
      , factors(body.factorised())
      , faces{ { SurfaceCompliance(*factors, face_dofs(body.friction_face())),
                 SurfaceCompliance(*factors, face_dofs(body.cylinder_face())) } }
      , sensors(body, make_response(factors))
  {
  }

  void StaticStructure::serialise_history(Archive &archive)
  {
    for (auto &face : faces)
      face.serialise_history(archive);
    StaticInterface::serialise_history(archive);
  }

  std::vector<BodyDisplacements> StaticStructure::body_displacements(const std::vector<StaticState> &states) const
  {
    SparseColumns loads;
    for (const auto &acting : on_levers(states))
    {
      for (unsigned int i = 0; i < acting.dofs.size(); ++i)
        loads.add(surface[acting.dofs[i]], acting.values[i]);
      loads.end_column();
    }
    return by_states(factors->solve(std::move(loads)), body.n_dofs());
  }

  std::vector<double> StaticStructure::sensor_forces(const unsigned int lever, const Vector<double> &,
                                                     const DofLoads &forces) const
  {
    return sensors(on_surface(forces, lever));
  }
} // namespace sprag
