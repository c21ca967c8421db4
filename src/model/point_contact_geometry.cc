// SPDX-License-Identifier: GPL-3.0-only
#include "model/point_contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr int n_nodal_of_element = 4;

    /// Cubic shapes of an element of length h at s h from its first node, 0 <= s <= 1, and their derivatives along it; for
    /// deflection and slope of the first node, then of the second.
    template <class N>
    struct HermiteShapes
    {
      HermiteShapes(const double h, const N &s)
          : shape{ 1. - s * s * (3. - 2. * s), h * (s * (1. - s) * (1. - s)), s * s * (3. - 2. * s), -h * (s * s * (1. - s)) }
          , slope{ 6. / h * (s * (s - 1.)), 1. + s * (3. * s - 4.), 6. / h * (s * (1. - s)), s * (3. * s - 2.) }
          , curvature{ 1. / (h * h) * (12. * s - 6.), 1. / h * (6. * s - 4.), 1. / (h * h) * (6. - 12. * s),
                       1. / h * (6. * s - 2.) }
      {
      }

      N shape[n_nodal_of_element], slope[n_nodal_of_element], curvature[n_nodal_of_element];
    };
  } // namespace

  /// The bent surface at a place, in numbers of some kind.
  template <class N>
  struct PointContact::Surface
  {
    N xi, eta;
    N tangent[2];                ///< d(xi, eta)/d(place)
    N shape[n_nodal_of_element]; ///< deflection by the element's coordinates, and its derivative along the lever
    N slope[n_nodal_of_element];
  };

  /// Two elements around the point across from the circle's centre: the contact stays between their ends for a step.
  unsigned int PointContact::window_at(const Vector<double> &ports, const double x) const
  {
    const auto &mesh = properties.mesh;
    if (mesh.elements == 0)
      return 0;
    const Local q       = coordinates(0, ports, x);
    const double xi     = cylinder_centre(properties.geometry, q[x_index], q[theta_index]).xi;
    const double before = std::round(xi / mesh.element_length()) - 1.;
    return static_cast<unsigned int>(std::clamp(before, 0., mesh.elements - 2.));
  }

  PointContact::Local PointContact::coordinates(const unsigned int window, const Vector<double> &ports, const double x) const
  {
    Local q = rates(window, ports, x);
    q[theta_index] += properties.rest_inclination;
    return q;
  }

  PointContact::Local PointContact::rates(const unsigned int window, const Vector<double> &port_rates, const double v) const
  {
    Local q;
    if (properties.mesh.elements > 0)
      for (unsigned int i = 0; i < n_nodal; ++i)
        if (window + i / 2 > 0)
          q[i] = port_rates[2 * window + i - 2];
    q[theta_index] = port_rates[properties.ports.rotation()];
    q[x_index]     = v - (properties.ports.sprung ? port_rates[properties.ports.support()] : 0.);
    return q;
  }

  unsigned int PointContact::first_of_element(const unsigned int window, const double xi) const
  {
    return properties.mesh.elements > 0 && xi >= (window + 1) * properties.mesh.element_length() ? 2 : 0;
  }

  template <class N, class Nodal>
  PointContact::Surface<N> PointContact::surface(const unsigned int window, const Nodal &nodal, const N &xi) const
  {
    Surface<N> at{};
    const auto &mesh = properties.mesh;
    const double e   = properties.geometry.interface_offset;
    const double arm = e - properties.neutral_axis_offset;
    N w{}, w_slope{}, w_curvature{};
    if (mesh.elements > 0)
    {
      const double h = mesh.element_length();
      const HermiteShapes<N> of(h, 1. / h * xi - (window + first_of_element(window, value(xi)) / 2));
      for (unsigned int a = 0; a < n_nodal_of_element; ++a)
      {
        at.shape[a] = of.shape[a];
        at.slope[a] = of.slope[a];
        w           = w + nodal[a] * of.shape[a];
        w_slope     = w_slope + nodal[a] * of.slope[a];
        w_curvature = w_curvature + nodal[a] * of.curvature[a];
      }
    }
    at.xi         = xi - arm * w_slope;
    at.eta        = w + e;
    at.tangent[0] = 1. - arm * w_curvature;
    at.tangent[1] = w_slope;
    return at;
  }

  /// Newton's method for (p - c) . p' = 0 from the point across from the circle's centre.
  PointContact::Closest PointContact::closest(const unsigned int window, const Local &q) const
  {
    using N      = Dual<double, 1>;
    const auto c = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    Closest result{ c.xi, 1. };
    for (unsigned int i = 0; i < 20 && properties.mesh.elements > 0; ++i)
    {
      const auto *const nodal = &q[first_of_element(window, result.xi)];
      const auto at           = surface(window, nodal, variable<N>(result.xi, 0));
      const N slope           = (at.xi - c.xi) * at.tangent[0] + (at.eta - c.eta) * at.tangent[1];
      const double change     = slope.v / slope.d[0];
      result.d_slope          = slope.d[0];
      result.xi -= change;
      if (std::abs(change) < 1e-12 * properties.geometry.pivot_distance)
        break;
    }
    return result;
  }

  double PointContact::gap(const unsigned int window, const Local &q) const
  {
    const double xi = closest(window, q).xi;
    const auto at   = surface(window, &q[first_of_element(window, xi)], xi);
    const auto c    = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    return std::hypot(at.xi - c.xi, at.eta - c.eta) - properties.geometry.cylinder_radius;
  }

  PointContact::Configuration PointContact::configure(const unsigned int window, const Local &q) const
  {
    constexpr int n_used = n_nodal_of_element + 2; // coordinates of the element, theta, x
    using N              = Dual<double, n_used>;
    const auto foot      = closest(window, q);
    const auto first     = first_of_element(window, foot.xi);
    const auto circle    = placed_circle(properties.geometry, variable<N>(q[x_index], 5), variable<N>(q[theta_index], 4));
    Several<N, n_nodal_of_element> nodal;
    for (unsigned int a = 0; a < n_nodal_of_element; ++a)
      nodal[a] = variable<N>(q[first + a], a);

    // Another step of Newton's method tells how the closest point moves with the coordinates.
    const auto fixed = surface(window, nodal, N{} + foot.xi);
    const N slope    = (fixed.xi - circle.xi) * fixed.tangent[0] + (fixed.eta - circle.eta) * fixed.tangent[1];
    const auto at    = surface(window, nodal, N(foot.xi - 1. / foot.d_slope * slope));
    const auto point = on_circle(circle, at.xi, at.eta);
    const double arm = properties.geometry.interface_offset - properties.neutral_axis_offset;

    Configuration result;
    result.along       = at.xi.v;
    result.gap         = point.gap.v;
    const auto set_row = [&](const unsigned int i, const Several<N, 4> &at_point, Local &row, LocalMatrix &curvature)
    {
      const unsigned int index[n_used] = { first, first + 1, first + 2, first + 3, theta_index, x_index };
      const bool is_nodal              = i < n_nodal_of_element;
      const N of =
          is_nodal ? at.shape[i] * at_point[1] - arm * (at.slope[i] * at_point[0]) : at_point[i - n_nodal_of_element + 2];
      row[index[i]] = of.v;
      for (unsigned int j = 0; j < n_used; ++j)
        curvature[index[i]][index[j]] = of.d[j];
    };
    for (unsigned int i = properties.mesh.elements > 0 ? 0 : n_nodal_of_element; i < n_used; ++i)
    {
      set_row(i, point.gap_row, result.gap_row, result.gap_curvature);
      set_row(i, point.slip_row, result.slip_row, result.slip_curvature);
    }
    for (unsigned int i = 0; i < 4; ++i)
    {
      result.gap_at_point[i]  = point.gap_row[i].v;
      result.slip_at_point[i] = point.slip_row[i].v;
    }
    return result;
  }

  double PointContact::gap_change(const Evaluation &found, const Vector<double> &change_of_ports, unsigned int) const
  {
    return found.end.gap_row * rates(found.window, change_of_ports, 0.);
  }

  double PointContact::mean_slip(const Evaluation &found, const Vector<double> &from, const double from_x,
                                 const Vector<double> &to, const double to_x) const
  {
    const Local q_0 = coordinates(found.window, from, from_x);
    const Local q_1 = coordinates(found.window, to, to_x);
    return configure(found.window, 0.5 * (q_0 + q_1)).slip_row * (q_1 - q_0);
  }

  SurfaceShape PointContact::surface_shape(const Vector<double> &displacements, unsigned int) const
  {
    constexpr unsigned int parts = 8;
    const auto &mesh             = properties.mesh;
    const double arm             = properties.geometry.interface_offset - properties.neutral_axis_offset;
    SurfaceShape shape{ { 0. }, { 0. }, { 0. } };
    for (unsigned int i = 1; i <= parts * mesh.elements; ++i)
    {
      const unsigned int element = (i - 1) / parts;
      const HermiteShapes<double> of(mesh.element_length(), static_cast<double>(i) / parts - element);
      double w     = 0.;
      double slope = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        if (const unsigned int port = 2 * element + a; port >= 2)
        {
          w += of.shape[a] * displacements[port - 2];
          slope += of.slope[a] * displacements[port - 2];
        }
      shape.xi.push_back(i * mesh.element_length() / parts);
      shape.across.push_back(w);
      shape.along.push_back(-arm * slope);
    }
    return shape;
  }
} // namespace sprag
