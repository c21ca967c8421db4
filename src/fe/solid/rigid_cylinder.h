#pragma once

#include "fe/solid/cylinder_axes.h"
#include "scene/apparatus.h"
#include "scene/lever.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace sprag
{
  /// Geometry of a point of the lever against the cylinder, in the coordinates (displacement along xi, eta and zeta, theta, x,
  /// tilt, skew) or, of an axis that is fixed, in the first five. zeta counts across the lever's width from its middle. The first
  /// slip is that round the cylinder, the second along its axis.
  template <int coordinates>
  struct SurfaceKinematicsIn
  {
    static constexpr int n = coordinates;
    using Row              = dealii::Tensor<1, n>;
    using Curvature        = dealii::Tensor<2, n>;

    double gap = 0.; ///< [mm], positive when open
    Row gap_row;
    Curvature gap_curvature;
    std::array<double, 2> slip{}; ///< coordinates on the cylinder's surface [mm]
    std::array<Row, 2> slip_row;
    std::array<Curvature, 2> slip_curvature;
  };

  using SurfaceKinematics      = SurfaceKinematicsIn<7>;
  using FixedSurfaceKinematics = SurfaceKinematicsIn<5>;

  /// The damper's cylinder as a rigid body of finite length: its axis may lie out of true, by slopes towards the lever (tilt) and
  /// along x (skew), it may be a barrel and have rounded ends. Distances are measured across the axis: barrel and rounding are
  /// added to them as a profile over the place s along the axis, which is exact up to the square of their slope.
  class RigidCylinder
  {
  public:
    RigidCylinder(const Geometry &geometry, const Cylinder &cylinder);

    /// The cylinder at its position x from the pivot frame's origin, before a lever inclined by theta, its axis turned beyond the
    /// scene's slopes.
    struct Pose
    {
      double x          = 0.;
      double theta      = 0.;
      AxisSlopes turned = {};
      double cosine     = 1.;
      double sine       = 0.;
      CylinderAxes axes;
    };

    Pose pose(double x, double theta, const AxisSlopes &turned = {}) const;

    /// What gaps and slips of points follow from, beside the pose.
    struct Shape
    {
      double pivot_distance, pivot_height; ///< of the lever [mm]
      double radius;                       ///< R [mm]
      double half_length;                  ///< infinite without ends [mm]
      double position;                     ///< of the middle, along zeta [mm]
      double edge_radius;                  ///< 0 without rounding [mm]
      double crown;                        ///< curvature of the barrel [1/mm]

      /// Share of the rounding's depth beyond which the end is a wall.
      static constexpr double last_of_rounding = 0.999;

      /// Bound of the slope of barrel and rounding within some distance from the middle [mm].
      double largest_slope(double distance) const;
    };

    Shape shape() const;

    /// Of the scene.
    const AxisSlopes &slopes() const
    {
      return at_rest;
    }

    /// Returns the gap of a point of the lever; beyond the cylinder's ends it is at least the distance from them [mm].
    double gap(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns it and its gradient by the place of the point, in lever axes.
    std::pair<double, dealii::Tensor<1, 3>> gap_and_gradient(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns the slip coordinates of a point [mm].
    std::array<double, 2> slips(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns all in 5 or 7 coordinates.
    template <int n = SurfaceKinematics::n>
    SurfaceKinematicsIn<n> kinematics(const Pose &pose, const dealii::Point<3> &point) const;

    /// Whether its shaft lets the axis yield.
    bool has_free_axis() const
    {
      return is_free;
    }

    // Places of the cylinder at x = 0 with the scene's slopes in the axes of the world, see DevicePose; `along` counts from the
    // middle [mm].
    dealii::Point<3> on_axis(double along) const;
    dealii::Point<3> on_surface(double along, double angle) const;

  private:
    using Vector = dealii::Tensor<1, 3>;

    /// Where a point is seen from the cylinder, in the axes of the world.
    struct Place
    {
      Vector from_centre;
      double along;  ///< s [mm]
      Vector across; ///< off the axis
      double radius; ///< its length
    };

    /// How far the surface lies back at a place along the axis, and its derivatives.
    struct Profile
    {
      double value = 0., slope = 0., curvature = 0.;
    };

    std::array<double, 2> slips_of(const Pose &pose, const Place &place) const;
    Place place_of(const Pose &pose, const dealii::Point<3> &point) const;
    Profile profile(double along) const;
    double beyond_ends(double along) const;

    const Geometry geometry;
    const double half_length; ///< infinite without ends [mm]
    const double position;
    const double edge_radius;
    const double crown; ///< curvature of the barrel [1/mm]
    const AxisSlopes at_rest;
    const bool is_free;
    const CylinderAxes axes_at_rest;
  };
} // namespace sprag
