// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_body.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "fe/body/body_properties.h"
#include "fe/body/end_face.h"
#include "fe/mesh/geometry_script.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// A leaf is at least as thick, over its length. Half of that is 0.4 % off by round-off, a twentieth buckles at rest.
    constexpr double thinnest = 2e-4;

    void refuse_impossible_shapes(const LeafSpring &leaf)
    {
      std::vector<std::string> mistakes;
      const auto refuse = [&](const std::string &name, const double value)
      {
        mistakes.push_back("Leaf spring/" + name + " = " + rounded_text(value) +
                           ": must be less than half of Leaf spring/Length (" + rounded_text(0.5 * leaf.length) + " mm)");
      };
      if (!(std::abs(leaf.sagitta) < 0.5 * leaf.length))
        refuse("Sagitta", leaf.sagitta);
      if (!(leaf.thickness < 0.5 * leaf.length))
        refuse("Thickness", leaf.thickness);
      if (!(leaf.thickness >= thinnest * leaf.length))
        mistakes.push_back("Leaf spring/Thickness = " + rounded_text(leaf.thickness) + ": must be at least " +
                           rounded_text(thinnest) + " of Leaf spring/Length (" + rounded_text(thinnest * leaf.length) +
                           " mm), or its stiffness is lost in round-off");
      if (!mistakes.empty())
        throw InputError(mistakes);
    }

    Point<2> arc_centre(const LeafSpring &leaf)
    {
      const double radius = (0.25 * leaf.length * leaf.length + leaf.sagitta * leaf.sagitta) / (2. * leaf.sagitta);
      return { -leaf.clamp_distance - 0.5 * leaf.length, leaf.sagitta - radius };
    }

    bool is_bent(const LeafSpring &leaf)
    {
      return std::abs(leaf.sagitta) >= 1e-6 * leaf.length;
    }
  } // namespace

  LeafElements leaf_elements(const LeafSpring &leaf)
  {
    return { static_cast<unsigned int>(std::ceil(7. * std::sqrt(leaf.length / leaf.thickness))), 2 };
  }

  void make_leaf_mesh(const LeafSpring &leaf, const LeafElements &elements, Triangulation<2> &triangulation)
  {
    refuse_impossible_shapes(leaf);
    const MeshGroups groups{ { { "leaf", material_id::leaf } },
                             { { "hub", boundary_id::clamp }, { "joint", boundary_id::joint } },
                             "'leaf'" };
    read_gmsh(mesh_script("leaf.geo"),
              { { "leaf_length", leaf.length },
                { "leaf_thickness", leaf.thickness },
                { "sagitta", leaf.sagitta },
                { "clamp_distance", leaf.clamp_distance },
                { "elements_along", elements.along },
                { "elements_across", elements.across } },
              groups, triangulation);
    if (!is_bent(leaf))
      return;
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, PolarManifold<2>(arc_centre(leaf)));
  }

  namespace
  {
    /// Turns that are tried at once, and at which the leaf is given up [rad].
    constexpr double largest_step  = 0.02;
    constexpr double smallest_step = 1e-5;

    BodyProperties make_properties(const LeafSpring &leaf, const PlaneState plane)
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
      return mapped(DoFTools::extract_boundary_dofs(body.dofs(), mask, { boundary }),
                    [](const auto dof) { return static_cast<unsigned int>(dof); });
    }

    void hold_all(const std::vector<unsigned int> &dofs, AffineConstraints<double> &constraints)
    {
      for (const unsigned int dof : dofs)
        constraints.add_line(dof);
    }

    void couple(const std::vector<unsigned int> &dofs, AffineConstraints<double> &constraints)
    {
      for (std::size_t i = 1; i < dofs.size(); ++i)
      {
        constraints.add_line(dofs[i]);
        constraints.add_entry(dofs[i], dofs.front(), 1.);
      }
    }

    /// Holds the mean over the joint's section. A single node that were held would dent the leaf by more the finer its mesh.
    void hold_mean(const ElasticBody<2> &body, const unsigned int component, AffineConstraints<double> &constraints)
    {
      const auto &fe = body.dofs().get_fe();
      FEFaceValues<2> values(body.cell_mapping(), fe, QGauss<1>(fe.degree + 1), update_values | update_JxW_values);
      std::map<types::global_dof_index, double> weights;
      for (const auto &[cell, f] : boundary_faces(body.dofs(), boundary_id::joint))
      {
        values.reinit(cell, f);
        const auto indices = cell_dofs(cell);
        for (unsigned int i = 0; i < indices.size(); ++i)
          if (fe.system_to_component_index(i).first == component && fe.has_support_on_face(i, f))
            for (const unsigned int q : values.quadrature_point_indices())
              weights[indices[i]] += values.shape_value(i, q) * values.JxW(q);
      }
      const auto largest =
          std::max_element(weights.begin(), weights.end(), [](const auto &a, const auto &b) { return a.second < b.second; });
      constraints.add_line(largest->first);
      for (const auto &[dof, weight] : weights)
        if (dof != largest->first)
          constraints.add_entry(largest->first, dof, -weight / largest->second);
    }

    void hold_joint(const LeafSpring &leaf, const ElasticBody<2> &body, AffineConstraints<double> &constraints)
    {
      const bool slides = leaf.axial == LeafAxial::free;
      if (leaf.end == LeafEnd::loose)
        return;
      if (leaf.end == LeafEnd::pinned)
      {
        hold_mean(body, 1, constraints);
        if (!slides)
          hold_mean(body, 0, constraints);
        return;
      }
      const auto hold = [&](const unsigned int component, const bool moves)
      {
        const auto dofs = dofs_on(body, component, boundary_id::joint);
        if (moves)
          couple(dofs, constraints);
        else
          hold_all(dofs, constraints);
      };
      hold(1, leaf.end == LeafEnd::guided);
      hold(0, slides);
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
      : elastic(meshed(leaf, elements, triangulation), make_properties(leaf, plane))
      , finite_statics(elastic, hold(leaf))
  {
  }

  AffineConstraints<double> LeafBody::hold(const LeafSpring &leaf)
  {
    std::vector<Point<2>> positions(elastic.n_dofs());
    DoFTools::map_dofs_to_support_points(elastic.cell_mapping(), elastic.dofs(), positions);
    AffineConstraints<double> constraints;
    for (const unsigned int component : { 0u, 1u })
    {
      const auto dofs = dofs_on(elastic, component, boundary_id::clamp);
      hold_all(dofs, constraints);
      for (const unsigned int dof : dofs)
        clamp.push_back({ dof, component, positions[dof] });
    }
    hold_joint(leaf, elastic, constraints);
    constraints.close();
    return constraints;
  }

  LeafBody::State LeafBody::state(const double turn, Vector<double> guess)
  {
    const double sine = std::sin(turn);
    const double less = -2. * std::pow(std::sin(0.5 * turn), 2); // cosine - 1
    Vector<double> rate(elastic.n_dofs()), second_rate(elastic.n_dofs());
    const Vector<double> no_loads(elastic.n_dofs());
    for (const auto &[dof, component, X] : clamp)
    {
      const Point<2> turned(X[0] + less * X[0] - sine * X[1], X[1] + sine * X[0] + less * X[1]);
      guess[dof]       = turned[component] - X[component];
      rate[dof]        = component == 0 ? -turned[1] : turned[0];
      second_rate[dof] = -turned[component];
    }
    State result;
    result.turn         = turn;
    result.displacement = std::move(guess);
    finite_statics.balance(result.displacement, no_loads);
    if (!finite_statics.is_stable())
      throw AnalysisError("the leaf spring buckles when the hub turns by " + rounded_text(turn) + " rad");
    result.rate = finite_statics.response(rate, no_loads);
    // The work of the residual on the rate makes the error of the moment one of second order.
    result.moment    = result.rate * finite_statics.forces();
    result.stiffness = finite_statics.stiffness_product(result.rate) * result.rate + finite_statics.forces() * second_rate;
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
          throw AnalysisError("the leaf spring finds no equilibrium when the hub turns by more than " + rounded_text(at.turn) +
                              " rad: it buckles or snaps through there. Try a smaller 'Leaf spring/Sagitta' or one of the other "
                              "sign, or 'Leaf spring/Axial' = free");
      }
    }
    return result;
  }
} // namespace sprag
