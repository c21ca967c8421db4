#include "fe/solid/cylinder_axes.h"

namespace sprag
{
  namespace
  {
    /// A vector with its first and second derivatives by both slopes.
    struct Differentiated
    {
      using Vector = CylinderAxes::Vector;

      Vector value;
      std::array<Vector, 2> first;
      std::array<std::array<Vector, 2>, 2> second;
    };

    /// b = v/|v| of a v that is linear in the slopes: b_i = (v_i - b n_i)/n with n = |v|, n_i = b . v_i.
    Differentiated unit(const CylinderAxes::Vector &v, const std::array<CylinderAxes::Vector, 2> &derivatives)
    {
      const double n = v.norm();
      Differentiated b;
      b.value = v / n;
      for (unsigned int i = 0; i < 2; ++i)
        b.first[i] = (derivatives[i] - (b.value * derivatives[i]) * b.value) / n;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          b.second[i][j] = -((b.value * derivatives[i]) * b.first[j] + (b.value * derivatives[j]) * b.first[i] +
                             (b.first[j] * derivatives[i]) * b.value) /
                           n;
      return b;
    }

    Differentiated across(const Differentiated &a, const Differentiated &b)
    {
      Differentiated c;
      c.value = cross_product_3d(a.value, b.value);
      for (unsigned int i = 0; i < 2; ++i)
      {
        c.first[i] = cross_product_3d(a.first[i], b.value) + cross_product_3d(a.value, b.first[i]);
        for (unsigned int j = 0; j < 2; ++j)
          c.second[i][j] = cross_product_3d(a.second[i][j], b.value) + cross_product_3d(a.first[i], b.first[j]) +
                           cross_product_3d(a.first[j], b.first[i]) + cross_product_3d(a.value, b.second[i][j]);
      }
      return c;
    }
  } // namespace

  CylinderAxes::CylinderAxes(const AxisSlopes &slopes)
  {
    const auto &[tilt, skew] = slopes;
    const auto along         = unit(Vector({ skew, tilt, 1. }), { { Vector({ 0., 1., 0. }), Vector({ 1., 0., 0. }) } });
    const auto aside         = unit(Vector({ 1., 0., -skew }), { { Vector(), Vector({ 0., 0., -1. }) } });
    const auto towards       = across(along, aside);
    axis                     = along.value;
    right                    = aside.value;
    upward                   = towards.value;
    for (const auto *const b : { &along, &aside, &towards })
      for (unsigned int i = 0; i < 2; ++i)
      {
        turn[i] += outer_product(b->value, b->first[i]);
        for (unsigned int j = 0; j < 2; ++j)
          bend[i][j] += outer_product(b->value, b->second[i][j]);
      }
  }
} // namespace sprag
