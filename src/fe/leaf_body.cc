#include "fe/leaf_body.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Turns that are tried at once, and at which the leaf is given up [rad].
    constexpr double largest_step  = 0.02;
    constexpr double smallest_step = 1e-5;

    BodyProperties properties_of(const LeafSpring &leaf, const PlaneState plane)
    {
      BodyProperties properties;
      properties.degree    = 2;
      properties.plane     = plane;
      properties.material  = MaterialModel::st_venant_kirchhoff;
      properties.width     = leaf.width;
      properties.curved    = is_bent(leaf);
      properties.constants = { { material_id::leaf, { leaf.young_modulus, leaf.poisson_ratio } } };
      return properties;
    }

    const Triangulation<2> &meshed(const LeafSpring &leaf, const LeafElements &elements, Triangulation<2> &triangulation)
    {
      make_leaf_mesh(leaf, elements, triangulation);
      return triangulation;
    }

    std::vector<unsigned int> dofs_on(const ElasticBody<2> &body, const unsigned int component, const types::boundary_id boundary)
    {
      ComponentMask mask(2, false);
      mask.set(component, true);
      std::vector<unsigned int> result;
      for (const auto dof : DoFTools::extract_boundary_dofs(body.dofs(), mask, { boundary }))
        result.push_back(static_cast<unsigned int>(dof));
      return result;
    }

    std::vector<Point<2>> positions_of(const ElasticBody<2> &body)
    {
      std::vector<Point<2>> result(body.n_dofs());
      DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), result);
      return result;
    }

    /// Of a set of degrees of freedom on the joint that at the middle of its section.
    unsigned int middle_of(const std::vector<unsigned int> &dofs, const std::vector<Point<2>> &positions)
    {
      Point<2> middle;
      for (const unsigned int dof : dofs)
        middle += Tensor<1, 2>(positions[dof]) / static_cast<double>(dofs.size());
      return *std::min_element(dofs.begin(), dofs.end(),
                               [&](const unsigned int a, const unsigned int b)
                               { return positions[a].distance_square(middle) < positions[b].distance_square(middle); });
    }

    /// What moves the degrees of freedom, before they are numbered.
    class Followers
    {
    public:
      explicit Followers(const unsigned int n_dofs)
          : leaders(n_dofs)
      {
        for (unsigned int dof = 0; dof < n_dofs; ++dof)
          leaders[dof] = dof;
      }

      void hold(const std::vector<unsigned int> &dofs)
      {
        for (const unsigned int dof : dofs)
          leaders[dof] = FiniteStatics::held;
      }

      void tie(const std::vector<unsigned int> &dofs)
      {
        for (const unsigned int dof : dofs)
          leaders[dof] = dofs.front();
      }

      std::vector<unsigned int> coordinates() const
      {
        std::vector<unsigned int> number(leaders.size(), FiniteStatics::held);
        unsigned int n = 0;
        for (unsigned int dof = 0; dof < leaders.size(); ++dof)
          if (leaders[dof] == dof)
            number[dof] = n++;
        std::vector<unsigned int> result(leaders.size(), FiniteStatics::held);
        for (unsigned int dof = 0; dof < leaders.size(); ++dof)
          if (leaders[dof] != FiniteStatics::held)
            result[dof] = number[leaders[dof]];
        return result;
      }

    private:
      std::vector<unsigned int> leaders;
    };

    void hold_joint(const LeafSpring &leaf, const ElasticBody<2> &body, const std::vector<Point<2>> &positions,
                    Followers &followers)
    {
      const auto along  = dofs_on(body, 0, boundary_id::joint);
      const auto across = dofs_on(body, 1, boundary_id::joint);
      const bool slides = leaf.axial == LeafAxial::free;
      switch (leaf.end)
      {
      case LeafEnd::clamped:
        followers.hold(across);
        break;
      case LeafEnd::guided:
        followers.tie(across);
        break;
      case LeafEnd::pinned:
        followers.hold({ middle_of(across, positions) });
        if (!slides)
          followers.hold({ middle_of(along, positions) });
        return;
      }
      if (slides)
        followers.tie(along);
      else
        followers.hold(along);
    }

    /// Along the tangent.
    Vector<double> continued(const LeafBody::State &from, const double step)
    {
      Vector<double> result = from.displacement;
      result.add(step, from.rate);
      return result;
    }
  } // namespace

  LeafBody::LeafBody(const LeafSpring &leaf, const PlaneState plane)
      : LeafBody(leaf, plane, leaf_elements(leaf))
  {
  }

  LeafBody::LeafBody(const LeafSpring &leaf, const PlaneState plane, const LeafElements &elements)
      : elastic(meshed(leaf, elements, triangulation), properties_of(leaf, plane))
      , finite_statics(elastic, find_coordinates(leaf))
  {
  }

  std::vector<unsigned int> LeafBody::find_coordinates(const LeafSpring &leaf)
  {
    const auto positions = positions_of(elastic);
    Followers followers(elastic.n_dofs());
    for (const unsigned int component : { 0u, 1u })
    {
      const auto dofs = dofs_on(elastic, component, boundary_id::clamp);
      followers.hold(dofs);
      for (const unsigned int dof : dofs)
        clamp.push_back({ dof, component, positions[dof] });
    }
    hold_joint(leaf, elastic, positions, followers);
    return followers.coordinates();
  }

  const ElasticBody<2> &LeafBody::body() const
  {
    return elastic;
  }

  const FiniteStatics &LeafBody::statics() const
  {
    return finite_statics;
  }

  LeafBody::State LeafBody::rest()
  {
    return state(0., Vector<double>(elastic.n_dofs()));
  }

  LeafBody::State LeafBody::state(const double turn, Vector<double> guess)
  {
    const double sine = std::sin(turn);
    const double less = -2. * std::pow(std::sin(0.5 * turn), 2); // cosine - 1
    Vector<double> rate(elastic.n_dofs()), rate_of_rate(elastic.n_dofs());
    const Vector<double> no_loads(elastic.n_dofs());
    for (const auto &[dof, component, X] : clamp)
    {
      const Point<2> turned(X[0] + less * X[0] - sine * X[1], X[1] + sine * X[0] + less * X[1]);
      guess[dof]        = turned[component] - X[component];
      rate[dof]         = component == 0 ? -turned[1] : turned[0];
      rate_of_rate[dof] = -turned[component];
    }
    State result;
    result.turn         = turn;
    result.displacement = std::move(guess);
    finite_statics.balance(result.displacement, no_loads);
    if (!finite_statics.is_stable())
      throw AnalysisError("the leaf spring buckles when the hub turns by " + rounded_text(turn) + " rad");
    result.rate = finite_statics.response(rate, no_loads);
    // The work of what is left unbalanced on the rate makes the moment's error one of second order.
    result.moment    = result.rate * finite_statics.forces();
    result.stiffness = finite_statics.stiffness_product(result.rate) * result.rate + finite_statics.forces() * rate_of_rate;
    return result;
  }

  std::vector<LeafBody::State> LeafBody::steps(const State &from, const double turn)
  {
    std::vector<State> result;
    double step = (turn - from.turn) / std::ceil(std::abs(turn - from.turn) / largest_step);
    State at    = from;
    while (result.empty() || at.turn != turn)
    {
      const bool last   = std::abs(turn - at.turn) <= 1.001 * std::abs(step);
      const double next = last ? turn : at.turn + step;
      try
      {
        at = state(next, continued(at, next - at.turn));
        result.push_back(at);
      }
      catch (const AnalysisError &)
      {
        step *= 0.5;
        if (!(std::abs(step) > smallest_step))
          throw AnalysisError(
              "the leaf spring finds no equilibrium when the hub turns by more than " + rounded_text(at.turn) +
              " rad: it buckles or snaps through there. Try a smaller 'Leaf spring/Sagitta' or one of the other sign, or "
              "'Leaf spring/Axial' = free");
      }
    }
    return result;
  }
} // namespace sprag
