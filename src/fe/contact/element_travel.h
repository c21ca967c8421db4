// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_elements.h"
#include "fe/contact/rigid_cylinder.h"

#include <optional>

namespace sprag
{
  /// Bound on the approach of an element's points to the cylinder over all of their way. It only grows: a point whose gap is
  /// known at some place touches nothing until the bound has grown by as much.
  template <int dim>
  class ElementTravel
  {
  public:
    using Nodal = typename FaceElements<dim>::Nodal;

    /// `farthest`: of the undeformed points from the lever's pivot [mm]; `most_shapes`: the largest sum of sizes of a point's
    /// shapes.
    ElementTravel(double farthest, double most_shapes);

    /// Adds the travel to these displacements of the element's nodes and this position of the cylinder; begins there the first
    /// time.
    void go_to(const Nodal &displacement, const RigidCylinder::Pose &pose, const RigidCylinder::Shape &cylinder);

    /// The bound, over all of the way [mm]; infinite from then on where that went far away.
    double length() const
    {
      return sum;
    }

    /// Displacements where it went to last.
    const Nodal &displacement() const
    {
      return last->displacement;
    }

  private:
    /// Displacements of the element and pose of the cylinder.
    struct Place
    {
      Nodal displacement;
      double x, theta;
      dealii::Tensor<1, 3> axis;
    };

    double farthest, most_shapes;
    std::optional<Place> last;
    double sum = 0.;
  };
} // namespace sprag
