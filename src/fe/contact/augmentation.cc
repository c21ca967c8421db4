// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/augmentation.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using dealii::Point;

  namespace
  {
    /// Coordinates in the plane of the face, that along xi first.
    template <int dim>
    std::array<double, dim - 1> in_face(const Point<dim> &place)
    {
      if constexpr (dim == 2)
        return { { place[0] } };
      else
        return { { place[0], place[2] } };
    }
  } // namespace

  template <int dim>
  FaceMultipliers<dim>::FaceMultipliers(const FrictionFace<dim> &face_)
      : face(face_)
  {
    std::map<std::array<long, dim - 1>, unsigned int> numbers;
    for (unsigned int k = 0; k < face.elements.size(); ++k)
    {
      const auto &nodes = face.edges[k].nodes;
      const auto first  = in_face<dim>(nodes.front().position);
      const auto last   = in_face<dim>(nodes.back().position);
      Share cell_share;
      for (unsigned int c = 0; c < n_corners; ++c)
      {
        std::array<long, dim - 1> place; // in nanometres, by which corners of neighbouring cells are known to be one
        for (unsigned int d = 0; d < dim - 1; ++d)
          place[d] = std::lround(1e6 * ((c >> d) % 2 == 0 ? first[d] : last[d]));
        cell_share.corners[c] = numbers.try_emplace(place, static_cast<unsigned int>(numbers.size())).first->second;
      }
      areas.resize(numbers.size());
      for (unsigned int q = face.elements[k].begin; q < face.elements[k].end; ++q)
      {
        const auto place = in_face<dim>(face.points[q].position);
        cell_share.values.fill(1.);
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          for (unsigned int d = 0; d < dim - 1; ++d)
          {
            const double along = (place[d] - first[d]) / (last[d] - first[d]);
            cell_share.values[c] *= (c >> d) % 2 == 0 ? 1. - along : along;
          }
          areas[cell_share.corners[c]] += face.points[q].weight * cell_share.values[c];
        }
        shares.push_back(cell_share);
      }
    }
  }

  /// Values at the points of `states` of the function that a traction of theirs is averaged to, an entry per state [MPa].
  template <int dim>
  template <class Traction>
  std::vector<Traction> FaceMultipliers<dim>::averaged(const States &states, Traction PointTraction::*traction) const
  {
    std::vector<Traction> coefficients(areas.size());
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
      {
        const auto &share = shares[state.index];
        for (unsigned int c = 0; c < n_corners; ++c)
          coefficients[share.corners[c]] +=
              (face.points[state.index].weight * share.values[c] / areas[share.corners[c]]) * (state.*traction);
      }
    std::vector<Traction> result(states.size());
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      const auto &share = shares[states[a].index];
      for (unsigned int c = 0; c < n_corners; ++c)
        result[a] += share.values[c] * coefficients[share.corners[c]];
    }
    return result;
  }

  template <int dim>
  std::vector<ContactHistory> FaceMultipliers<dim>::augmented(const States &states) const
  {
    const auto pressures = averaged(states, &FacePointState<dim>::pressure);
    const auto tractions = averaged(states, &FacePointState<dim>::traction);
    std::vector<ContactHistory> result(states.size());
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      result[a].normal_multiplier = pressures[a];
      // That of a point which slips is known: what a mean differs from it by would pass for slip.
      result[a].traction = states[a].slipping ? states[a].traction : tractions[a];
      result[a].point    = states[a].index;
    }
    return result;
  }

  template <int dim>
  double FaceMultipliers<dim>::largest_change(const States &states, const std::vector<ContactHistory> &history) const
  {
    const auto pressures = averaged(states, &FacePointState<dim>::pressure);
    double largest       = 0.;
    auto known           = history.begin();
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      while (known != history.end() && known->point < states[a].index)
        ++known;
      const bool is_known = known != history.end() && known->point == states[a].index;
      largest             = std::max(largest, std::abs(pressures[a] - (is_known ? known->normal_multiplier : 0.)));
    }
    return largest;
  }

  template class FaceMultipliers<2>;
  template class FaceMultipliers<3>;
} // namespace sprag
