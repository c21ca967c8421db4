// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "two_blocks.h"

using namespace sprag;

namespace
{
  const double modulus = 2.;
  const double height  = 2.;

  struct Outcome
  {
    FaceProfile face;
    Row row;
  };

  struct Elements
  {
    unsigned int degree;
    Enforcement enforcement;
    double penalty; ///< [N/mm^3]
    Solution solution = Solution::automatic;
  };

  /// In three steps to x = 0.1 mm.
  Outcome pressed(const dealii::Triangulation<2> &triangulation, LeverProperties properties, const Elements &elements)
  {
    const auto &[degree, enforcement, penalty, solution] = elements;
    const ElasticConstants elastic{ modulus, 0. };
    properties.solution                      = solution;
    properties.body.degree                   = degree;
    properties.body.width                    = 5.;
    properties.body.constants                = { { material_id::lever, elastic },
                                                 { material_id::layer, elastic },
                                                 { material_id::cylinder, elastic } };
    properties.contact.enforcement           = enforcement;
    properties.contact.penalty               = penalty;
    properties.contact.penetration_tolerance = 1e-10;
    StaticLever<2> model(triangulation, properties);
    Equilibrium at{ model.initial_state({ 0., 0., 1. }), {} };
    for (const double x : { 0.03, 0.06, 0.1 })
      at = step_to(model, at.state, x, properties.contact);
    Outcome outcome{ profile(model, at), {} };
    model.observe(at.state, at.found, outcome.row);
    EXPECT_EQ(outcome.face.pressure.size(), model.face_points().xi.size());
    return outcome;
  }

  /// Two blocks of half the height whose cells do not match, pressed together by 0.1 mm.
  Outcome pressed_together(const Elements &elements)
  {
    dealii::Triangulation<2> triangulation;
    make_two_blocks({ { 0., 0.35, 0.6, 1.3, 1.5, 2.4, 3. }, { 0., 0.4, 1. }, 0. },
                    { { 0., 0.5, 0.9, 1.4, 1.9, 3. }, { -1., -0.7, 0. }, 0. }, triangulation);
    return pressed(triangulation, two_block_properties(0.3), elements);
  }

  void expect_uniform(const Outcome &outcome, const double pressure)
  {
    for (const double p : outcome.face.pressure)
      EXPECT_NEAR(p, pressure, 1e-8);
    for (const double t : outcome.face.traction)
      EXPECT_NEAR(t, 0., 1e-8);
    EXPECT_NEAR(outcome.row[Column::P], pressure * 3. * 5., 1e-7);
    EXPECT_NEAR(outcome.row[Column::s], 1.5, 1e-7);
    EXPECT_NEAR(outcome.row[Column::contact_width], 3., 0.02);
  }
} // namespace

// A uniform state is among what the elements can represent: the pressure is E U / H = 0.1 MPa but for the penetration of 1e-10
// mm. By penalty, blocks and penalty are springs in series: U / (H / E + 1 / eps).
TEST(Patch, TwoElasticBlocksOfOtherCellsCarryAUniformPressure)
{
  for (const auto solution : { Solution::automatic, Solution::general })
    for (const unsigned int degree : { 1u, 2u })
    {
      for (const double penalty : { 20., 200. })
        expect_uniform(pressed_together({ degree, Enforcement::augmented_lagrangian, penalty, solution }), 0.1);
      for (const double penalty : { 2., 20., 2000. })
        expect_uniform(pressed_together({ degree, Enforcement::penalty, penalty, solution }),
                       0.1 / (height / modulus + 1. / penalty));
    }
}
