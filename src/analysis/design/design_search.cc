// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_search.h"

#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    SearchSettings search_settings(const DesignProblem &problem)
    {
      SearchSettings search{ problem.settings().evaluations, 24, 400, problem.settings().seed, {} };
      if (problem.is_dear())
      {
        search.evaluations = std::min(search.evaluations, 600u);
        search.starts      = 3;
        search.local       = 150;
      }
      return search;
    }

    Found found_at(const DesignProblem &problem, const Optimum &optimum)
    {
      return { problem.at(optimum.place), optimum.violation <= 0., std::max(0., optimum.violation) };
    }

    /// Turns a demand into an aim: the quantity is to come from `value` towards the target.
    DesignAim towards(const Demand &demand, const double value)
    {
      return { demand.term, value < demand.target, {} };
    }

    /// At least as good by an aim as this.
    Demand limited_by(const DesignAim &aim, const double value)
    {
      return { aim.term, aim.maximises ? DemandKind::at_least : DemandKind::at_most, value, 0., {} };
    }

    bool beats(const DesignAim &aim, const Proposal &a, const Proposal &b, const double share)
    {
      const double first = term_value(aim.term, a), second = term_value(aim.term, b);
      return (aim.maximises ? first - second : second - first) > share * std::abs(second);
    }

    bool is_beaten(const std::vector<DesignAim> &aims, const Proposal &lever, const std::vector<Proposal> &others)
    {
      constexpr double same = 1e-6;
      return std::any_of(others.begin(), others.end(),
                         [&](const Proposal &other)
                         {
                           const bool better = beats(aims[0], other, lever, same) || beats(aims[1], other, lever, same);
                           return better && !beats(aims[0], lever, other, same) && !beats(aims[1], lever, other, same);
                         });
    }
  } // namespace

  Found best_lever(const DesignProblem &problem)
  {
    return found_at(problem, best_in_box(problem.box(problem.settings().aims.front()), search_settings(problem)));
  }

  Found best_dear_lever(const DesignProblem &problem, const std::optional<Proposal> &near)
  {
    auto few = search_settings(problem);
    if (near)
      few.near = problem.search_point(near->parameters);
    return found_at(problem, best_in_box(problem.box(problem.settings().aims.front()), few));
  }

  std::vector<StoppingDemand> stopping_demands(const DesignProblem &problem)
  {
    std::vector<StoppingDemand> result;
    const auto &demands = problem.settings().demanded;
    for (std::size_t i = 0; i < demands.size(); ++i)
    {
      const auto without = least_violation(problem.box({}, i), search_settings(problem));
      if (without.violation > 0.)
        continue;
      const double value = term_value(demands[i].term, problem.at(without.place));
      const auto nearest = problem.at(best_in_box(problem.box(towards(demands[i], value), i), search_settings(problem)).place);
      result.push_back({ i, term_value(demands[i].term, nearest), nearest });
    }
    return result;
  }

  std::vector<Proposal> pareto_front(const DesignProblem &problem)
  {
    const auto &aims    = problem.settings().aims;
    const auto settings = search_settings(problem);
    const auto best     = [&](const DesignAim &aim, const std::optional<Demand> &limit)
    { return problem.at(best_in_box(problem.box(aim, {}, limit), settings).place); };
    const auto value      = [](const DesignAim &aim, const Proposal &lever) { return term_value(aim.term, lever); };
    const auto best_first = best(aims[0], {}), best_second = best(aims[1], {});
    const double from = value(aims[1], best_first), to = value(aims[1], best_second);
    std::vector<Proposal> all = { best_first };
    const unsigned int last   = problem.settings().front_points - 1;
    for (unsigned int i = 1; i <= last; ++i)
    {
      // The last limit can be kept only to round-off.
      const double share = i < last ? static_cast<double>(i) / last : 1. - 1e-6;
      const double limit = from + share * (to - from);
      const auto optimum = best_in_box(problem.box(aims[0], {}, limited_by(aims[1], limit)), settings);
      if (optimum.violation <= 0.)
        all.push_back(problem.at(optimum.place));
    }
    std::vector<Proposal> front;
    for (const auto &lever : all)
      if (!is_beaten(aims, lever, all))
        front.push_back(lever);
    return front;
  }
} // namespace sprag
