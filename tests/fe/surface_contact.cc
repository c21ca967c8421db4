#include "fe/solid/surface_contact.h"

#include "fe/contact/face_contact_point.h"
#include "model/circle.h"
#include "mpi_environment.h"
#include "scenes.h"
#include "support/random_vector.h"
#include "support/turning_axis.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double width = 50.;

  /// A flat friction face of quadratic elements under model A's cylinder at x = 64, without a body: a bed of springs.
  class Bed
  {
  public:
    explicit Bed(const Cylinder &cylinder, const double stiffness, const unsigned int elements_across = 20)
        : fe(dealii::FE_Q<3>(2), 3)
    {
      const double e = model_a().geometry.interface_offset;
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, { 20, 1, elements_across },
                                                        dealii::Point<3>(111., e, -0.5 * width),
                                                        dealii::Point<3>(131., e + 1., 0.5 * width));
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->set_material_id(material_id::lever);
        for (const auto &side : cell->face_iterators())
          if (side->at_boundary() && std::abs(side->center()[1] - e) < 1e-9)
            side->set_boundary_id(boundary_id::friction_face);
      }
      dofs.reinit(triangulation);
      dofs.distribute_dofs(fe);
      BodyProperties properties;
      properties.constants    = { { material_id::lever, { 1., 0. } } };
      face                    = find_friction_face(dealii::MappingQ1<3>(), dofs, dealii::AffineConstraints<double>(), properties,
                                                   boundary_id::friction_face);
      ports                   = { 3 * static_cast<unsigned int>(face.nodes.size()), false };
      ports.has_inertia       = false;
      ports.slopes            = cylinder.has_free_axis() ? 2 : 0;
      const Geometry geometry = model_a().geometry;
      contact = std::make_unique<SurfaceContact>(face, SurfaceContactProperties{ RigidCylinder(geometry, cylinder),
                                                                                 [geometry](const double at, const double theta)
                                                                                 { return cylinder_centre(geometry, at, theta); },
                                                                                 geometry.cylinder_radius,
                                                                                 ports,
                                                                                 0.,
                                                                                 { stiffness, stiffness } });
    }

    /// Ports at rest and an inclination at which the cylinder overlaps by so much in the middle [mm].
    dealii::Vector<double> pressed(const double overlap) const
    {
      const auto geometry = model_a().geometry;
      dealii::Vector<double> result(ports.size());
      result[ports.rotation()] =
          std::asin((geometry.cylinder_radius - overlap - geometry.interface_offset) / (geometry.pivot_distance - x));
      return result;
    }

    SurfaceEvaluation evaluated(const dealii::Vector<double> &begin, const double from_x, const dealii::Vector<double> &end,
                                const double friction)
    {
      SurfaceEvaluation found;
      contact->begin_step({ begin, from_x });
      contact->evaluate({ end, x }, {}, 0., StaticTerms{ { CoulombFriction{ friction } }, 1. }, found);
      return found;
    }

    SurfaceContact &surface()
    {
      return *contact;
    }

    const std::vector<FacePoint<3>> &points() const
    {
      return face.points;
    }

    /// The length that makes a movement of a unit of a port, see PortWindow [mm].
    double length_of(const unsigned int port) const
    {
      return ports.is_slope(port) ? 0.5 * width : 1.;
    }

    /// Force and moment on the lever of an evaluation about the cylinder's middle, in the axes of the world.
    std::array<dealii::Tensor<1, 3>, 2> resultant(const SurfaceEvaluation &found) const
    {
      const auto geometry = model_a().geometry;
      const double theta  = found.displacement[ports.rotation()];
      const double c = std::cos(theta), s = std::sin(theta);
      std::array<dealii::Tensor<1, 3>, 2> result;
      for (const auto &point : found.points)
      {
        const auto in_world = [&](const double xi, const double eta, const double zeta) {
          return dealii::Tensor<1, 3>({ -xi * c + eta * s, xi * s + eta * c, zeta });
        };
        const auto &at    = point.position;
        const auto arm    = in_world(at[0], at[1], at[2]) + dealii::Tensor<1, 3>({ geometry.pivot_distance - x, 0., 0. });
        const double area = face.points[point.index].weight;
        const auto force  = area * in_world(point.end_force[0], point.end_force[1], point.end_force[2]);
        result[0] += force;
        result[1] += cross_product_3d(arm, force);
      }
      return result;
    }

    /// Force along eta and its moment about the middle of the width.
    std::array<double, 2> pressed_by(const double overlap)
    {
      const auto at    = pressed(overlap);
      const auto found = evaluated(at, x, at, 0.);
      std::array<double, 2> result{};
      for (const auto &point : found.points)
      {
        const double force = face.points[point.index].weight * point.pressure;
        result[0] += force;
        result[1] += force * point.position[2];
      }
      return result;
    }

    static constexpr double x = 64.;
    PortLayout ports;

  private:
    dealii::Triangulation<3> triangulation;
    const dealii::FESystem<3> fe;
    dealii::DoFHandler<3> dofs;
    FrictionFace<3> face;
    std::unique_ptr<SurfaceContact> contact;
  };

  Cylinder tilted(const double tilt)
  {
    Cylinder result;
    result.tilt = tilt;
    return result;
  }

  /// Out of true both ways, or also free to yield.
  Cylinder skewed(const bool is_free)
  {
    Cylinder result = tilted(6e-4);
    result.skew     = 2e-3;
    if (is_free)
      result.tilt_stiffness = result.skew_stiffness = 1e6;
    return result;
  }
} // namespace

// P = (2/5)(c/tilt)[d^(5/2)], M = (c/tilt^2)[(2/7) d^(7/2) - (2/5) d_0 d^(5/2)] with c = 4/3 K sqrt(2 R), d = d_0 +- tilt w/2 at
// the edges, cut off at 0, K = 12.5 N/mm^3, d_0 = 0.03 mm. A parabola stands for the circle, which leaves some 2 d/R of
// the largest d, and across the face a tilted circle is an ellipse, R tilt^2/2 higher. The sign of the
// moment: with a positive tilt the axis comes closer to the lever where zeta > 0. The bed is inclined, and what counts is the
// slope towards it.
TEST(SurfaceContact, ATiltedCylinderOnABedOfSpringsIsKnown)
{
  const std::tuple<double, double, double> known[] = { { 0., 45.8258, 0. },
                                                       { 4e-4, 46.4649, 190.402 },
                                                       { 8e-4, 48.4187, 377.345 },
                                                       { 1.2e-3, 51.8459, 555.492 },
                                                       { 2.4e-3, 71.4353, 1020.50 } };
  const double inclination                         = 0.08552; // at which the cylinder overlaps by d_0
  for (const auto &[tilt, P, M] : known)
  {
    const auto [force, moment] = Bed(tilted(tilt / std::cos(inclination)), 12.5).pressed_by(0.03);
    const double deepest       = 0.03 + 0.5 * width * tilt;
    const double approximation = 2. * deepest / 56. + 2.5 * 0.5 * 56. * tilt * tilt / deepest;
    EXPECT_NEAR(force, P, approximation * P) << tilt;
    EXPECT_NEAR(moment, M, approximation * std::max(M, 1.)) << tilt;
    const auto [mirrored_force, mirrored_moment] = Bed(tilted(-tilt / std::cos(inclination)), 12.5).pressed_by(0.03);
    EXPECT_NEAR(mirrored_force, force, 1e-9 * P);
    EXPECT_NEAR(mirrored_moment, -moment, 1e-8 * std::max(M, 1.));
  }
}

// What turns the shaft is the moment of the tractions about its middle.
TEST(SurfaceContact, TheForcesOnTheSlopesAreMomentsOfTheTractions)
{
  Bed bed(skewed(true), 12.5, 6);
  auto end                  = bed.pressed(0.03);
  end[bed.ports.slope(0)]   = 2e-4;
  end[bed.ports.slope(1)]   = 0.03;
  const auto begin          = bed.pressed(0.02);
  const auto found          = bed.evaluated(begin, Bed::x - 0.7, end, 0.4);
  const auto moment         = -1. * bed.resultant(found)[1]; // on the cylinder
  const auto [tilts, skews] = turns_by_slopes(8e-4, 0.032);
  const auto force          = [&](const unsigned int slope)
  { return found.forces.values[place_of(bed.ports.slope(slope), found.forces.ports)]; };
  EXPECT_GT(std::abs(force(0)), 10.);
  EXPECT_NEAR(force(0), tilts * moment, 1e-10 * moment.norm());
  EXPECT_NEAR(force(1), skews * moment, 1e-10 * moment.norm());
}

// k (tilt - Tilt) = -cos(theta) M(tilt cos(theta)) with M of ATiltedCylinderOnABedOfSpringsIsKnown. Where it is small
// tilt = Tilt/(1 + S cos(theta)^2/k), S = c sqrt(d_0) w^3/8.
TEST(SurfaceContact, AShaftOnABedOfSpringsYieldsAsKnown)
{
  const double K = 12.5, d_0 = 0.03, Tilt = 1.2e-3, inclination = 0.08552, c = 4. / 3. * K * std::sqrt(2. * 56.);
  const double cosine = std::cos(inclination);
  const auto moment   = [&](const double tilt)
  {
    const auto of = [&](const double d) { return 2. / 7. * std::pow(d, 3.5) - 0.4 * d_0 * std::pow(d, 2.5); };
    return c / (tilt * tilt) * (of(d_0 + 0.5 * width * tilt) - of(std::max(0., d_0 - 0.5 * width * tilt)));
  };
  for (const double stiffness : { 1e5, 5e5, 3e6 })
  {
    double low = 1e-6, high = Tilt;
    while (high - low > 1e-13)
    {
      const double middle                                                                = 0.5 * (low + high);
      (stiffness * (middle - Tilt) + cosine * moment(middle * cosine) > 0. ? high : low) = middle;
    }
    Cylinder cylinder       = tilted(Tilt);
    cylinder.tilt_stiffness = stiffness;
    Bed bed(cylinder, K);
    auto at = bed.pressed(d_0);
    for (unsigned int i = 0; i < 6; ++i)
    {
      const auto found         = bed.evaluated(at, Bed::x - 0.7, at, 0.); // slides, so that nothing sticks at no force
      const unsigned int place = place_of(bed.ports.slope(0), found.forces.ports);
      const double unbalance   = found.forces.values[place] - stiffness * at[bed.ports.slope(0)];
      at[bed.ports.slope(0)] += unbalance / (stiffness - found.forces.tangent(place, place));
    }
    // As far as a parabola is a circle, and as the closed form's moment is off, see above.
    const double approximation = 2. * (d_0 + 0.5 * width * Tilt) / 56. + 2.5 * 0.5 * 56. * Tilt * Tilt / d_0;
    const double tilt          = Tilt + at[bed.ports.slope(0)];
    EXPECT_NEAR(tilt, low, approximation * std::min(low, Tilt - low) + 1e-8) << stiffness;
    if (stiffness <= 1e5)
    {
      EXPECT_NEAR(tilt, Tilt / (1. + c * std::sqrt(d_0) * std::pow(width, 3) / 8. * cosine * cosine / stiffness), 0.03 * tilt);
    }
  }
}

// P = pi K sqrt(R_1 R_2) d^2.
TEST(SurfaceContact, ABarrelOnABedOfSpringsIsKnown)
{
  Cylinder barrel;
  barrel.crown_radius = 500.;
  EXPECT_NEAR(Bed(barrel, 12.5, 60).pressed_by(0.03)[0], 5.91400, 2e-3 * 5.914);
}

TEST(SurfaceContact, AShortCylinderPressesOnItsLength)
{
  Cylinder cylinder;
  cylinder.length = 30.;
  EXPECT_NEAR(Bed(cylinder, 12.5).pressed_by(0.03)[0], 45.8258 * 30. / width, 1e-3 * 45.8258);
}

TEST(SurfaceContact, FrictionOpposesTheSlipWhicheverWayItGoes)
{
  Bed bed({}, 12.5);
  const auto end = bed.pressed(0.03);
  auto begin     = end;
  for (unsigned int port = 0; port < bed.ports.surface; port += 3)
  {
    begin[port] -= 0.3; // the points come along xi by 0.3 and along zeta by 0.4
    begin[port + 2] -= 0.4;
  }
  const auto found = bed.evaluated(begin, Bed::x, end, 0.5);
  double closed    = 0.;
  for (const auto &point : found.points)
    if (point.pressure > 0.)
    {
      closed += 1.;
      EXPECT_TRUE(point.slipping);
      EXPECT_NEAR(point.traction.norm(), 0.5 * point.pressure, 1e-12);
      // The slip round the cylinder is measured on its surface, which lies up to 0.03 mm off the points: 5.4e-4 of it.
      EXPECT_NEAR(point.traction[1] / point.traction[0], 0.4 / 0.3, 1e-3);
      EXPECT_NEAR(point.end_force[2], -0.5 * point.pressure * 0.8, 3e-4 * point.pressure);
    }
  EXPECT_GT(closed, 1000.);
}

namespace
{
  /// A change of all ports by movements of up to 1 mm.
  dealii::Vector<double> any_change(const Bed &bed)
  {
    auto result = random_vector(bed.ports.size(), 1., 1);
    for (unsigned int port = 0; port < result.size(); ++port)
      result[port] /= bed.length_of(port);
    return result;
  }

  /// Makes forces of the moments on the slopes.
  void weigh(const Bed &bed, const std::vector<unsigned int> &ports, dealii::Vector<double> &forces)
  {
    for (unsigned int i = 0; i < ports.size(); ++i)
      forces[i] /= bed.length_of(ports[i]);
  }

  /// Compares the tangent at some ports with differences of the forces that `evaluated(ports)` finds. Points at the edge of the
  /// contact change their state on the way.
  template <class Evaluated>
  void expect_tangent(const Bed &bed, const dealii::Vector<double> &ports, const Evaluated &evaluated, const double friction)
  {
    const SurfaceEvaluation found = evaluated(ports);
    const auto change             = any_change(bed);
    const double step             = 1e-7;
    auto before = ports, after = ports;
    before.add(-step, change);
    after.add(step, change);
    const SurfaceEvaluation low = evaluated(before), high = evaluated(after);
    ASSERT_EQ(low.forces.ports, found.forces.ports);
    ASSERT_EQ(high.forces.ports, found.forces.ports);
    dealii::Vector<double> of_ports(static_cast<unsigned int>(found.forces.ports.size())), slope(of_ports.size());
    for (unsigned int i = 0; i < of_ports.size(); ++i)
      of_ports[i] = change[found.forces.ports[i]];
    found.forces.tangent.vmult(slope, of_ports);
    auto difference = high.forces.values;
    difference -= low.forces.values;
    difference /= 2. * step;
    difference -= slope;
    weigh(bed, found.forces.ports, difference);
    weigh(bed, found.forces.ports, slope);
    EXPECT_LT(difference.l2_norm(), 1.5e-4 * slope.l2_norm()) << friction;
  }
} // namespace

/// Whether the axis is free on its shaft.
class SurfaceContactOfAnAxis : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(IsFree, SurfaceContactOfAnAxis, testing::Bool());

TEST_P(SurfaceContactOfAnAxis, TheTangentIsTheDerivativeOfTheForces)
{
  Bed bed(skewed(GetParam()), 12.5, 6);
  const auto begin = bed.pressed(0.02);
  for (const double friction : { 0.4, 50. }) // slips, sticks
  {
    auto end = bed.pressed(0.03);
    for (unsigned int port = 0; port < bed.ports.surface; ++port)
      end[port] += 1e-3 * std::sin(1.3 * port);
    expect_tangent(
        bed, end, [&](const dealii::Vector<double> &at) { return bed.evaluated(begin, Bed::x - 0.7, at, friction); }, friction);
  }
}

// Of friction that changes with the speed. Displacements are those of a slide at rest; points at the edge of the contact change
// their state on the way.
TEST_P(SurfaceContactOfAnAxis, SlidingIsLinearisedByDisplacementsAndVelocities)
{
  Bed bed(skewed(GetParam()), 12.5, 6);
  auto ports = bed.pressed(0.03);
  for (unsigned int port = 0; port < bed.ports.surface; ++port)
    ports[port] += 1e-3 * std::sin(1.3 * port);
  auto rates = random_vector(bed.ports.size(), 20., 3);
  for (unsigned int port = 0; port < rates.size(); ++port)
    rates[port] /= bed.length_of(port);
  const FrictionLaw friction{ StribeckFriction{ 0.9, 0.6, 30., 1., 1e-3 } };
  const DrivePoint drive{ 0., Bed::x, 112., 0. };
  const double speed = 100.;
  const auto change  = any_change(bed);
  for (const bool of_rates : { false, true })
  {
    const auto at_rest = dealii::Vector<double>(bed.ports.size());
    const auto &moving = of_rates ? rates : at_rest;
    SurfaceEvaluation found;
    const auto linear = bed.surface().linearise({ ports, drive, speed, &moving, ContactFriction::sliding }, friction, found);
    const double step = of_rates ? 1e-3 : 1e-7;
    const auto forces = [&](const double side)
    {
      auto at = ports, with = moving;
      (of_rates ? with : at).add(side * step, change);
      SurfaceEvaluation result;
      bed.surface().slide({ at, drive, speed, &with, ContactFriction::sliding }, friction, result);
      EXPECT_EQ(result.forces.ports, linear.ports);
      return result.forces.values;
    };
    dealii::Vector<double> of_ports(static_cast<unsigned int>(linear.ports.size())), slope(of_ports.size());
    for (unsigned int i = 0; i < of_ports.size(); ++i)
      of_ports[i] = change[linear.ports[i]];
    (of_rates ? linear.damping() : linear.stiffness()).vmult(slope, of_ports);
    EXPECT_GT(slope.l2_norm(), 0.);
    auto difference = forces(1.);
    difference -= forces(-1.);
    difference /= 2. * step;
    difference -= slope;
    weigh(bed, linear.ports, difference);
    weigh(bed, linear.ports, slope);
    EXPECT_LT(difference.l2_norm(), (of_rates ? 1e-7 : 1e-4) * slope.l2_norm()) << of_rates;
  }
}

// The tangent of a step in time, and forces that balance between its ends: pressure does the work of its springs.
TEST_P(SurfaceContactOfAnAxis, AStepInTimeHasItsTangent)
{
  Bed bed(skewed(GetParam()), 12.5, 6);
  const auto begin = bed.pressed(0.02);
  const StepWeights weights{ 1e-4, 0., 0., 0.25, 0.5 };
  const DrivePoint from{ 0., Bed::x - 0.7, 112., 0. }, to{ 1e-4, Bed::x, 112., 0. };
  for (const double friction : { 0.4, 50. }) // slips, sticks
  {
    const auto evaluated = [&](const dealii::Vector<double> &end)
    {
      SurfaceEvaluation found;
      const std::vector<ContactMemory> none;
      bed.surface().evaluate(PortStep{ from, none, to, { begin, {}, {} }, end, {}, weights }, { CoulombFriction{ friction } },
                             found);
      return found;
    };
    auto end = bed.pressed(0.03);
    for (unsigned int port = 0; port < bed.ports.surface; ++port)
      end[port] += 1e-3 * std::sin(1.3 * port);
    expect_tangent(bed, end, evaluated, friction);
  }
}

// Eight points at once are what each is by itself.
TEST_P(SurfaceContactOfAnAxis, AStepInTimeFollowsTheLawsAtEachPoint)
{
  Cylinder cylinder     = skewed(GetParam());
  cylinder.length       = 40.;
  cylinder.edge_radius  = 4.;
  cylinder.crown_radius = 8000.;
  const RigidCylinder rigid(model_a().geometry, cylinder);
  FrictionLaw regularised{ CoulombFriction{ 0.6 } };
  regularised.regularisation_speed = 20.;
  for (const auto &friction : { FrictionLaw{ CoulombFriction{ 0.4 } }, FrictionLaw{ CoulombFriction{ 50. } }, FrictionLaw{},
                                FrictionLaw{ StribeckFriction{} }, regularised })
  {
    Bed bed(cylinder, 12.5, 6);
    const auto weights = generalised_alpha(0.8, 6e-3);
    const std::vector<ContactMemory> none;
    const auto step = [&](const auto &from, const auto &to, const double x, const std::vector<SurfaceMemory> &memory)
    {
      SurfaceEvaluation found;
      bed.surface().evaluate(
          PortStep{ { 0., x - 0.7, 112., 0. }, none, { 6e-3, x, 112., 0., 0.3 }, { from, {}, {} }, to, {}, weights, &memory },
          friction, found);
      bed.surface().complete(found);
      return found;
    };
    const auto before = bed.pressed(0.12), begin = bed.pressed(0.1); // at places further back the cylinder lies lower
    auto end = bed.pressed(0.03);
    for (unsigned int port = 0; port < bed.ports.surface; ++port)
      end[port] += 1e-3 * std::sin(1.3 * port);
    const auto memory = step(before, begin, Bed::x - 0.7, {}).memory();
    ASSERT_GT(memory.size(), 50u);
    const auto found = step(begin, end, Bed::x, memory);

    StepContactLaw law;
    law.normal        = { bed.surface().penalties().normal, 1. };
    law.tangential    = bed.surface().penalties().tangential;
    law.friction      = friction;
    law.weights       = weights;
    const auto turned = [&](const dealii::Vector<double> &ports) {
      return bed.ports.slopes > 0 ? AxisSlopes{ { ports[bed.ports.slope(0)], ports[bed.ports.slope(1)] } } : AxisSlopes{};
    };
    const double share = weights.stiffness();
    const auto mixed   = [share](const double a, const double b) { return (1. - share) * a + share * b; };
    const auto hub     = bed.ports.rotation();
    const auto at_end = rigid.pose(Bed::x, end[hub], turned(end)), at_begin = rigid.pose(Bed::x - 0.7, begin[hub], turned(begin));
    AxisSlopes between_slopes{};
    for (unsigned int i = 0; i < 2; ++i)
      between_slopes[i] = mixed(at_begin.turned[i], at_end.turned[i]);
    const auto between = rigid.pose(mixed(at_begin.x, at_end.x), mixed(at_begin.theta, at_end.theta), between_slopes);
    double energy = 0., dissipated = 0., algorithmic = 0., moment = 0.;
    unsigned int pressed = 0;
    for (const auto &state : found.points)
    {
      const auto &point = bed.points()[state.index];
      auto from         = point.position;
      for (const auto &[node, shape] : point.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          from[d] += shape * begin[3 * node + d];
      const auto known =
          std::find_if(memory.begin(), memory.end(), [&](const auto &entry) { return entry.point == state.index; });
      const double gap_begin = rigid.gap(at_begin, from);
      if (state.gap >= 0. && gap_begin >= 0. && known == memory.end())
      {
        EXPECT_EQ(state.pressure, 0.);
        continue;
      }
      const auto placed = rigid.kinematics(at_end, state.position);
      const auto middle = rigid.kinematics(between, from + share * (state.position - from));
      const auto slips  = rigid.slips(at_begin, from);
      StepKinematics<7, 2> kinematics;
      kinematics.gap_begin = gap_begin;
      kinematics.gap_end   = placed.gap;
      kinematics.gap_row   = middle.gap_row;
      dealii::Tensor<1, 7> change;
      for (unsigned int d = 0; d < 3; ++d)
        change[d] = state.position[d] - from[d];
      change[3] = at_end.theta - at_begin.theta;
      change[4] = at_end.x - at_begin.x;
      for (unsigned int i = 0; i < 2; ++i)
        change[5 + i] = at_end.turned[i] - at_begin.turned[i];
      kinematics.gap_bend = change * (middle.gap_curvature * change);
      for (unsigned int s = 0; s < 2; ++s)
      {
        kinematics.slip_change[s] = placed.slip[s] - slips[s] + (s == 0 ? 0.3 : 0.);
        kinematics.slip_row[s]    = middle.slip_row[s];
        kinematics.slip_bend[s]   = change * (middle.slip_curvature[s] * change);
      }
      const auto expected = mean_response(kinematics, known != memory.end() ? *known : SurfaceMemory{}, law);
      const double scale  = 1e-9; // of round-off that stiff springs make of places
      EXPECT_NEAR(state.pressure, expected.pressure, scale);
      EXPECT_LT((state.traction - expected.traction).norm(), scale);
      EXPECT_NEAR(state.mu, expected.mu, scale);
      EXPECT_EQ(state.slipping, expected.slipping);
      EXPECT_LT((state.memory.slip_speed - expected.memory.slip_speed).norm(), 1e3 * scale);
      energy += point.weight * expected.energy;
      dissipated += point.weight * expected.friction;
      algorithmic += point.weight * expected.algorithmic;
      moment += point.weight * expected.force[3];
      pressed += expected.pressure > 0. ? 1 : 0;
    }
    EXPECT_GT(pressed, 50u);
    EXPECT_NEAR(found.stored, energy, 1e-9 * energy);
    EXPECT_NEAR(found.works.friction, dissipated, 1e-9 * std::abs(dissipated));
    EXPECT_NEAR(found.works.algorithmic, algorithmic, 1e-8 * std::abs(algorithmic));
    const auto &forces = found.forces;
    const auto place   = std::find(forces.ports.begin(), forces.ports.end(), hub) - forces.ports.begin();
    EXPECT_NEAR(forces.values[static_cast<unsigned int>(place)], moment, 1e-9 * std::abs(moment));
  }
}
