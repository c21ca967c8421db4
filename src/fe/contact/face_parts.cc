// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  namespace
  {
    constexpr unsigned int parts_along = 4;
  }

  FaceParts face_parts(const FrictionFace<2> &face)
  {
    FaceParts result;
    for (const auto &point : face.points)
    {
      result.point_parts.push_back(static_cast<unsigned int>(result.point_parts.size()));
      result.points.xi.push_back(point.position[0]);
      result.points.weight.push_back(point.weight);
    }
    return result;
  }

  FaceParts face_parts(const FrictionFace<3> &face)
  {
    FaceParts result;
    auto &[xi, weight, zeta] = result.points;
    result.point_parts.resize(face.points.size());
    for (const auto &element : face.elements)
    {
      std::map<std::pair<unsigned int, long>, unsigned int> known; // by the quarter along xi and zeta
      const double first = face.points[element.begin].position[0];
      const double span  = face.points[element.end - 1].position[0] - first;
      for (unsigned int q = element.begin; q < element.end; ++q)
      {
        const auto &point  = face.points[q];
        const auto quarter = static_cast<unsigned int>(
            std::clamp(std::floor(parts_along * (point.position[0] - first) / span), 0., parts_along - 1.));
        const auto [found, is_new] =
            known.try_emplace({ quarter, std::lround(1e6 * point.position[2]) }, static_cast<unsigned int>(xi.size()));
        const unsigned int part = result.point_parts[q] = found->second;
        if (is_new)
        {
          xi.push_back(0.);
          zeta.push_back(point.position[2]);
          weight.push_back(0.);
        }
        xi[part] += point.weight * point.position[0];
        weight[part] += point.weight;
      }
    }
    for (std::size_t i = 0; i < xi.size(); ++i)
      xi[i] /= weight[i];
    return result;
  }
} // namespace sprag
