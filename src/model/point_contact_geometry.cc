// SPDX-License-Identifier: GPL-3.0-only
#include "model/point_contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Cubic shapes of an element of length h at s h from its first node, 0 <= s <= 1, and their derivatives along it; for
    /// deflection and slope of the first node, then of the second.
    struct HermiteShapes
    {
      HermiteShapes(const double h, const double s)
          : shape{ 1. - s * s * (3. - 2. * s), h * s * (1. - s) * (1. - s), s * s * (3. - 2. * s), -h * s * s * (1. - s) }
          , slope{ 6. * s * (s - 1.) / h, 1. + s * (3. * s - 4.), 6. * s * (1. - s) / h, s * (3. * s - 2.) }
          , curvature{ (12. * s - 6.) / (h * h), (6. * s - 4.) / h, (6. - 12. * s) / (h * h), (6. * s - 2.) / h }
          , third{ 12. / (h * h * h), 6. / (h * h), -12. / (h * h * h), 6. / (h * h) }
      {
      }

      double shape[4], slope[4], curvature[4], third[4];
    };
  } // namespace

  struct PointContact::Surface
  {
    unsigned int nodal; ///< first local coordinate of the element
    double shape[4];    ///< deflection by them, and its derivatives along the lever
    double slope[4];
    double curvature[4];
    LeverPoint point;
    double tangent[2]; ///< d(point)/dxi
    double bend[2];    ///< d2(point)/dxi2
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

  PointContact::Surface PointContact::surface(const unsigned int window, const Local &q, const double xi) const
  {
    Surface result{};
    const auto &mesh = properties.mesh;
    const double e   = properties.geometry.interface_offset;
    const double arm = e - properties.neutral_axis_offset;
    double w[4]      = { 0., 0., 0., 0. };
    if (mesh.elements > 0)
    {
      const double h          = mesh.element_length();
      const bool second       = xi >= (window + 1) * h;
      const double s          = xi / h - window - (second ? 1. : 0.);
      const unsigned int base = second ? 2 : 0;
      result.nodal            = base;
      const HermiteShapes of(h, s);
      for (unsigned int a = 0; a < 4; ++a)
      {
        const double value  = q[base + a];
        result.shape[a]     = of.shape[a];
        result.slope[a]     = of.slope[a];
        result.curvature[a] = of.curvature[a];
        w[0] += of.shape[a] * value;
        w[1] += of.slope[a] * value;
        w[2] += of.curvature[a] * value;
        w[3] += of.third[a] * value;
      }
    }
    result.point      = { xi - arm * w[1], e + w[0] };
    result.tangent[0] = 1. - arm * w[2];
    result.tangent[1] = w[1];
    result.bend[0]    = -arm * w[3];
    result.bend[1]    = w[2];
    return result;
  }

  /// Newton's method for (p - c) . p' = 0 from the point across from the circle's centre.
  double PointContact::closest(const unsigned int window, const Local &q) const
  {
    const auto c = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    double xi    = c.xi;
    for (unsigned int i = 0; i < 20 && properties.mesh.elements > 0; ++i)
    {
      const auto at      = surface(window, q, xi);
      const double r[2]  = { at.point.xi - c.xi, at.point.eta - c.eta };
      const double slope = r[0] * at.tangent[0] + r[1] * at.tangent[1];
      const double d_slope =
          at.tangent[0] * at.tangent[0] + at.tangent[1] * at.tangent[1] + r[0] * at.bend[0] + r[1] * at.bend[1];
      const double change = slope / d_slope;
      xi -= change;
      if (std::abs(change) < 1e-12 * properties.geometry.pivot_distance)
        break;
    }
    return xi;
  }

  double PointContact::gap(const unsigned int window, const Local &q) const
  {
    const auto c     = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    const auto point = surface(window, q, closest(window, q)).point;
    return std::hypot(point.xi - c.xi, point.eta - c.eta) - properties.geometry.cylinder_radius;
  }

  PointContact::Configuration PointContact::configure(const unsigned int window, const Local &q) const
  {
    const double xi   = closest(window, q);
    const auto at     = surface(window, q, xi);
    const auto circle = moving_circle_contact(properties.geometry, at.point, q[x_index], q[theta_index]);
    const double arm  = properties.geometry.interface_offset - properties.neutral_axis_offset;

    // How the local coordinates move the material point, and how that changes along the lever.
    constexpr unsigned int n_used = 6;
    unsigned int index[n_used];
    Tensor<1, 4> move[n_used];
    Tensor<1, 4> change[n_used];
    unsigned int used = 0;
    if (properties.mesh.elements > 0)
      for (unsigned int a = 0; a < 4; ++a, ++used)
      {
        index[used]  = at.nodal + a;
        move[used]   = Tensor<1, 4>({ -arm * at.slope[a], at.shape[a], 0., 0. });
        change[used] = Tensor<1, 4>({ -arm * at.curvature[a], at.slope[a], 0., 0. });
      }
    index[used]  = theta_index;
    move[used++] = Tensor<1, 4>({ 0., 0., 1., 0. });
    index[used]  = x_index;
    move[used++] = Tensor<1, 4>({ 0., 0., 0., 1. });

    const Tensor<1, 4> tangent({ at.tangent[0], at.tangent[1], 0., 0. });
    const Tensor<1, 4> bend({ at.bend[0], at.bend[1], 0., 0. });
    const Tensor<1, 4> gap_along  = circle.gap_curvature * tangent;
    const Tensor<1, 4> slip_along = circle.slip_curvature * tangent;
    const double stiffness        = tangent * gap_along + circle.gap_row * bend;
    double gap_shift[n_used];
    double slip_shift[n_used];
    for (unsigned int i = 0; i < used; ++i)
    {
      gap_shift[i]  = change[i] * circle.gap_row + move[i] * gap_along;
      slip_shift[i] = change[i] * circle.slip_row + move[i] * slip_along;
    }

    Configuration result;
    result.along         = at.point.xi;
    result.gap           = circle.gap;
    result.gap_at_point  = circle.gap_row;
    result.slip_at_point = circle.slip_row;
    for (unsigned int i = 0; i < used; ++i)
    {
      result.gap_row[index[i]]   = move[i] * circle.gap_row;
      result.slip_row[index[i]]  = move[i] * circle.slip_row;
      const Tensor<1, 4> of_gap  = circle.gap_curvature * move[i];
      const Tensor<1, 4> of_slip = circle.slip_curvature * move[i];
      for (unsigned int j = 0; j < used; ++j)
      {
        result.gap_curvature[index[i]][index[j]]  = of_gap * move[j] - gap_shift[i] * gap_shift[j] / stiffness;
        result.slip_curvature[index[i]][index[j]] = of_slip * move[j] - slip_shift[i] * gap_shift[j] / stiffness;
      }
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
      const HermiteShapes of(mesh.element_length(), static_cast<double>(i) / parts - element);
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
