// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/finite_statics.h"
#include "scene/analysis_settings.h"
#include "scene/apparatus.h"

#include <deal.II/grid/tria.h>

#include <vector>

namespace sprag
{
  /// Number of elements of a leaf spring's mesh.
  struct LeafElements
  {
    unsigned int along;
    unsigned int across;
  };

  /// Returns as many elements of degree 2 as put the stiffness of a thin leaf within 2.5e-4 of that of a fine mesh.
  LeafElements leaf_elements(const LeafSpring &leaf);

  /// Makes the mesh of the built-in `meshes/leaf.geo`, in axes of the lever at rest: material_id::leaf from boundary_id::clamp to
  /// boundary_id::joint. A bent leaf has a manifold, on which its cells are curved. Throws InputError where leaf.sagitta or
  /// leaf.thickness is half of the length or more.
  void make_leaf_mesh(const LeafSpring &leaf, const LeafElements &elements, dealii::Triangulation<2> &triangulation);

  /// A leaf spring of finite elements, degree 2, St. Venant-Kirchhoff, in axes of the lever at rest. Its clamp moves as a rigid
  /// body that the hub turns about the pivot, its joint as LeafSpring::end and axial allow: a clamped or guided end moves as one
  /// without turning, of a pinned one the mean over the section is held, and a loose one is free.
  class LeafBody
  {
  public:
    LeafBody(const LeafSpring &leaf, PlaneState plane);
    LeafBody(const LeafSpring &leaf, PlaneState plane, const LeafElements &elements);

    /// Returns the body, which holds no degree of freedom itself, for fields.
    const ElasticBody<2> &body() const
    {
      return elastic;
    }

    /// Equilibrium at a turn of the hub.
    struct State
    {
      double turn      = 0.;               ///< [rad]
      double moment    = 0.;               ///< about the pivot, that turns the hub so [N mm]
      double stiffness = 0.;               ///< d(moment)/d(turn) [N mm/rad]
      dealii::Vector<double> displacement; ///< of all degrees of freedom [mm]
      dealii::Vector<double> rate;         ///< d(displacement)/d(turn) [mm/rad]
    };

    State rest()
    {
      return state(0., dealii::Vector<double>(elastic.n_dofs()));
    }

    /// Finds the equilibrium at a turn of the hub by Newton's method from a guess. Throws AnalysisError where there is none to be
    /// found.
    State state(double turn, dealii::Vector<double> guess);

    /// Follows the equilibrium in steps, of at most 0.02 rad and halved where Newton's method fails, from another state to a turn
    /// and returns their states; the last is that of the turn. Throws AnalysisError saying what to try.
    std::vector<State> steps(const State &from, double turn);

    /// Returns the statics of the last state that was found.
    const FiniteStatics &statics() const
    {
      return finite_statics;
    }

  private:
    /// A degree of freedom of the clamp.
    struct ClampDof
    {
      unsigned int dof;
      unsigned int component;
      dealii::Point<2> position;
    };

    dealii::AffineConstraints<double> hold(const LeafSpring &leaf);

    dealii::Triangulation<2> triangulation;
    const ElasticBody<2> elastic;
    std::vector<ClampDof> clamp;
    FiniteStatics finite_statics;
  };

  /// Fills in mass, inertia, momentum and the lowest vibrations with the hub held, linear about rest, all with the consistent
  /// mass matrix of a density [t/mm^3] and a mass [t] on the section at the joint.
  void add_inertia(LeafBody &leaf, double density, double joint_mass, LeafBehaviour &behaviour);
} // namespace sprag
