// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/optimisation.h"

#include "base/interrupt.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace sprag
{
  namespace
  {
    double largest_of(const std::vector<double> &constraints)
    {
      return *std::max_element(constraints.begin(), constraints.end());
    }

    /// Whether one place is better than another: those that keep all constraints by their objective, the others by how far they
    /// are from that.
    bool is_better(const Optimum &a, const Optimum &b)
    {
      if (a.violation <= 0. && b.violation <= 0.)
        return a.objective < b.objective;
      return std::max(a.violation, 0.) < std::max(b.violation, 0.);
    }

    /// Evaluates once where the library asks for objective and constraints of one place apart, and keeps the best place.
    class Evaluator
    {
    public:
      explicit Evaluator(const BoxProblem &of)
          : problem(of)
      {
      }

      const BoxProblem::Evaluation &at(const double *first)
      {
        const std::vector<double> asked(first, first + problem.dimension);
        // An interrupted search comes to its end without computing anything more.
        if (asked == place || (interrupted() && !place.empty()))
          return last;
        place = asked;
        last  = problem.evaluate(place);
        const Optimum here{ place, last.objective, largest_of(last.constraints) };
        if (found.place.empty() || is_better(here, found))
          found = here;
        return last;
      }

      const BoxProblem &of() const
      {
        return problem;
      }

      const Optimum &best() const
      {
        return found;
      }

    private:
      const BoxProblem &problem;
      std::vector<double> place;
      BoxProblem::Evaluation last;
      Optimum found{ {}, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
    };

    Evaluator &evaluator_of(void *data)
    {
      return *static_cast<Evaluator *>(data);
    }

    double objective(unsigned int, const double *x, double *, void *data)
    {
      return evaluator_of(data).at(x).objective;
    }

    void constraints(unsigned int, double *result, unsigned int, const double *x, double *, void *data)
    {
      const auto &values = evaluator_of(data).at(x).constraints;
      std::copy(values.begin(), values.end(), result);
    }

    double largest_constraint(unsigned int, const double *x, double *, void *data)
    {
      return largest_of(evaluator_of(data).at(x).constraints);
    }

    // Behind the place stands a bound on all constraints.
    double bound(const unsigned int n, const double *x, double *, void *)
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

    void optimise(nlopt::opt &search, std::vector<double> x)
    {
      double value = 0.;
      try
      {
        search.optimize(x, value);
      }
      catch (const nlopt::roundoff_limited &)
      {
        // As exact as it can be.
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
      const std::size_t n = evaluator.of().dimension;
      const double most   = largest_of(evaluator.at(start.data()).constraints);
      auto search         = local_search(n + 1, evaluations, step);
      std::vector<double> low(n + 1, 0.), high(n + 1, 1.), x = start;
      low.back()  = -1.;
      high.back() = std::max(most, 1.) + 1.;
      x.push_back(std::max(most, 0.));
      search.set_lower_bounds(low);
      search.set_upper_bounds(high);
      search.set_min_objective(bound, nullptr);
      search.add_inequality_mconstraint(constraints_below_bound, &evaluator, std::vector<double>(evaluator.of().n_constraints));
      search.set_stopval(-1e-3);
      optimise(search, x);
    }

    void improve(Evaluator &evaluator, std::vector<double> start, const unsigned int evaluations, const double step)
    {
      const std::size_t n = evaluator.of().dimension;
      auto search         = local_search(n, evaluations, step);
      search.set_lower_bounds(0.);
      search.set_upper_bounds(1.);
      search.set_min_objective(objective, &evaluator);
      search.add_inequality_mconstraint(constraints, &evaluator, std::vector<double>(evaluator.of().n_constraints));
      optimise(search, start);
    }

    /// Steps become shorter where the search begins anew, as it may stop at an edge between two constraints.
    Optimum from_start(const BoxProblem &problem, std::vector<double> start, const unsigned int evaluations,
                       const bool only_approaches)
    {
      Evaluator evaluator(problem);
      if (largest_of(evaluator.at(start.data()).constraints) > 0.)
        for (const double step : { 0.1, 0.01, 1e-3 })
          if (evaluator.best().violation > 0.)
            approach_constraints(evaluator, evaluator.best().place, evaluations, step);
      if (!only_approaches && evaluator.best().violation <= 0.)
        for (const double step : { 0.1, 0.02, 1e-3 })
          improve(evaluator, evaluator.best().place, evaluations, step);
      return evaluator.best();
    }

    std::vector<double> global_start(const BoxProblem &problem, const SearchSettings &settings, const bool only_approaches)
    {
      Evaluator evaluator(problem);
      nlopt::srand(settings.seed);
      nlopt::opt search(nlopt::GN_ISRES, static_cast<unsigned int>(problem.dimension));
      search.set_lower_bounds(0.);
      search.set_upper_bounds(1.);
      search.set_maxeval(static_cast<int>(settings.evaluations));
      search.set_min_objective(only_approaches ? largest_constraint : objective, &evaluator);
      if (!only_approaches)
        search.add_inequality_mconstraint(constraints, &evaluator, std::vector<double>(problem.n_constraints));
      optimise(search, std::vector<double>(problem.dimension, 0.5));
      return evaluator.best().place;
    }

    Optimum search_everywhere(const BoxProblem &problem, const SearchSettings &settings, const bool only_approaches)
    {
      if (!settings.near.empty())
        if (const auto found = from_start(problem, settings.near, settings.local, only_approaches); found.violation <= 0.)
          return found;
      const auto begin = global_start(problem, settings, only_approaches);
      auto best        = from_start(problem, begin, settings.local, only_approaches);
      std::mt19937 random(settings.seed);
      std::vector<double> start(problem.dimension);
      for (unsigned int i = 0; i < settings.starts && !(only_approaches && best.violation <= 0.); ++i)
      {
        // The same numbers with any standard library.
        for (double &x : start)
          x = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
        const auto found = from_start(problem, start, settings.local, only_approaches);
        if (is_better(found, best))
          best = found;
      }
      return best;
    }
  } // namespace

  Optimum least_violation(const BoxProblem &problem, const SearchSettings &settings)
  {
    return search_everywhere(problem, settings, true);
  }

  Optimum best_in_box(const BoxProblem &problem, const SearchSettings &settings)
  {
    return search_everywhere(problem, settings, false);
  }
} // namespace sprag
