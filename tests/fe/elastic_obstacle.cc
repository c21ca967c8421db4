#include "fe/contact/face_contact.h"

#include "bar_on_elastic_cylinder.h"
#include "base/errors.h"
#include "mpi_environment.h"
#include "support/port_differences.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  /// Displacements of some 0.0002 mm, different at neighbouring nodes, and a small turn; the lever moved down by `depth`.
  Vector pressed(const ElasticBody<2> &body, const PortLayout &layout, const double depth, const double phase)
  {
    Vector ports(layout.size());
    const auto n_lever = static_cast<unsigned int>(body.friction_face().nodes.size());
    for (unsigned int i = 0; i < layout.surface; ++i)
      ports[i] = 2e-4 * std::sin(1.7 * i + phase) - (i % 2 == 1 && i < 2 * n_lever ? depth : 0.);
    ports[layout.rotation()] = 2e-5 * std::sin(phase);
    if (layout.sprung)
      ports[layout.support()] = 1e-3 * std::cos(phase);
    return ports;
  }

  /// A step of 1e-4 s from sliding at x = 1 mm to `x`, in which all displacements change by up to 0.0001 mm times `size`.
  class Step
  {
  public:
    Step(FaceContact &contact, const ElasticBody<2> &body, const PortLayout &layout, const double x, const double size = 1.)
        : weights(generalised_alpha(0.8, 1e-4))
        , to{ 1e-4, x, (x - 1.) / 1e-4, 0., 0.002 * size }
    {
      accepted.drive = { 0., 1., 100. };
      begin.position = pressed(body, layout, 0.01 - rest_inclination, 0.3);
      end            = pressed(body, layout, 0.01 - rest_inclination * x, 0.3 + 0.5 * size);
      contact.evaluate_sliding({ begin.position, accepted.drive, 100. });
      accepted.contact = contact.memory();
    }

    PortStep operator*() const
    {
      return { accepted.drive, accepted.contact, to, begin, end, rate, weights };
    }

    StepWeights weights;
    DrivePoint to;
    Motion accepted;
    Kinematic begin;
    Vector end;
    Vector rate;
  };
} // namespace

// Covariance of stretch and slip within a facet, some 1e-3 of 1e-3, is not in the tangent.
TEST(ElasticObstacle, TangentIsTheDerivativeOfTheForces)
{
  const MeshedPair bodies;
  for (const bool sprung : { false, true })
    for (const double regularisation : { 0., 20. })
      // Sliding on, sticking, sliding back.
      for (const double x : { 1.01, 1.0003, 0.99 })
      {
        const auto properties = pair_properties_of(*bodies, sprung, regularisation);
        FaceContact contact(*bodies, properties);
        Step step(contact, *bodies, properties.ports, x);
        EXPECT_LE(tangent_error(contact, step.end, [&] { contact.evaluate(*step); }), 1e-5) << sprung << " " << x;
        EXPECT_GT(contact.forces().ports.size(), 20u);
      }
}

// Where the cylinder's edges meet, what their kink times the gap moves is left out: 1e-9 of the tangent.
TEST(ElasticObstacle, PartsAddUpToTheTangentAndPressureIsSymmetric)
{
  const MeshedPair bodies;
  const auto properties = pair_properties_of(*bodies, true, 0.);
  FaceContact contact(*bodies, properties);
  expect_parts_of_tangent(contact, pressed(*bodies, properties.ports, 0.01, 0.3), 1e-8);
}

TEST(ElasticObstacle, TangentOfSteadySlidingIsTheDerivativeOfTheForces)
{
  const MeshedPair bodies;
  for (const bool sprung : { false, true })
    for (const double speed : { 100., -100. })
    {
      const auto properties = pair_properties_of(*bodies, sprung, 0.);
      FaceContact contact(*bodies, properties);
      const Step step(contact, *bodies, properties.ports, 1.01);
      Vector ports = step.end;
      EXPECT_LE(tangent_error(contact, ports, [&] { contact.evaluate_sliding({ ports, step.to, speed }); }), 1e-5) << speed;
    }
}

// What the ports, the drive and the turn of the cylinder do is stored or dissipated, up to third order in the movement of a step.
TEST(ElasticObstacle, WorksBalance)
{
  const MeshedPair bodies;
  double last = 0.;
  for (const double share : { 1., 0.5 })
  {
    const auto properties = pair_properties_of(*bodies, true, 0.);
    FaceContact contact(*bodies, properties);
    const Step step(contact, *bodies, properties.ports, 1. + 0.05 * share, share);
    const double before = contact.energy();
    contact.evaluate(*step);
    StepWork work;
    contact.add_work(work);
    const double of_ports = work_of(contact.forces(), step.begin.position, step.end);
    const double left     = work.drive - of_ports - (contact.energy() - before) - work.friction - work.algorithmic;
    EXPECT_GT(work.friction, 0.);
    EXPECT_LE(std::abs(left), 1e-3 * share * share * work.friction);
    if (share < 1.)
    {
      EXPECT_LE(std::abs(left), 0.25 * last);
    }
    last = std::abs(left);
  }
}

TEST(ElasticObstacle, ForcesOnLeverAndCylinderAreEqualAndOpposite)
{
  const MeshedPair bodies;
  const auto properties = pair_properties_of(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  const Step step(contact, *bodies, properties.ports, 1.01);
  contact.evaluate(*step);
  const auto n_lever = 2 * static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  dealii::Tensor<1, 2> on_lever, on_cylinder;
  for (unsigned int a = 0; a + 1 < contact.forces().ports.size(); ++a)
  {
    const unsigned int port = contact.forces().ports[a];
    (port < n_lever ? on_lever : on_cylinder)[port % 2] += contact.forces().values[a];
  }
  EXPECT_GT(on_lever[1], 1.);
  EXPECT_NEAR((on_lever + on_cylinder).norm(), 0., 1e-12 * on_lever.norm());
}

// Facets of 0.025 mm average where the circle's points sample: the force differs where the contact ends, by a facet's share of a
// half width of some 0.35 mm, squared.
TEST(ElasticObstacle, AnUndeformedCylinderIsARigidOne)
{
  const MeshedPair bodies;
  const auto properties = pair_properties_of(*bodies, false, 0.);
  const MeshedBar bar(bar_on_cylinder());
  const auto rigid_properties = properties_of(*bar, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceContact rigid(*bar, rigid_properties);
  for (const double speed : { 100., -100. })
  {
    Vector ports(properties.ports.size()), of_rigid(rigid_properties.ports.size());
    for (unsigned int i = 0; i < rigid_properties.ports.surface; ++i)
      ports[i] = of_rigid[i] = i % 2 == 1 ? -0.01 : 0.;
    const DrivePoint drive{ 0., 0., speed };
    contact.evaluate_sliding({ ports, drive, speed });
    rigid.evaluate_sliding({ of_rigid, drive, speed });
    Row row, of_circle;
    contact.observe(row);
    rigid.observe(of_circle);
    for (const auto column : { Column::P, Column::F, Column::Q, Column::normal_resultant, Column::friction_resultant })
      EXPECT_NEAR(row[column], of_circle[column], 5e-3 * of_circle[Column::P]) << speed;
    EXPECT_NEAR(row[Column::F] / row[Column::P], of_circle[Column::F] / of_circle[Column::P], 1e-4);
    EXPECT_NEAR(row[Column::s], of_circle[Column::s], 1e-3);
    EXPECT_NEAR(contact.energy(), rigid.energy(), 1e-2 * rigid.energy());
    const double h = 1e-4;
    EXPECT_NEAR(contact.mean_slip(ports, 0., ports, h), rigid.mean_slip(of_rigid, 0., of_rigid, h), 5e-5 * h);
    Vector change(ports.size()), of_lever(of_rigid.size());
    change[properties.ports.rotation()] = of_lever[rigid_properties.ports.rotation()] = 1e-6;
    EXPECT_NEAR(contact.gap_change(change), rigid.gap_change(of_lever), 1e-8);
  }
}

TEST(ElasticObstacle, ApartNothingHappens)
{
  const MeshedPair bodies;
  const auto properties = pair_properties_of(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  Vector ports(properties.ports.size());
  ports[properties.ports.rotation()] = 0.02;
  EXPECT_TRUE(contact.touch(ports, { 0., 0., 0. }).empty());
  EXPECT_TRUE(contact.forces().ports.empty());
  Vector change(ports.size());
  change[properties.ports.rotation()] = 1e-6;
  EXPECT_NEAR(contact.gap_change(change), 12e-6, 1e-6);
}

TEST(ElasticObstacle, RefusesAContactBeyondTheCylindersFace)
{
  const MeshedPair bodies;
  const auto properties = pair_properties_of(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  Vector ports(properties.ports.size());
  const auto n_lever = static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  for (unsigned int i = 0; i < n_lever; ++i)
    ports[2 * i + 1] = -0.3;
  contact.evaluate_sliding({ ports, { 0., 0., 100. }, 100. });
  EXPECT_THROW(contact.memory(), AnalysisError);
}
