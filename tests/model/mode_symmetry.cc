// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/growth.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;

  /// Two levers with two surface dofs and a rotation each.
  InterfaceLayout two_levers()
  {
    InterfaceLayout layout;
    layout.surface = 2;
    layout.levers  = 2;
    return layout;
  }

  ComplexVector make_vector(const std::vector<Complex> &values)
  {
    ComplexVector result;
    for (auto &part : result)
      part.reinit(static_cast<unsigned int>(values.size()));
    for (unsigned int i = 0; i < values.size(); ++i)
    {
      result[0][i] = values[i].real();
      result[1][i] = values[i].imag();
    }
    return result;
  }

  std::vector<Complex> sum(const Complex a, const std::vector<Complex> &x, const Complex b, const std::vector<Complex> &y)
  {
    std::vector<Complex> result;
    for (std::size_t i = 0; i < x.size(); ++i)
      result.push_back(a * x[i] + b * y[i]);
    return result;
  }

  const std::vector<Complex> first_moves  = { { 1., 0.5 }, { -0.3, 2. }, 0.7, 0., 0., 0. };
  const std::vector<Complex> second_moves = { 0., 0., 0., { 1., 0.5 }, { -0.3, 2. }, 0.7 };

  struct Pair
  {
    std::vector<StructureMode> modes;
    std::vector<ComplexVector> displacements;
  };

  /// Coordinates are the dofs.
  Pair make_mode_pair(const std::vector<Complex> &a, const std::vector<Complex> &b, const Complex other_eigenvalue = { -1., 50. })
  {
    Pair result;
    for (const auto *const values : { &a, &b })
    {
      StructureMode mode;
      mode.eigenvalue  = values == &a ? Complex(-1., 50.) : other_eigenvalue;
      mode.coordinates = make_vector(*values);
      result.modes.push_back(mode);
      result.displacements.push_back(make_vector(*values));
    }
    return result;
  }
} // namespace

TEST(ModeSymmetry, IsOneOrMinusOneOfLeversThatMoveAlike)
{
  EXPECT_NEAR(symmetric_share(make_vector(sum(1., first_moves, 1., second_moves)), two_levers()), 1., 1e-15);
  EXPECT_NEAR(symmetric_share(make_vector(sum(1., first_moves, -1., second_moves)), two_levers()), -1., 1e-15);
  EXPECT_NEAR(symmetric_share(make_vector(first_moves), two_levers()), 0., 1e-15);
}

// Any two combinations of what two levers do alone are modes of one eigenvalue.
TEST(ModeSymmetry, TiedModesAreToldApartByIt)
{
  for (const Complex factor : { Complex(0., 0.), Complex(0.4, 0.), Complex(-0.2, 3.), Complex(1., 1e-9) })
  {
    auto pair =
        make_mode_pair(sum(1., first_moves, factor, second_moves), sum({ 0.3, 0.7 }, first_moves, { -2., 1. }, second_moves));
    separate_ties(pair.modes, pair.displacements, two_levers());
    EXPECT_NEAR(symmetric_share(pair.displacements[0], two_levers()), 1., 1e-12);
    EXPECT_NEAR(symmetric_share(pair.displacements[1], two_levers()), -1., 1e-12);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int part = 0; part < 2; ++part)
      {
        auto difference = pair.modes[k].coordinates[part];
        difference -= pair.displacements[k][part];
        EXPECT_LE(difference.linfty_norm(), 1e-14);
      }
  }
}

TEST(ModeSymmetry, ModesThatDoNotTieStayAsTheyAre)
{
  const auto a = sum(1., first_moves, 0.4, second_moves);
  const auto b = sum(0.3, first_moves, -2., second_moves);
  auto pair    = make_mode_pair(a, b, { -1., 50.001 });
  separate_ties(pair.modes, pair.displacements, two_levers());
  EXPECT_TRUE(pair.displacements[0][0] == make_vector(a)[0]);
  EXPECT_TRUE(pair.displacements[1][1] == make_vector(b)[1]);
}

TEST(ModeSymmetry, OneModeTwiceStaysAsItIs)
{
  auto pair = make_mode_pair(first_moves, sum({ 0., 2. }, first_moves, 0., second_moves));
  separate_ties(pair.modes, pair.displacements, two_levers());
  EXPECT_TRUE(pair.displacements[0][0] == make_vector(first_moves)[0]);
}
