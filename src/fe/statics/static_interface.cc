// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_interface.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  DofSelection FaceCompliance::whole_blocks(const DofSelection &selected) const
  {
    DofSelection result;
    for (const unsigned int dof : selected)
      if (result.empty() || dof > result.back())
        for (unsigned int i = ranges[containing_block(dof)].begin; i < ranges[containing_block(dof)].end; ++i)
          result.push_back(i);
    return result;
  }

  FullMatrix<double> FaceCompliance::among(const DofSelection &whole_blocks)
  {
    std::vector<unsigned int> numbers; // of the blocks
    for (unsigned int place = 0; place < whole_blocks.size(); place += ranges[numbers.back()].size())
      numbers.push_back(containing_block(whole_blocks[place]));
    std::vector<BlockPair> pairs;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        pairs.emplace_back(numbers[i], numbers[j]);
    find_blocks(pairs);
    FullMatrix<double> result(whole_blocks.size());
    for (const auto &pair : pairs)
    {
      const auto entries        = block(pair);
      const unsigned int row    = find_index(ranges[pair.first].begin, whole_blocks);
      const unsigned int column = find_index(ranges[pair.second].begin, whole_blocks);
      for (unsigned int a = 0; a < entries.m(); ++a)
        for (unsigned int b = 0; b < entries.n() && column + b <= row + a; ++b)
          result(row + a, column + b) = result(column + b, row + a) = entries(a, b);
    }
    return result;
  }

  unsigned int FaceCompliance::containing_block(const unsigned int dof) const
  {
    const auto after = std::upper_bound(ranges.begin(), ranges.end(), dof,
                                        [](const unsigned int value, const NumberRange &range) { return value < range.begin; });
    return static_cast<unsigned int>(after - ranges.begin()) - 1;
  }

  StaticInterface::StaticInterface(const InterfaceLayout &layout_, const JointSprings &springs_,
                                   std::vector<std::shared_ptr<FaceCompliance>> faces_)
      : layout(layout_)
      , springs(springs_)
      , faces(std::move(faces_))
  {
  }

  /// Chooses new candidates if some dofs are none. Returns their places.
  DofSelection StaticInterface::look_at(const DofSelection &near)
  {
    if (!std::includes(candidates.begin(), candidates.end(), near.begin(), near.end()))
      set_candidates(near);
    return find_indices(near, candidates);
  }

  void StaticInterface::set_candidates(const DofSelection &selected)
  {
    requested = selected;
    candidates.clear();
    compliance            = {};
    const auto add_spring = [&](const unsigned int dof, const double own)
    {
      candidates.push_back(dof);
      compliance.append(own);
    };
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      unsigned int first = layout.first(lever);
      for (const auto &face : faces)
      {
        const auto begin = std::lower_bound(selected.begin(), selected.end(), first);
        const auto end   = std::lower_bound(begin, selected.end(), first + face->n_dofs());
        DofSelection face_dofs;
        std::transform(begin, end, std::back_inserter(face_dofs), [&](const unsigned int dof) { return dof - first; });
        const auto blocks = face->whole_blocks(face_dofs);
        for (const unsigned int place : blocks)
          candidates.push_back(first + place);
        if (!blocks.empty())
          compliance.append(face->among(blocks));
        first += face->n_dofs();
      }
      for (unsigned int slope = 0; slope < layout.slopes; ++slope)
        add_spring(layout.slope(slope), springs.slopes[slope]);
      add_spring(layout.rotation(lever), 1. / springs.rotation);
    }
    if (layout.sprung)
      add_spring(layout.support(), 1. / (layout.levers * springs.support));
  }

  void StaticInterface::serialise_history(Archive &archive)
  {
    for (const auto &face : faces)
      face->serialise_history(archive);
    DofSelection selected = requested;
    archive(selected);
    if (archive.reads() && !selected.empty())
      set_candidates(selected);
  }

  void StaticInterface::set_faces(const DofLoads &forces, const DofSelection &near, Vector<double> &coordinates)
  {
    const auto places = look_at(near);
    Vector<double> displacements(compliance.size());
    add_response(compliance, find_indices(forces.dofs, candidates), forces.values, places, displacements);
    for (const unsigned int place : places)
      if (layout.is_surface(candidates[place]))
        coordinates[candidates[place]] = displacements[place];
  }

  Residual StaticInterface::residual(const Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &near,
                                     const Vector<double> *const face_displacements)
  {
    const auto places = look_at(near);
    Vector<double> mismatch(compliance.size());
    for (const unsigned int place : places)
      mismatch[place] = -coordinates[candidates[place]];
    add_response(compliance, find_indices(forces.dofs, candidates), forces.values, places, mismatch);
    Residual result{ Vector<double>(n_coordinates()), 0. };
    double squares = 0.;
    for (const unsigned int place : places)
    {
      const unsigned int dof = candidates[place];
      const bool is_set      = face_displacements != nullptr && layout.is_surface(dof);
      result.values[dof]     = is_set ? (*face_displacements)[dof] - coordinates[dof] : mismatch[place];
      squares += result.values[dof] * result.values[dof];
    }
    const auto as_movement = [&](const unsigned int dof, const double arm)
    {
      const double turn = result.values[dof];
      squares += (arm * arm - 1.) * turn * turn;
    };
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      as_movement(layout.rotation(lever), springs.arm);
    for (unsigned int slope = 0; slope < layout.slopes; ++slope)
      as_movement(layout.slope(slope), springs.slope_arm);
    result.norm = std::sqrt(squares);
    return result;
  }

  Vector<double> StaticInterface::correction(const Residual &residual, const InterfaceForces &forces, const DofSelection &near)
  {
    const auto places = look_at(near);
    Vector<double> mismatch(compliance.size());
    for (const unsigned int place : places)
      mismatch[place] = residual.values[candidates[place]];
    const auto values = interface_correction(compliance, find_indices(forces.dofs, candidates), forces.tangent, places, mismatch);
    Vector<double> result(n_coordinates());
    for (const unsigned int place : places)
      result[candidates[place]] = values[place];
    return result;
  }

  DofLoads StaticInterface::on_surface(const DofLoads &forces, const unsigned int lever) const
  {
    const auto &all  = forces.dofs;
    const auto begin = std::lower_bound(all.begin(), all.end(), layout.first(lever));
    const auto end   = std::lower_bound(begin, all.end(), layout.first(lever) + layout.surface);
    DofLoads result{ { begin, end },
                     Vector<double>(forces.values.begin() + (begin - all.begin()), forces.values.begin() + (end - all.begin())) };
    for (auto &dof : result.dofs)
      dof -= layout.first(lever);
    return result;
  }

  std::vector<DofLoads> StaticInterface::on_levers(const std::vector<StaticState> &states) const
  {
    std::vector<DofLoads> result;
    for (const auto &state : states)
      for (unsigned int lever = 0; lever < layout.levers; ++lever)
        result.push_back(on_surface(state.forces, lever));
    return result;
  }

  std::vector<BodyDisplacements> StaticInterface::by_states(const std::vector<double> &columns, const unsigned int n) const
  {
    std::vector<BodyDisplacements> result;
    for (auto column = columns.begin(); column != columns.end();)
    {
      auto &displacements = result.emplace_back();
      for (unsigned int lever = 0; lever < layout.levers; ++lever, column += n)
        displacements.emplace_back(column, column + n);
    }
    return result;
  }
} // namespace sprag
