#include "fe/contact/face_contact.h"

#include "bar_on_cylinder.h"
#include "mpi_environment.h"
#include "support/port_differences.h"
#include "support/random_vector.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  Vector random_ports(const PortLayout &ports, const unsigned int seed)
  {
    Vector result = random_vector(ports.size(), 1e-3, seed);
    result[ports.rotation()] *= 0.02;
    return result;
  }

  /// A step from sliding at 1 mm to `x` in 1e-4 s, everything random but the cylinder pressed in by some 0.01 mm.
  class Step
  {
  public:
    Step(FaceContact &contact, const PortLayout &ports, const double x, const double size = 1.,
         const double spectral_radius = 0.8)
        : weights(generalised_alpha(spectral_radius, 1e-4))
        , to{ 1e-4, x, (x - 1.) / 1e-4 }
    {
      accepted.drive = { 0., 1., 100. };
      begin.position = pressed(random_ports(ports, 1), ports, 1.);
      end            = random_ports(ports, 2);
      end -= random_ports(ports, 1);
      end *= size;
      end += pressed(random_ports(ports, 1), ports, x);
      contact.evaluate_sliding({ begin.position, accepted.drive, 100. });
      accepted.contact = contact.memory();
    }

    PortStep operator*() const
    {
      return { accepted.drive, accepted.contact, to, begin, end, rate, weights };
    }

  private:
    /// The face moves down by what the circle goes out of its way.
    static Vector pressed(Vector ports, const PortLayout &layout, const double x)
    {
      for (unsigned int i = 1; i < layout.surface; i += 2)
        ports[i] -= 0.01 - rest_inclination * x;
      return ports;
    }

  public:
    StepWeights weights;
    DrivePoint to;
    Motion accepted;
    Kinematic begin;
    Vector end;
    Vector rate;
  };
} // namespace

// Points are 0.05 mm apart and the overlap falls to 0 at a slope of some 0.05: of the points one in some 1e4 changes state by
// 1e-7 mm, so that a difference is that of a smooth function.
TEST(FaceContact, TangentIsTheDerivativeOfTheForces)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
    for (const double regularisation : { 0., 20. })
      // Sliding on, sticking, sliding back.
      for (const double x : { 1.01, 1.0003, 0.99 })
      {
        const auto properties = properties_of(*bar, sprung, regularisation);
        FaceContact contact(*bar, properties);
        Step step(contact, properties.ports, x);
        EXPECT_LE(tangent_error(contact, step.end, [&] { contact.evaluate(*step); }), 1e-6) << sprung << " " << x;
        EXPECT_FALSE(contact.forces().ports.empty());
      }
}

TEST(FaceContact, TangentOfSteadySlidingIsTheDerivativeOfTheForces)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
    for (const double speed : { 100., -100. })
    {
      const auto properties = properties_of(*bar, sprung, 0.);
      FaceContact contact(*bar, properties);
      const Step step(contact, properties.ports, 1.01);
      Vector ports = step.end;
      EXPECT_LE(tangent_error(contact, ports, [&] { contact.evaluate_sliding({ ports, step.to, speed }); }), 1e-6) << speed;
    }
}

// What the ports and the drive do is stored or dissipated, up to third order in the movement of a step.
// With a spectral radius of 0 forces are balanced where the step ends, but are not those of a step without inertia.
TEST(FaceContact, WorksBalance)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const double spectral_radius : { 0.8, 0. })
  {
    double last = 0.;
    for (const double share : { 1., 0.5 })
    {
      const auto properties = properties_of(*bar, true, 0.);
      FaceContact contact(*bar, properties);
      const Step step(contact, properties.ports, 1. + 0.05 * share, share, spectral_radius);
      const double before = contact.energy();
      contact.evaluate(*step);
      StepWork work;
      contact.add_work(work);
      const double of_ports = work_of(contact.forces(), step.begin.position, step.end);
      const double left     = work.drive - of_ports - (contact.energy() - before) - work.friction - work.algorithmic;
      EXPECT_GT(work.friction, 0.);
      EXPECT_LE(std::abs(left), 1e-3 * share * share * work.friction) << spectral_radius;
      if (share < 1.)
      {
        EXPECT_LE(std::abs(left), 0.2 * last) << spectral_radius;
      }
      last = std::abs(left);
    }
  }
}

TEST(FaceContact, FindsAllPointsInReach)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = properties_of(*bar, false, 0.);
  const FacePatches face((*bar).friction_face());
  const double R = cylinder_below_bar().cylinder_radius;
  for (const double x : { -6., -3., 0., 3., 6. })
    for (const double turn : { 0., -0.01, -0.1, 0.2 })
    {
      const double theta = rest_inclination + turn;
      const auto ports   = random_ports(properties.ports, 3);
      const FaceConfiguration at{ &ports, theta, x, cylinder_centre(cylinder_below_bar(), x, theta) };
      RigidObstacle obstacle(face, properties);
      obstacle.enter({ at, at });
      const auto range = obstacle.near();
      ASSERT_LT(range.begin, range.end);
      double inside  = 1e9;
      double outside = 1e9;
      for (unsigned int p = 0; p < face.patches().size(); ++p)
        for (unsigned int q = face.patches()[p].begin; q < face.patches()[p].end; ++q)
        {
          const auto position = FacePatches::position(face.points()[q], FacePatches::nodal(face.patches()[p], ports));
          const double gap    = std::hypot(position.xi - at.centre.xi, position.eta - at.centre.eta) - R;
          double &least       = p >= range.begin && p < range.end ? inside : outside;
          least               = std::min(least, gap);
        }
      EXPECT_GT(outside, 0.) << x << " " << turn;
      EXPECT_LE(inside, outside + 0.02 * face.patches().front().length) << x << " " << turn;
    }
}

TEST(FaceContact, ForcesOfSlidingAreThoseObserved)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = properties_of(*bar, false, 0.);
  FaceContact contact(*bar, properties);
  const Step step(contact, properties.ports, 1.01);
  contact.evaluate_sliding({ step.end, step.to, 100. });
  Row row;
  contact.observe(row);
  double P = 0., F = 0.;
  for (unsigned int a = 0; a + 1 < contact.forces().ports.size(); ++a)
    (contact.forces().ports[a] % 2 == 0 ? F : P) += contact.forces().values[a];
  EXPECT_NEAR(row[Column::P], P, 1e-12 * P);
  EXPECT_NEAR(row[Column::F], -F, 1e-12 * P);
  const double theta = rest_inclination + step.end[properties.ports.rotation()];
  EXPECT_NEAR(row[Column::Q], P * std::sin(theta) - F * std::cos(theta), 1e-12 * P);
  const double mu = friction_coefficient(properties.friction, 100.).coefficient;
  EXPECT_NEAR(row[Column::friction_resultant], mu * row[Column::normal_resultant], 1e-12 * P);
  EXPECT_DOUBLE_EQ(row[Column::v_rel], 100.);
}

TEST(FaceContact, ApartNothingHappens)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = properties_of(*bar, false, 0.);
  FaceContact contact(*bar, properties);
  Vector ports(properties.ports.size());
  ports[properties.ports.rotation()] = 0.02;
  EXPECT_TRUE(contact.touch(ports, { 0., 0., 0. }).empty());
  EXPECT_TRUE(contact.forces().ports.empty());
  EXPECT_EQ(contact.energy(), 0.);
  Row row;
  contact.observe(row);
  EXPECT_EQ(row[Column::P], 0.);
  EXPECT_EQ(row[Column::Q], 0.);
  EXPECT_EQ(row[Column::contact_width], 0.);
  // Turned further the gap grows by the arm, some 12 mm.
  Vector change(ports.size());
  change[properties.ports.rotation()] = 1e-6;
  EXPECT_NEAR(contact.gap_change(change), 12e-6, 1e-6);
}

// A drive that moves the cylinder along the face by dx slips it by dx cos theta.
TEST(FaceContact, TellsTheMeanSlip)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = properties_of(*bar, false, 0.);
  FaceContact contact(*bar, properties);
  const Step step(contact, properties.ports, 1.01);
  const auto &ports = step.begin.position;
  EXPECT_NEAR(contact.mean_slip(ports, 1., ports, 1. + 1e-4), 1e-4 * std::cos(rest_inclination), 1e-6);
}
