// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/point_contact.h"
#include "model/structure/beam.h"
#include "model/structure/frame_coupling.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
  using Full   = dealii::FullMatrix<double>;

  const Geometry geometry      = { 56., 45.6, 185.5, 0. };
  constexpr double length      = 210.;
  constexpr double place       = 44.3; ///< of the cylinder [mm]
  constexpr double penetration = 0.012;

  /// A slide of a lever that is bent, and on a sprung support.
  struct Slide
  {
    std::string name;
    PointContactProperties contact;
    double direction = 1.;

    DrivePoint drive() const
    {
      return { 0., place, direction * 112., 0. };
    }

    double speed() const
    {
      return direction * 108.;
    }

    /// Returns the movement of the contact by a unit of the dof [mm].
    double arm(const unsigned int dof) const
    {
      if (dof == contact.layout.rotation())
        return 120.;
      return dof < contact.layout.surface && dof % 2 == 1 ? length / 8. : 1.;
    }

    /// Displacements at which the contact has the penetration, which may be negative.
    Vector position(const double target_gap) const
    {
      Vector z(contact.layout.size());
      for (unsigned int i = 0; i < contact.layout.surface; i += 2)
      {
        const double xi = (i / 2 + 1) / 8.;
        z[i]            = 4e-3 * xi * xi - 3e-3 * std::sin(3. * xi);
        z[i + 1]        = (8e-3 * xi - 9e-3 * std::cos(3. * xi)) / length;
      }
      if (contact.layout.sprung)
        z[contact.layout.support()] = 0.02;
      PointContact point(contact);
      PointContact::Evaluation found;
      Vector turn(z.size());
      turn[contact.layout.rotation()] = 1.;
      z[contact.layout.rotation()]    = kinematics(geometry, place).theta - contact.rest_inclination - 1e-3;
      const double closed             = std::abs(target_gap);
      for (unsigned int i = 0; i < 8; ++i)
      {
        point.touch(z, drive(), found);
        z[contact.layout.rotation()] += (found.penetration() - closed) / point.gap_change(found, turn);
      }
      z[contact.layout.rotation()] += (closed - target_gap) / point.gap_change(found, turn);
      return z;
    }
  };

  struct NamedFriction
  {
    std::string name;
    FrictionLaw law;
  };

  /// Every lever, support, neutral axis, friction and direction.
  std::vector<Slide> slides(const double damping)
  {
    const NamedFriction frictions[] = { { "Coulomb", { CoulombFriction{ 0.73 }, FrictionSpeed::sliding } },
                                        { "cork", { CorkOnAluminium{}, FrictionSpeed::sliding } },
                                        { "regularised", { CorkOnAluminium{}, FrictionSpeed::sliding, 50. } } };
    std::vector<Slide> result;
    for (const unsigned int elements : { 0u, 8u })
      for (const bool sprung : { false, true })
        for (const double axis : { geometry.interface_offset, 56.6, 0. })
          for (const auto &friction : frictions)
            for (const double direction : { 1., -1. })
            {
              Slide slide;
              auto &contact               = slide.contact;
              contact.geometry            = geometry;
              contact.mesh                = { elements, length };
              contact.layout              = { contact.mesh.n_dofs(), sprung };
              contact.rest_inclination    = kinematics(geometry, 0.).theta;
              contact.neutral_axis_offset = axis;
              contact.normal              = { 10451., 1.4726 };
              contact.damping             = damping;
              contact.tangential          = 1000.;
              contact.friction            = friction.law;
              slide.direction             = direction;
              slide.name = std::to_string(elements) + " elements, " + (sprung ? "sprung, e_a " : "e_a ") + std::to_string(axis) +
                           ", " + friction.name + (direction > 0. ? ", forward" : ", backward");
              result.push_back(slide);
            }
    return result;
  }

  InterfaceForces forces(const Slide &slide, const Vector &displacements, const Vector *rates = nullptr,
                         const ContactFriction friction = ContactFriction::sliding)
  {
    PointContact contact(slide.contact);
    PointContact::Evaluation found;
    contact.evaluate_sliding({ displacements, slide.drive(), slide.speed(), rates, friction }, found);
    return found.forces;
  }

  LinearisedForces linearised(const Slide &slide, const Vector &displacements,
                              const ContactFriction friction = ContactFriction::sliding)
  {
    PointContact::Evaluation found;
    return PointContact(slide.contact).linearise({ displacements, slide.drive(), slide.speed(), nullptr, friction }, found);
  }

  double distance(const Full &a, const Full &b)
  {
    Full difference = a;
    difference.add(-1., b);
    return difference.frobenius_norm();
  }

  /// Central differences; `width` [mm or mm/s] at the contact.
  template <class Evaluate>
  void expect_derivative(const Slide &slide, const Full &exact, const Evaluate &evaluate, const double width,
                         const double tolerance)
  {
    const auto dofs = evaluate(Vector(slide.contact.layout.size())).dofs;
    for (unsigned int j = 0; j < dofs.size(); ++j)
    {
      Vector change(slide.contact.layout.size());
      change[dofs[j]]    = width / slide.arm(dofs[j]);
      const Vector right = evaluate(change).values;
      change *= -1.;
      const Vector left = evaluate(change).values;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        EXPECT_NEAR(exact(i, j), (left[i] - right[i]) / (2. * change[dofs[j]]),
                    tolerance * slide.arm(dofs[i]) * slide.arm(dofs[j]))
            << slide.name << ", force on dof " << dofs[i] << " by dof " << dofs[j];
    }
  }
} // namespace

// Over 2e-6 mm: the law's third derivative, 1.5e7 N/mm^3, makes 1e-5 N/mm; round-off of the gap, 2e-14 mm times 1500 N/mm over
// 2e-6 mm, as much. The tangent itself is 1500 N/mm.
TEST(Linearisation, PressureAndFrictionAreTheDerivativeOfTheForcesByDisplacements)
{
  for (const auto &slide : slides(0.05))
  {
    const Vector at = slide.position(penetration);
    const Full both = linearised(slide, at).stiffness();
    EXPECT_EQ(distance(both, forces(slide, at).tangent), 0.) << slide.name;
    expect_derivative(
        slide, both,
        [&](Vector change)
        {
          change += at;
          return forces(slide, change);
        },
        2e-6, 1e-3);
  }
}

// A step without movement, all weight on its end, that begins without friction.
TEST(Linearisation, StuckIsTheTangentOfAStepInStick)
{
  for (const auto &slide : slides(0.))
  {
    if (slide.contact.friction.regularisation_speed > 0.)
      continue;
    const Vector at   = slide.position(penetration);
    const Full linear = linearised(slide, at, ContactFriction::stuck).stiffness();
    const StepWeights weights{ 1e-5, 0., 0., 0.25, 0.5 };
    const Vector rest(at.size());
    Motion accepted;
    accepted.drive   = { 0., place, 0., 0. };
    accepted.contact = { ContactHistory{} };
    PointContact contact(slide.contact);
    PointContact::Evaluation found;
    contact.evaluate(InterfaceStep{ accepted.drive, accepted.contact, accepted.drive, { at, rest, rest }, at, rest, weights },
                     found);
    EXPECT_LT(distance(found.forces.tangent, linear), 1e-12 * linear.frobenius_norm()) << slide.name;
  }
}

TEST(Linearisation, InertiaOfTheCouplingIsTheDerivativeOfItsForcesByAccelerations)
{
  const InterfaceLayout layout{ 4, true };
  const double rest = 0.056;
  const StepWeights weights{ 1e-3, 0., 0., 0.25, 0.5 };
  FrameCoupling coupling(layout, rest);
  Kinematic begin{ Vector(layout.size()), Vector(layout.size()), Vector(layout.size()) };
  begin.position[layout.rotation()] = 0.07;
  begin.position[layout.support()]  = 0.3;
  const auto dofs                   = coupling.coupled_dofs();
  Full inertia(4, 4);
  coupling.add_inertia(dofs, { { rest + 0.07 } }, inertia);
  for (unsigned int j = 0; j < 4; ++j)
  {
    // Over an acceleration of 10 the interface moves by 2.5e-6, of which 5e-17 is round-off; what is not linear is even.
    const double a = 10.;
    Vector values[2];
    for (const double sign : { 1., -1. })
    {
      Vector end = begin.position;
      end[dofs[j]] += sign * a * weights.beta * weights.dt * weights.dt;
      InterfaceForces forces;
      coupling.add_forces(begin, end, weights, forces);
      values[sign > 0. ? 0 : 1] = forces.values;
    }
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_NEAR(-inertia(i, j), (values[0][i] - values[1][i]) / (2. * a), 1e-9) << i << j;
  }
  EXPECT_NEAR(inertia(1, 3), std::sin(rest + 0.07), 1e-15);
}
