// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/identification/vibration_window.h"

#include <boost/math/distributions/fisher_f.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  namespace
  {
    constexpr std::size_t fewest_rows = 8;
    constexpr double groups_a_window  = 25.;
    constexpr double chance           = 1e-4;

    /// Neighbouring rows of one channel in one stroke.
    struct RowGroup
    {
      std::vector<double> travels;
      double squares = 0.;
    };

    double most_of_noise(const ChannelNoise &noise, const std::size_t rows)
    {
      const double of_group = std::max(1., static_cast<double>(rows) / noise.correlation);
      const boost::math::fisher_f ratio(of_group, std::max(1., noise.effective_rows()));
      return boost::math::quantile(boost::math::complement(ratio, chance));
    }
  } // namespace

  double largest_window(const MeasuredMotion &motion)
  {
    double shortest = motion.length(0);
    for (std::size_t stroke = 1; stroke < motion.strokes().size(); ++stroke)
      shortest = std::min(shortest, motion.length(stroke));
    return 0.25 * shortest;
  }

  VibrationWindow vibration_window(const StrokeFit &fit, const std::vector<std::pair<UsedValue, double>> &residuals,
                                   const std::vector<ChannelNoise> &noise, const double largest)
  {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<RowGroup>> all; // by channel and stroke
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> within;
    const auto travel = [&](const UsedValue &value) { return fit.way().travel(value.row, 0., value.stroke); };
    for (const auto &[value, residual] : residuals)
      if (travel(value) <= largest)
        ++within[{ value.channel, value.stroke }];
    for (const auto &[value, residual] : residuals)
    {
      if (travel(value) > largest)
        continue;
      const std::pair place{ value.channel, value.stroke };
      const auto rows = std::max(fewest_rows, static_cast<std::size_t>(static_cast<double>(within[place]) / groups_a_window));
      auto &groups    = all[place];
      if (groups.empty() || groups.back().travels.size() == rows)
        groups.emplace_back();
      groups.back().travels.push_back(travel(value));
      groups.back().squares += residual * residual;
    }
    VibrationWindow result{ 0., false };
    for (const auto &[place, groups] : all)
      for (const auto &group : groups)
      {
        const auto rows = group.travels.size();
        if (group.squares / static_cast<double>(rows) <= most_of_noise(noise[place.first], rows))
          continue;
        result.window  = std::max(result.window, group.travels.back());
        result.is_full = result.is_full || &group == &groups.back();
      }
    return result;
  }
} // namespace sprag
