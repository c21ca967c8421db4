// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "pressed_block.h"

#include <cstdio>
#include <tuple>

using namespace sprag;

namespace
{
  const double modulus = 20.;

  struct Layer
  {
    MaterialModel material;
    unsigned int degree;
    double poisson_ratio;
    double penalty; ///< [N/mm^3]
  };

  /// A layer of 1 mm on a rigid base under a circle that is pressed in by `depth`, without friction.
  PressedBlock indented(const dealii::Triangulation<2> &triangulation, const Layer &layer, const double radius,
                        const double depth)
  {
    auto properties               = block_properties(radius, 0.);
    properties.body.degree        = layer.degree;
    properties.body.material      = layer.material;
    properties.body.point_spacing = 0.01;
    properties.body.constants     = { { material_id::lever, { modulus, layer.poisson_ratio } } };
    properties.contact.penalty    = layer.penalty;
    return pressed(triangulation, properties, depth);
  }
} // namespace

// A layer bonded to a rigid base under P R / (E t^2) = 1: half-width and largest pressure R p / (E t) of bonded_layer.py, whose
// indentation is prescribed here. Cells of 0.05 mm under the contact: of the one at the edge p may end half a cell, and a point,
// too early or late. The face moves aside by some delta a / t, so that it meets the circle higher up: a^2 / (R t) = 1 % of delta,
// less of P. The penetration is 0.1 % of the indentation at degree 2 and 0.3 % at degree 1, P grows with its square. Between
// nodes the circle stands out of chords by h^2 / 8R, see hertz.cc. Strains of 0.01 change P at finite strain by as much.
TEST(IncompressibleLayer, MeetsTheExactLayerOnARigidBase)
{
  const double radius = 56.;
  dealii::Triangulation<2> triangulation;
  make_block(mirrored(graded_parts(0.05, 1., 1.3, 8.)), equal_parts(0., 1., 10), triangulation);
  struct Exact
  {
    double poisson_ratio, half_width, indentation, pressure;
  };
  const Exact compressible{ 0.49, 0.7866, 0.31533, 0.8330 }, almost_not{ 0.4999, 0.7808, 0.29793, 0.8411 };
  for (const auto &[exact, material, degree, allowed] :
       { std::tuple{ almost_not, MaterialModel::linear, 1u, 0.02 }, std::tuple{ compressible, MaterialModel::linear, 2u, 0.01 },
         std::tuple{ almost_not, MaterialModel::linear, 2u, 0.01 },
         std::tuple{ almost_not, MaterialModel::neo_hookean, 2u, 0.03 } })
  {
    const Layer layer{ material, degree, exact.poisson_ratio, degree == 1 ? 2e4 : 1e5 };
    const auto outcome = indented(triangulation, layer, radius, exact.indentation / radius);
    const double load = outcome.load * radius / modulus, pressure = outcome.largest_pressure() * radius / modulus;
    std::printf("nu %g, degree %u: load %.4f, a %.4f, p %.4f\n", exact.poisson_ratio, degree, load, outcome.half_width, pressure);
    EXPECT_NEAR(load, 1., allowed);
    const double ripple = degree == 1 ? layer.penalty * 0.05 * 0.05 / (8. * radius) * radius / modulus : 0.;
    EXPECT_NEAR(outcome.half_width, exact.half_width, 0.035);
    EXPECT_NEAR(pressure, exact.pressure, allowed * exact.pressure + ripple);
  }
}

// Thin-layer theory of the incompressible bonded layer (Johnson, Contact Mechanics, 5.8): the material is squeezed out sideways,
// delta - x^2 / 2R = -(t^3 / E) p'', so that p = E / (24 R t^3) (a^2 - x^2)^2, delta = a^2 / 6R. Here a = 10 t. The theory lets p
// end smoothly where the true one ends steeply within about t: by bonded_layer.py's kernels half-width and P are 0.80 and 1.41 (a
// = 5 t), 0.88 and 1.11 (10 t), 0.93 and 1.02 (20 t) of the theory's. As above, 2 % of delta are lost as the face moves aside and
// 1 % to the penalty, and P grows with delta^(5/2). Cells of degree 1 carry the parabola of what flows out by chords: (h/t)^2
// = 1.6 % of P too much at eight of them.
TEST(IncompressibleLayer, ThinLayerIsSqueezedOutSideways)
{
  const double radius = 5000., a = 10., thickness = 1.;
  dealii::Triangulation<2> triangulation;
  make_block(mirrored(graded_parts(0.25, 12., 1.3, 20.)), equal_parts(0., thickness, 8), triangulation);
  const double pressure = modulus / (24. * radius * std::pow(thickness, 3)) * std::pow(a, 4);
  const double load     = 16. / 15. * pressure * a;
  for (const unsigned int degree : { 1u, 2u })
  {
    const Layer layer{ MaterialModel::linear, degree, 0.49999, 5e4 };
    const auto outcome = indented(triangulation, layer, radius, a * a / (6. * radius));
    std::printf("degree %u: load %.4f, a %.4f, p %.4f of the theory\n", degree, outcome.load / load, outcome.half_width / a,
                outcome.largest_pressure() / pressure);
    EXPECT_NEAR(outcome.load, 1.11 * load, 0.08 * load);
    EXPECT_NEAR(outcome.half_width, 0.88 * a, 0.02 * a);
    double worst = 0.;
    for (std::size_t q = 0; q < outcome.face.xi.size(); ++q)
    {
      const double x = outcome.face.xi[q] / a;
      worst          = std::max(worst, std::abs(outcome.face.pressure[q] / pressure - std::pow(std::max(0., 1. - x * x), 2)));
    }
    std::printf("profile off by %.4f\n", worst);
    EXPECT_LE(worst, 0.13);
  }
}
