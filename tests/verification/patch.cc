#include "mpi_environment.h"
#include "pressed_block.h"

using namespace sprag;

namespace
{
  const double modulus = 2.;
  const double height  = 2.;

  /// Two materials of the same constants on a face of unequal cells.
  void make_patch(dealii::Triangulation<2> &triangulation)
  {
    make_block({ 0., 0.35, 0.6, 1.3, 1.5, 2.4, 3. }, { 0., 0.4, 1., height }, triangulation);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->center()[1] < 1.)
        cell->set_material_id(material_id::layer);
  }

  struct Outcome
  {
    FaceProfile face;
    Row row;
  };

  /// Pressed by 0.1 mm in three steps.
  Outcome pressed(const unsigned int degree, const Enforcement enforcement, const double penalty)
  {
    dealii::Triangulation<2> triangulation;
    make_patch(triangulation);
    auto properties           = block_properties(rigid_plane([](double x) { return 0.1 * x; }, [](double) { return 0.; }), 0.3);
    properties.body.degree    = degree;
    properties.body.width     = 5.;
    properties.body.constants = { { material_id::lever, { modulus, 0. } }, { material_id::layer, { modulus, 0. } } };
    properties.contact.enforcement           = enforcement;
    properties.contact.penalty               = penalty;
    properties.contact.penetration_tolerance = 1e-10;
    LeverModel model(triangulation, properties);
    State state = model.initial_state({ 0., 0., 1. });
    for (const double x : { 0.3, 0.6, 1. })
      state = step_to(model, state, x, properties.contact);
    Outcome outcome{ profile(model, state), {} };
    model.observe(state, outcome.row);
    EXPECT_EQ(outcome.face.pressure.size(), model.face_points().xi.size());
    return outcome;
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

// A uniform state is among what the elements can represent: the pressure is E U / H = 0.1 MPa but for the overlap of 1e-10 mm.
TEST(Patch, AugmentedLagrangianCarriesAUniformPressure)
{
  for (const unsigned int degree : { 1u, 2u })
    for (const double penalty : { 20., 200. })
      expect_uniform(pressed(degree, Enforcement::augmented_lagrangian, penalty), 0.1);
}

// Block and penalty are springs in series: U / (H / E + 1 / eps).
TEST(Patch, PenaltyCarriesTheUniformPressureOfSpringsInSeries)
{
  for (const unsigned int degree : { 1u, 2u })
    for (const double penalty : { 2., 20., 2000. })
      expect_uniform(pressed(degree, Enforcement::penalty, penalty), 0.1 / (height / modulus + 1. / penalty));
}
