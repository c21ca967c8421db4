#include "fe/contact/augmentation.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  FaceMultipliers::FaceMultipliers(const FrictionFace<2> &face_)
      : face(face_)
  {
    constexpr double same = 1e-6; ///< place of two corners, over the length of a cell
    double last_end       = 0.;
    for (unsigned int k = 0; k < face.patches.size(); ++k)
    {
      const double begin = face.edges[k].nodes.front().position[0];
      const double end   = face.edges[k].nodes.back().position[0];
      if (k == 0 || begin - last_end > same * (end - begin))
        areas.push_back(0.);
      areas.push_back(0.);
      const auto first = static_cast<unsigned int>(areas.size()) - 2;
      for (unsigned int q = face.patches[k].begin; q < face.patches[k].end; ++q)
      {
        const double along = (face.points[q].position[0] - begin) / (end - begin);
        shares.push_back({ first, { { 1. - along, along } } });
        for (unsigned int i = 0; i < 2; ++i)
          areas[first + i] += face.points[q].weight * shares.back().values[i];
      }
      last_end = end;
    }
  }

  /// Values at the points of `states` of the function that a traction of theirs is averaged to, an entry per state [MPa].
  template <class Traction>
  std::vector<Traction> FaceMultipliers::averaged(const std::vector<FacePointState<2>> &states,
                                                  Traction PointTraction<1>::*traction) const
  {
    std::vector<Traction> coefficients(areas.size());
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
      {
        const auto &share = shares[state.index];
        for (unsigned int i = 0; i < 2; ++i)
          coefficients[share.first + i] +=
              (face.points[state.index].weight * share.values[i] / areas[share.first + i]) * (state.*traction);
      }
    std::vector<Traction> result;
    for (const auto &state : states)
    {
      const auto &share = shares[state.index];
      result.push_back(share.values[0] * coefficients[share.first] + share.values[1] * coefficients[share.first + 1]);
    }
    return result;
  }

  std::vector<ContactMemory> FaceMultipliers::augmented(const std::vector<FacePointState<2>> &states) const
  {
    const auto pressures = averaged(states, &FacePointState<2>::pressure);
    const auto tractions = averaged(states, &FacePointState<2>::traction);
    std::vector<ContactMemory> result(states.size());
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      result[a].normal_multiplier = pressures[a];
      result[a].traction          = tractions[a];
      result[a].point             = states[a].index;
    }
    return result;
  }

  double FaceMultipliers::largest_change(const std::vector<FacePointState<2>> &states,
                                         const std::vector<ContactMemory> &memory) const
  {
    const auto pressures = averaged(states, &FacePointState<2>::pressure);
    double largest       = 0.;
    auto known           = memory.begin();
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      while (known != memory.end() && known->point < states[a].index)
        ++known;
      const bool is_known = known != memory.end() && known->point == states[a].index;
      largest             = std::max(largest, std::abs(pressures[a] - (is_known ? known->normal_multiplier : 0.)));
    }
    return largest;
  }
} // namespace sprag
