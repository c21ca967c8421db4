#pragma once

#include "fe/body/finite_statics.h"
#include "fe/leaf/leaf_mesh.h"
#include "scene/scene.h"

#include <vector>

namespace sprag
{
  /// A leaf spring of finite elements, degree 2, St. Venant-Kirchhoff, in axes of the lever at rest. Its clamp moves as a rigid
  /// body that the hub turns about the pivot, its joint as LeafSpring::end and axial allow: a clamped or guided end moves as one
  /// without turning, of a pinned one the mean over the section is held, and a loose
  /// one is free.
  class LeafBody
  {
  public:
    LeafBody(const LeafSpring &leaf, PlaneState plane);
    LeafBody(const LeafSpring &leaf, PlaneState plane, const LeafElements &elements);

    /// For FieldFrames. Holds no degree of freedom itself.
    const ElasticBody<2> &body() const
    {
      return elastic;
    }

    /// In equilibrium at a turn of the hub.
    struct State
    {
      double turn      = 0.;               ///< [rad]
      double moment    = 0.;               ///< about the pivot, that turns the hub so [N mm]
      double stiffness = 0.;               ///< d(moment)/d(turn) [N mm/rad]
      dealii::Vector<double> displacement; ///< of all degrees of freedom [mm]
      dealii::Vector<double> rate;         ///< d(displacement)/d(turn) [mm/rad]
    };

    State rest();

    /// Newton's method from a guess. Throws AnalysisError where that finds no equilibrium.
    State state(double turn, dealii::Vector<double> guess);

    /// The states of the steps, of at most 0.02 rad and halved where Newton's method fails, from another state to a turn; the
    /// last is that of the turn. Throws AnalysisError saying what to try.
    std::vector<State> steps(const State &from, double turn);

    /// Of the last state.
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
} // namespace sprag
