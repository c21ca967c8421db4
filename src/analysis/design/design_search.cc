// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_search.h"

#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <random>

namespace sprag
{
  namespace
  {
    struct SearchSettings
    {
      unsigned int evaluations = 4000; ///< of the global search
      unsigned int starts      = 24;   ///< of local searches besides it
      unsigned int local       = 400;  ///< evaluations of a local search
      unsigned int seed        = 1;
      std::vector<double> near = {}; ///< first start, sufficient if its local search satisfies the constraints; empty: none
    };

    struct Optimum
    {
      std::vector<double> place; ///< in the unit cube
      double objective = 0.;
      double violation = 0.; ///< the largest of the constraints there
    };

    double max_constraint(const std::vector<double> &constraints)
    {
      return *std::max_element(constraints.begin(), constraints.end());
    }

    /// Compares points that satisfy all constraints by their objective, others by their largest violation.
    bool is_better(const Optimum &a, const Optimum &b)
    {
      if (a.violation <= 0. && b.violation <= 0.)
        return a.objective < b.objective;
      return std::max(a.violation, 0.) < std::max(b.violation, 0.);
    }

    /// Evaluates a point once although NLopt asks for objective and constraints separately, and keeps the best point.
    struct Evaluator
    {
      const BoxProblem &problem;
      std::exception_ptr thrown   = {}; ///< by an evaluation; NLopt replaces it by an exception of its own
      std::vector<double> place   = {};
      BoxProblem::Evaluation last = {};
      Optimum best                = { {}, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };

      const BoxProblem::Evaluation &at(const double *first)
      {
        const std::vector<double> point(first, first + problem.dimension);
        // After an interrupt NLopt runs to its end on the last values, without further evaluations.
        if (point == place || (interrupted() && !place.empty()))
          return last;
        try
        {
          last = problem.evaluate(place = point);
        }
        catch (...)
        {
          thrown = std::current_exception();
          throw;
        }
        const Optimum here{ place, last.objective, max_constraint(last.constraints) };
        if (best.place.empty() || is_better(here, best))
          best = here;
        return last;
      }
    };

    Evaluator &to_evaluator(void *data)
    {
      return *static_cast<Evaluator *>(data);
    }

    double objective(unsigned int, const double *x, double *, void *data)
    {
      return to_evaluator(data).at(x).objective;
    }

    void constraints(unsigned int, double *result, unsigned int, const double *x, double *, void *data)
    {
      const auto &values = to_evaluator(data).at(x).constraints;
      std::copy(values.begin(), values.end(), result);
    }

    // Constraints are approached by minimising b under c_i(x) <= b, with b as the last variable after x.
    double constraint_bound(const unsigned int n, const double *x, double *, void *)
    {
      return x[n - 1];
    }

    void constraints_below_bound(const unsigned int m, double *result, const unsigned int n, const double *x, double *,
                                 void *data)
    {
      constraints(m, result, n - 1, x, nullptr, data);
      for (unsigned int i = 0; i < m; ++i)
        result[i] -= x[n - 1];
    }

    void optimise(nlopt::opt &search, std::vector<double> x, const Evaluator &evaluator)
    {
      double value = 0.;
      try
      {
        search.optimize(x, value);
      }
      catch (const std::runtime_error &)
      {
        if (evaluator.thrown)
          std::rethrow_exception(evaluator.thrown);
        // NLopt stopped by round-off or a failure of its own: the evaluator holds the best point.
      }
    }

    nlopt::opt local_search(const std::size_t n, const unsigned int evaluations, const double step)
    {
      nlopt::opt search(nlopt::LN_COBYLA, static_cast<unsigned int>(n));
      search.set_xtol_rel(1e-10);
      search.set_xtol_abs(1e-11);
      search.set_maxeval(static_cast<int>(evaluations));
      search.set_initial_step(step);
      return search;
    }

    void approach_constraints(Evaluator &evaluator, std::vector<double> start, const unsigned int evaluations, const double step)
    {
      const std::size_t n = evaluator.problem.dimension;
      const double most   = max_constraint(evaluator.at(start.data()).constraints);
      auto search         = local_search(n + 1, evaluations, step);
      std::vector<double> low(n + 1, 0.), high(n + 1, 1.), x = start;
      low.back()  = -1.;
      high.back() = std::max(most, 1.) + 1.;
      x.push_back(std::max(most, 0.));
      search.set_lower_bounds(low);
      search.set_upper_bounds(high);
      search.set_min_objective(constraint_bound, nullptr);
      search.add_inequality_mconstraint(constraints_below_bound, &evaluator,
                                        std::vector<double>(evaluator.problem.n_constraints));
      search.set_stopval(-1e-3);
      optimise(search, x, evaluator);
    }

    void improve(Evaluator &evaluator, std::vector<double> start, const unsigned int evaluations, const double step)
    {
      const std::size_t n = evaluator.problem.dimension;
      auto search         = local_search(n, evaluations, step);
      search.set_lower_bounds(0.);
      search.set_upper_bounds(1.);
      search.set_min_objective(objective, &evaluator);
      search.add_inequality_mconstraint(constraints, &evaluator, std::vector<double>(evaluator.problem.n_constraints));
      optimise(search, start, evaluator);
    }

    /// Restarts local searches with shorter steps: COBYLA may stop early at an edge between two constraints.
    Optimum from_start(const BoxProblem &problem, std::vector<double> start, const unsigned int evaluations)
    {
      Evaluator evaluator{ problem };
      if (max_constraint(evaluator.at(start.data()).constraints) > 0.)
        for (const double step : { 0.1, 0.01, 1e-3 })
          if (evaluator.best.violation > 0.)
            approach_constraints(evaluator, evaluator.best.place, evaluations, step);
      if (evaluator.best.violation <= 0.)
        for (const double step : { 0.1, 0.02, 1e-3 })
          improve(evaluator, evaluator.best.place, evaluations, step);
      return evaluator.best;
    }

    std::vector<double> global_start(const BoxProblem &problem, const SearchSettings &settings)
    {
      Evaluator evaluator{ problem };
      nlopt::srand(settings.seed);
      nlopt::opt search(nlopt::GN_ISRES, static_cast<unsigned int>(problem.dimension));
      search.set_lower_bounds(0.);
      search.set_upper_bounds(1.);
      search.set_maxeval(static_cast<int>(settings.evaluations));
      search.set_min_objective(objective, &evaluator);
      search.add_inequality_mconstraint(constraints, &evaluator, std::vector<double>(problem.n_constraints));
      optimise(search, std::vector<double>(problem.dimension, 0.5), evaluator);
      return evaluator.best.place;
    }

    /// Finds the smallest objective that satisfies all constraints: by an evolution strategy (ISRES), then by local searches
    /// (COBYLA) from its result and random starts. If none satisfies the constraints, the result has the smallest violation.
    Optimum search_everywhere(const BoxProblem &problem, const SearchSettings &settings)
    {
      if (!settings.near.empty())
        if (const auto found = from_start(problem, settings.near, settings.local); found.violation <= 0.)
          return found;
      const auto begin = global_start(problem, settings);
      auto best        = from_start(problem, begin, settings.local);
      std::mt19937 random(settings.seed);
      std::vector<double> start(problem.dimension);
      for (unsigned int i = 0; i < settings.starts; ++i)
      {
        // The same numbers with any standard library.
        for (double &x : start)
          x = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
        const auto found = from_start(problem, start, settings.local);
        if (is_better(found, best))
          best = found;
      }
      return best;
    }

    SearchSettings search_settings(const DesignProblem &problem)
    {
      SearchSettings search{ problem.settings().evaluations, 24, 400, problem.settings().seed, {} };
      if (problem.is_expensive())
      {
        search.evaluations = std::min(search.evaluations, 600u);
        search.starts      = 3;
        search.local       = 150;
      }
      return search;
    }

    /// Returns the demand to be at least as good as `value` by an aim.
    Demand limited_by(const DesignAim &aim, const double value)
    {
      return { aim.term, aim.maximises ? DemandKind::at_least : DemandKind::at_most, value, 0., {} };
    }

    /// Returns whether lever a is better than b by an aim, by more than `share` of b's value.
    bool beats(const DesignAim &aim, const Proposal &a, const Proposal &b, const double share)
    {
      const double first = term_value(aim.term, a), second = term_value(aim.term, b);
      return (aim.maximises ? first - second : second - first) > share * std::abs(second);
    }

    /// Returns whether another lever is better by one aim and not worse by the other (Pareto dominance).
    bool is_dominated(const std::vector<DesignAim> &aims, const Proposal &lever, const std::vector<Proposal> &others)
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

  Found best_lever(const DesignProblem &problem, const std::optional<Proposal> &near)
  {
    auto search = search_settings(problem);
    if (near)
      search.near = problem.search_point(near->parameters);
    const auto optimum = search_everywhere(problem.box(problem.settings().aims.front()), search);
    return { problem.at(optimum.place), optimum.violation <= 0., std::max(0., optimum.violation) };
  }

  std::vector<StoppingDemand> stopping_demands(const DesignProblem &problem)
  {
    std::vector<StoppingDemand> result;
    for (std::size_t i = 0; i < problem.settings().demanded.size(); ++i)
    {
      const auto optimum = search_everywhere(problem.box({}, i), search_settings(problem));
      if (optimum.violation > 0.)
        continue;
      const auto nearest = problem.at(optimum.place);
      result.push_back({ i, nearest.worst[i], nearest });
    }
    return result;
  }

  std::vector<Proposal> pareto_front(const DesignProblem &problem)
  {
    const auto &aims      = problem.settings().aims;
    const auto settings   = search_settings(problem);
    const auto best       = [&](const DesignAim &aim) { return problem.at(search_everywhere(problem.box(aim), settings).place); };
    const auto best_first = best(aims[0]), best_second = best(aims[1]);
    const double from = term_value(aims[1].term, best_first), to = term_value(aims[1].term, best_second);
    std::vector<Proposal> all = { best_first };
    const unsigned int last   = problem.settings().front_points - 1;
    for (unsigned int i = 1; i <= last; ++i)
    {
      // The bound at the optimum itself could be met only up to round-off.
      const double share = i < last ? static_cast<double>(i) / last : 1. - 1e-6;
      const double limit = from + share * (to - from);
      const auto optimum = search_everywhere(problem.box(aims[0], {}, limited_by(aims[1], limit)), settings);
      if (optimum.violation <= 0.)
        all.push_back(problem.at(optimum.place));
    }
    return filtered(all, [&](const Proposal &lever) { return !is_dominated(aims, lever, all); });
  }
} // namespace sprag
