// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/point_contact.h"

#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  const Geometry geometry      = { 56., 45.6, 185.5, 0. };
  constexpr double length      = 210.;
  constexpr double v           = 112.;
  constexpr double step_length = 5e-5;
  constexpr double stiffness   = 2000.; ///< of the contact in all cases, about [N/mm]

  /// A contact in the middle of a motion.
  struct Case
  {
    std::string name;
    bool bends = true;
    bool sprung;
    double neutral_axis;
    NormalLaw normal = { 2000., 1. };
    double damping   = 0.;
    FrictionLaw friction;
    double penetration_begin = 0.01; ///< [mm]
    double penetration_end   = 0.0102;
    ContactHistory history   = { 0., Slip({ 14. }), 0., Slip({ 110. }), step_length };
    double x                 = 44.3;
    double direction         = 1.;

    PointContactProperties properties() const
    {
      PointContactProperties result;
      result.geometry            = geometry;
      result.mesh                = { bends ? 8u : 0u, length };
      result.layout              = { result.mesh.n_dofs(), sprung };
      result.rest_inclination    = kinematics(geometry, 0.).theta;
      result.neutral_axis_offset = neutral_axis;
      result.normal              = normal;
      result.damping             = damping;
      result.tangential          = 1000.;
      result.friction            = friction;
      return result;
    }

    InterfaceLayout layout() const
    {
      return properties().layout;
    }

    DrivePoint drive(const double time) const
    {
      return { time, x + direction * v * time, direction * v, 0. };
    }

    /// Returns displacements at which the contact has the penetration; the lever is bent as by some tenths of a newton and more
    /// at the time 1.
    Vector position(const double time, const double penetration, const double bend = 1.) const
    {
      Vector z(layout().size());
      for (unsigned int i = 0; i < layout().surface; i += 2)
      {
        const double xi = (i / 2 + 1) / 8.;
        z[i]            = bend * (1. + 20. * time) * (4e-3 * xi * xi - 3e-3 * std::sin(3. * xi));
        z[i + 1]        = bend * (1. + 20. * time) * (8e-3 * xi - 9e-3 * std::cos(3. * xi)) / length;
      }
      if (sprung)
      {
        z[layout().momentum_eta()] = 3e-4;
        z[layout().support()]      = 0.02 + 3. * time;
      }
      // Turned in by 0.1 mm and back until the penetration is there; from that on, open gaps too, along the derivative.
      PointContact contact(properties());
      PointContact::Evaluation found;
      Vector turn(z.size());
      turn[layout().rotation()] = 1.;
      z[layout().rotation()] += kinematics(geometry, x).theta - properties().rest_inclination - 1e-3 * std::max(1., 0.05 * bend);
      const double closed = std::max(penetration, 1e-3);
      for (unsigned int i = 0; i < 8; ++i)
      {
        contact.touch(z, drive(time), found);
        z[layout().rotation()] += (found.penetration() - closed) / contact.gap_change(found, turn);
      }
      z[layout().rotation()] += (closed - penetration) / contact.gap_change(found, turn);
      return z;
    }
  };

  const FrictionLaw coulomb          = { CoulombFriction{ 0.73 }, FrictionSpeed::sliding };
  const FrictionLaw cork             = { CorkOnAluminium{}, FrictionSpeed::sliding };
  const FrictionLaw by_drive         = { CorkOnAluminium{}, FrictionSpeed::drive };
  const FrictionLaw regularised_cork = { CorkOnAluminium{}, FrictionSpeed::sliding, 1. };
  const FrictionLaw none             = { CoulombFriction{ 0. }, FrictionSpeed::sliding };

  /// One step of a contact.
  class Stepped
  {
  public:
    explicit Stepped(const Case &chosen, const double spectral_radius = 0.8)
        : tested(chosen)
        , contact(chosen.properties())
        , weights(generalised_alpha(spectral_radius, step_length))
    {
      begin.position = tested.position(0., tested.penetration_begin);
      begin.velocity = tested.position(step_length, tested.penetration_end);
      begin.velocity -= begin.position;
      begin.velocity *= 1. / step_length;
      begin.acceleration = Vector(begin.position.size());
      accepted.drive     = tested.drive(0.);
      accepted.contact   = { tested.history };
      end                = tested.position(step_length, tested.penetration_end);
    }

    const InterfaceForces &forces(const Vector &at)
    {
      const auto drifted = unaccelerated(begin, weights);
      Vector rate        = drifted.velocity;
      rate.add(weights.rate(), at, -weights.rate(), drifted.position);
      contact.evaluate(InterfaceStep{ accepted.drive, accepted.contact, tested.drive(step_length), begin, at, rate, weights },
                       found);
      return found.forces;
    }

    const Case tested;
    PointContact contact;
    PointContact::Evaluation found;
    const StepWeights weights;
    Motion accepted;
    Kinematic begin;
    Vector end;
  };

  /// Returns the movement of the contact by a unit of the dof [mm].
  double arm(const Case &tested, const unsigned int dof)
  {
    if (dof == tested.layout().rotation())
      return 120.;
    return dof < tested.layout().surface && dof % 2 == 1 ? length / 8. : 1.;
  }

  // Central differences over h = 2e-6 mm: h^2/6 of the third derivative, 3 k mu'' (dv/dq)^2 = 4e8 N/mm^3 in a step of mu(v), less
  // of the curved law, is 3e-4 N/mm; round-off of the gap, 2e-14 mm, times 2000 N/mm over h is 2e-5 N/mm.
  // The tangent leaves out what third derivatives of gap and slip add over a step, 1e-3 N/mm.
  constexpr double width     = 2e-6;
  constexpr double tolerance = 1e-6 * stiffness;

  template <class Evaluate>
  void expect_tangent(const Case &tested, const Vector &at, const Evaluate &evaluate, const double most = tolerance)
  {
    const InterfaceForces exact = evaluate(at);
    ASSERT_FALSE(exact.dofs.empty());
    for (unsigned int j = 0; j < exact.dofs.size(); ++j)
    {
      const double h = width / arm(tested, exact.dofs[j]);
      Vector moved   = at;
      moved[exact.dofs[j]] += h;
      const Vector right = evaluate(moved).values;
      moved[exact.dofs[j]] -= 2. * h;
      const Vector left = evaluate(moved).values;
      for (unsigned int i = 0; i < exact.dofs.size(); ++i)
        EXPECT_NEAR(exact.tangent(i, j), (right[i] - left[i]) / (2. * h),
                    most * arm(tested, exact.dofs[i]) * arm(tested, exact.dofs[j]))
            << tested.name << ", force on dof " << exact.dofs[i] << " by dof " << exact.dofs[j];
    }
  }

  Vector on_all_dofs(const Case &tested, const InterfaceForces &forces)
  {
    Vector result(tested.layout().size());
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      result[forces.dofs[a]] = forces.values[a];
    return result;
  }

  /// Rigid and bending levers on rigid and sprung supports, neutral axis at the face, behind it and before it.
  std::vector<Case> levers(const FrictionLaw &friction)
  {
    std::vector<Case> result;
    for (const bool bends : { false, true })
      for (const bool sprung : { false, true })
        for (const double axis : { geometry.interface_offset, 56.6, 0. })
        {
          Case lever{};
          lever.bends        = bends;
          lever.sprung       = sprung;
          lever.neutral_axis = axis;
          lever.friction     = friction;
          lever.name = std::string(bends ? "beam" : "rigid") + (sprung ? ", sprung" : "") + ", e_a " + std::to_string(axis);
          result.push_back(lever);
        }
    return result;
  }

  /// Slides of all levers both ways on a curved law.
  std::vector<Case> slides(const FrictionLaw &friction, const double damping)
  {
    std::vector<Case> result;
    for (auto lever : levers(friction))
      for (const double direction : { 1., -1. })
      {
        lever.normal    = { 10451., 1.4726 };
        lever.damping   = damping;
        lever.direction = direction;
        result.push_back(lever);
      }
    return result;
  }

  double distance(const dealii::FullMatrix<double> &a, const dealii::FullMatrix<double> &b)
  {
    auto difference = a;
    difference.add(-1., b);
    return difference.frobenius_norm();
  }

  /// Slipping under mu(v), damped, curved law, bending, sprung: everything at once.
  Case full_case()
  {
    Case result            = levers(cork)[10];
    result.normal          = { 10451., 1.4726 };
    result.damping         = 0.05;
    result.history.damping = 0.3;
    return result;
  }
} // namespace

// The speed of 1 mm/s, over which friction changes sign, leaves a share of mu p.
TEST(PointContact, ASlideHasTheMuOfItsLawWhereRegularisationLeavesLessFriction)
{
  const Case lever = levers(regularised_cork)[0];
  PointContact contact(lever.properties());
  PointContact::Evaluation found;
  contact.evaluate_sliding({ lever.position(0., 0.01), lever.drive(0.), 0.5 }, found);
  Row row;
  contact.observe(found, row);
  EXPECT_DOUBLE_EQ(row[Column::mu], friction_coefficient(cork, 0.5).coefficient);
  EXPECT_NEAR(row[Column::friction_resultant], row[Column::mu] * row[Column::normal_resultant] * 0.5 / std::hypot(0.5, 1.),
              1e-12);
}

TEST(PointContact, TangentOfAStepInSlipIsTheDerivativeOfTheForce)
{
  for (const auto &friction : { coulomb, cork, by_drive, regularised_cork })
    for (const auto &lever : levers(friction))
    {
      Stepped stepped(lever);
      expect_tangent(lever, stepped.end, [&](const Vector &z) { return stepped.forces(z); });
      Row row;
      stepped.contact.observe(stepped.found, row);
      EXPECT_GT(row[Column::mu], 0.5);
    }
}

TEST(PointContact, TangentOfAStepInStickIsTheDerivativeOfTheForce)
{
  for (auto lever : levers(cork))
  {
    lever.history = { 0., Slip({ -3. }), 0., Slip(), step_length };
    Stepped stepped(lever);
    expect_tangent(lever, stepped.end, [&](const Vector &z) { return stepped.forces(z); });
    Row row;
    stepped.contact.observe(stepped.found, row);
    EXPECT_LT(std::abs(row[Column::friction_resultant]), 0.349 * row[Column::normal_resultant]);
  }
}

TEST(PointContact, TangentOfAStepCountsDampingAndACurvedLaw)
{
  for (auto lever : levers(cork))
  {
    lever.normal          = { 10451., 1.4726 };
    lever.damping         = 0.05;
    lever.history.damping = 0.3;
    for (const double radius : { 1., 0.8, 0. })
    {
      Stepped stepped(lever, radius);
      expect_tangent(lever, stepped.end, [&](const Vector &z) { return stepped.forces(z); });
    }
  }
}

TEST(PointContact, TangentOfAStepThatOpensOrClosesIsTheDerivativeOfTheForce)
{
  for (auto lever : levers(coulomb))
    for (const bool opens : { true, false })
    {
      lever.penetration_begin = opens ? 0.003 : -0.003;
      lever.penetration_end   = opens ? -0.004 : 0.004;
      lever.history           = opens ? ContactHistory{ 0., Slip({ 4. }), 0., Slip({ 110. }), step_length } : ContactHistory{};
      Stepped stepped(lever);
      expect_tangent(lever, stepped.end, [&](const Vector &z) { return stepped.forces(z); });
    }
}

/// There the curvature jumps, so that the closest point stays at the node for a while: over micrometres of x and less.
TEST(PointContact, ForcesAreContinuousWhereTheClosestPointStaysAtANode)
{
  for (const auto &[node, axis] : { std::pair{ 4u, 0. }, { 4u, 56.6 }, { 5u, 0. }, { 5u, 56.6 } })
  {
    Case lever         = full_case();
    lever.sprung       = false;
    lever.neutral_axis = axis;
    Vector at;
    PointContact contact(lever.properties());
    PointContact::Evaluation found;
    Row row;
    const auto evaluate = [&](const double drive_x)
    {
      contact.evaluate_sliding({ at, { 0., drive_x, v, 0. }, 108. }, found);
      contact.observe(found, row);
      return on_all_dofs(lever, found.forces);
    };
    double x = geometry.pivot_distance - node * length / 8., low = 0.;
    for (unsigned int pass = 0; pass < 10; ++pass)
    {
      lever.x             = x;
      at                  = lever.position(0., 0.05, 100.);
      const double offset = geometry.interface_offset - lever.neutral_axis;
      const double place  = node * length / 8. - offset * at[2 * node - 1];
      double high         = 0.3;
      low                 = -0.3;
      for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = 0.5 * (low + high);
        evaluate(x + middle);
        (row[Column::s] > place ? low : high) = middle;
      }
      x += low;
    }
    constexpr double step = 1e-7;
    Vector before         = evaluate(x - 300. * step);
    for (int i = -299; i <= 300; ++i)
    {
      const Vector after = evaluate(x + i * step);
      ASSERT_GT(row[Column::P], 0.);
      before -= after;
      for (unsigned int dof = 0; dof < before.size(); ++dof)
        ASSERT_NEAR(before[dof], 0., 1e-2 * arm(lever, dof))
            << "node " << node << ", e_a " << axis << ", dof " << dof << ", step " << i;
      before = after;
    }
  }
}

// Over 2e-6 mm: the law's third derivative, 1.5e7 N/mm^3, makes 1e-5 N/mm; round-off of the gap, 2e-14 mm times 1500 N/mm over
// 2e-6 mm, as much. The tangent itself is 1500 N/mm.
TEST(Linearisation, PressureAndFrictionAreTheDerivativeOfTheForcesByDisplacements)
{
  for (const auto &friction : { coulomb, cork, FrictionLaw{ CorkOnAluminium{}, FrictionSpeed::sliding, 50. } })
    for (const auto &slide : slides(friction, 0.05))
    {
      PointContact contact(slide.properties());
      PointContact::Evaluation found;
      const auto evaluate = [&](const Vector &z)
      {
        contact.evaluate_sliding({ z, slide.drive(0.), slide.direction * 108. }, found);
        return found.forces;
      };
      const Vector at    = slide.position(0., 0.012);
      const auto tangent = evaluate(at).tangent;
      EXPECT_EQ(distance(contact.linearise({ at, slide.drive(0.), slide.direction * 108. }, found).stiffness(), tangent), 0.)
          << slide.name;
      expect_tangent(slide, at, evaluate, 1e-3);
    }
}

// A step without movement, all weight on its end, that begins without friction.
TEST(Linearisation, StuckIsTheTangentOfAStepInStick)
{
  for (const auto &friction : { coulomb, cork })
    for (const auto &slide : slides(friction, 0.))
    {
      PointContact contact(slide.properties());
      PointContact::Evaluation found;
      const Vector at = slide.position(0., 0.012), rest(at.size());
      const auto linear =
          contact.linearise({ at, slide.drive(0.), slide.direction * 108., nullptr, ContactFriction::stuck }, found).stiffness();
      const DrivePoint drive{ 0., slide.x, 0., 0. };
      const std::vector<ContactHistory> history{ ContactHistory{} };
      const StepWeights all_at_the_end{ 1e-5, 0., 0., 0.25, 0.5 };
      contact.evaluate(InterfaceStep{ drive, history, drive, { at, rest, rest }, at, rest, all_at_the_end }, found);
      EXPECT_LT(distance(found.forces.tangent, linear), 1e-12 * linear.frobenius_norm()) << slide.name;
    }
}
