#include "fe/solid/surface_sums.h"

#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    const std::vector<SurfaceMemory> no_memory;

    const SurfaceMemory *memory_of(const std::vector<SurfaceMemory> &memory, const unsigned int point)
    {
      const auto is_before = [](const SurfaceMemory &entry, const unsigned int q) { return entry.point < q; };
      const auto found     = std::lower_bound(memory.begin(), memory.end(), point, is_before);
      return found != memory.end() && found->point == point ? &*found : nullptr;
    }

    /// Forgets what was found, and keeps the memory for what follows.
    void clear(SurfaceEvaluation &found)
    {
      auto points = std::move(found.points);
      auto forces = std::move(found.forces);
      points.clear();
      found        = SurfaceEvaluation();
      found.points = std::move(points);
      found.forces = std::move(forces);
    }

    template <int n>
    Tensor<1, n> force_of(const PointTraction<2> &traction, const SurfaceKinematicsIn<n> &placed)
    {
      auto result = traction.pressure * placed.gap_row;
      for (unsigned int s = 0; s < 2; ++s)
        result -= traction.traction[s] * placed.slip_row[s];
      return result;
    }
  } // namespace

  /// What evaluates one patch of a step in time after another.
  struct SurfaceContact::StepInTime
  {
    RigidCylinder::Pose end;
    RigidCylinder::Pose balance; ///< where forces are balanced
    double share;                ///< of the step until there
    double surface_run;
    StepContactLaw law;
    const std::vector<SurfaceMemory> &memory;
    double advance; ///< of the drive [mm]
  };

  /// What evaluates one patch of steady sliding after another.
  struct SurfaceContact::Sliding
  {
    const SlidingState &state;
    const FrictionLaw law;
    RigidCylinder::Pose pose;
    bool in_parts;          ///< whether the tangent is wanted in parts
    Patches::Nodal rates{}; ///< of the patch
    Sums pressure{};        ///< with the forces of the patch
    Sums friction{};
    Sums friction_rate{};                  ///< in parts alone
    std::vector<PortPerturbation> parts{}; ///< of the patches
  };

  void SurfaceContact::evaluate(const PortStep &of, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    const bool is_first = begin_ports.size() != of.begin.position.size();
    if (is_first || begin_x != of.from.x || begin_ports != of.begin.position)
      begin_step({ of.begin.position, of.from.x });
    StepContactLaw law;
    law.normal     = { properties.penalties.normal, 1. };
    law.tangential = properties.penalties.tangential;
    law.friction   = friction_of_step(friction, of.to.v);
    law.weights    = of.weights;
    const SurfacePlace place{ of.end, of.to.x };
    const auto end      = pose_of(place);
    const double share  = of.weights.stiffness();
    const auto balanced = [share](const double a, const double b) { return (1. - share) * a + share * b; };
    const StepInTime step{ end,
                           properties.cylinder.pose(balanced(begin_pose.x, end.x), balanced(begin_pose.theta, end.theta),
                                                    { { balanced(begin_pose.turned[0], end.turned[0]),
                                                        balanced(begin_pose.turned[1], end.turned[1]) } }),
                           share,
                           of.to.surface - of.from.surface,
                           law,
                           of.surface_memory != nullptr ? *of.surface_memory : no_memory,
                           of.to.x - of.from.x };

    clear(found);
    found.displacement = of.end;
    found.x            = of.to.x;
    found.duration     = of.weights.dt;
    auto looked_at     = united(near(place, end), near({ begin_ports, begin_x }, begin_pose));
    Patches::Indices remembered;
    for (const auto &entry : step.memory)
      if (remembered.empty() || entry.point >= patches.patches[remembered.back()].end)
        remembered.push_back(patches.patch_of_point(entry.point));
    std::vector<PortForces> loaded;
    for (const unsigned int patch : clip(united(looked_at, remembered), found))
    {
      const auto nodal = Patches::nodal(patches.patches[patch], of.end);
      Sums sums;
      for (unsigned int q = patches.patches[patch].begin; q < patches.patches[patch].end; ++q)
        evaluate_point(step, add_point(patch, q, nodal, end, found), sums, found);
      add_patch(patch, sums, loaded);
    }
    sum_forces(loaded, place_of_port, found.forces);
    found.beyond_face = reaches_end(found);
  }

  bool SurfaceContact::reaches_end(const SurfaceEvaluation &found) const
  {
    return std::any_of(found.points.begin(), found.points.end(),
                       [&](const auto &point) { return point.pressure > 0. && is_at_end[point.patch]; });
  }

  template <int n>
  void SurfaceContact::evaluate_in(const StepInTime &step, FacePointState<3> &state, Sums &sums, SurfaceEvaluation &found) const
  {
    const auto &begin       = at_begin_of(state.patch)[state.index - patches.patches[state.patch].begin];
    const auto *const known = memory_of(step.memory, state.index);
    if (state.gap >= 0. && begin.gap >= 0. && known == nullptr)
      return;
    found.compression  = std::max(found.compression, -std::min(state.gap, begin.gap));
    const auto placed  = properties.cylinder.kinematics<n>(step.end, state.position);
    const auto moved   = state.position - begin.position;
    const auto between = properties.cylinder.kinematics<n>(step.balance, begin.position + step.share * moved, false);
    Tensor<1, n> change;
    for (unsigned int d = 0; d < 3; ++d)
      change[d] = moved[d];
    change[3] = step.end.theta - begin_pose.theta;
    change[4] = step.end.x - begin_pose.x;
    for (unsigned int i = 5; i < n; ++i)
      change[i] = step.end.turned[i - 5] - begin_pose.turned[i - 5];

    StepKinematics<n, 2> kinematics;
    kinematics.gap_begin     = begin.gap;
    kinematics.gap_end       = placed.gap;
    kinematics.gap_row_end   = placed.gap_row;
    kinematics.gap_row       = between.gap_row;
    kinematics.gap_curvature = step.share * between.gap_curvature;
    kinematics.gap_bend      = change * (between.gap_curvature * change);
    for (unsigned int s = 0; s < 2; ++s)
    {
      kinematics.slip_change[s]     = placed.slip[s] - begin.slips[s] + (s == 0 ? step.surface_run : 0.);
      kinematics.slip_change_row[s] = placed.slip_row[s];
      kinematics.slip_row[s]        = between.slip_row[s];
      kinematics.slip_curvature[s]  = step.share * between.slip_curvature[s];
      kinematics.slip_bend[s]       = change * (between.slip_curvature[s] * change);
    }
    const SurfaceMemory memory = known != nullptr ? *known : SurfaceMemory{};
    const auto response        = step_response(kinematics, memory, step.law);

    static_cast<PointTraction<2> &>(state) = response;
    state.memory.point                     = state.index;
    state.slip_change                      = kinematics.slip_change;
    state.elastic_slip                     = response.traction.norm() / step.law.tangential;
    state.end_force                        = on_lever(force_of(response, placed));
    const auto &point                      = patches.points[state.index];
    found.stored += point.weight * response.energy;
    found.works.drive += point.weight * (response.mean_traction[0] * step.surface_run - response.force[4] * step.advance);
    found.works.friction += point.weight * response.friction;
    found.works.algorithmic += point.weight * response.algorithmic;
    found.works.creep = std::max(found.works.creep, response.creep);
    sums.add(point, response.force, response.tangent);
  }

  void SurfaceContact::slide(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    Sliding slide{ sliding, friction_of_step(friction, sliding.drive.v), pose_of({ sliding.ports, sliding.drive.x }), false };
    this->slide(slide, found);
  }

  PortPerturbation SurfaceContact::linearise(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    Sliding slide{ sliding, friction_of_step(friction, sliding.drive.v), pose_of({ sliding.ports, sliding.drive.x }), true };
    this->slide(slide, found);
    PortPerturbation result(found.forces.ports);
    for (const auto &of_patch : slide.parts)
      result.add(of_patch);
    return result;
  }

  void SurfaceContact::slide(Sliding &sliding, SurfaceEvaluation &found)
  {
    const SurfacePlace place{ sliding.state.ports, sliding.state.drive.x };
    clear(found);
    found.displacement = place.ports;
    found.x            = place.x;
    found.duration     = 1.; // slips are those of a second
    std::vector<PortForces> loaded;
    for (const unsigned int patch : clip(near(place, sliding.pose), found))
    {
      const auto nodal = Patches::nodal(patches.patches[patch], place.ports);
      if (sliding.state.rates != nullptr)
        sliding.rates = Patches::nodal(patches.patches[patch], *sliding.state.rates);
      sliding.pressure = sliding.friction = sliding.friction_rate = {};
      for (unsigned int q = patches.patches[patch].begin; q < patches.patches[patch].end; ++q)
        slide_point(sliding, add_point(patch, q, nodal, sliding.pose, found), found);
      if (!sliding.pressure.touched)
        continue;
      if (sliding.in_parts)
      {
        const auto coordinates = coordinates_of(patch);
        auto &part             = sliding.parts.emplace_back(ports_of(coordinates));
        part.pressure          = matrix_on_ports(coordinates, sliding.pressure.tangent);
        part.friction          = matrix_on_ports(coordinates, sliding.friction.tangent);
        part.friction_rate     = matrix_on_ports(coordinates, sliding.friction_rate.tangent);
      }
      sliding.pressure.tangent += sliding.friction.tangent;
      add_patch(patch, sliding.pressure, loaded);
    }
    sum_forces(loaded, place_of_port, found.forces);
    found.beyond_face = reaches_end(found);
  }

  void SurfaceContact::slide_point(Sliding &sliding, FacePointState<3> &state, SurfaceEvaluation &found) const
  {
    if (properties.ports.slopes > 0)
      slide_in<SurfaceKinematics::n>(sliding, state, found);
    else
      slide_in<FixedSurfaceKinematics::n>(sliding, state, found);
  }

  template <int n>
  void SurfaceContact::slide_in(Sliding &sliding, FacePointState<3> &state, SurfaceEvaluation &found) const
  {
    if (state.gap >= 0.)
      return;
    found.compression    = std::max(found.compression, -state.gap);
    const auto &point    = patches.points[state.index];
    const auto &of       = sliding.state;
    const auto &penalty  = properties.penalties;
    const bool slides    = of.friction == ContactFriction::sliding;
    const auto placed    = properties.cylinder.kinematics<n>(sliding.pose, state.position);
    const double area    = point.weight;
    const auto direction = slip_rates(sliding, point, placed, state);
    const double speed   = state.slip_change.norm();
    const auto share     = slides ? sliding_friction(sliding.law, speed) : SlidingFriction{};

    state.pressure          = state.trial_pressure;
    state.traction          = share.coefficient * state.pressure * direction;
    state.mu                = slides ? friction_coefficient(sliding.law, speed).coefficient : 0.;
    state.slipping          = slides;
    state.memory.traction   = state.traction;
    state.memory.slip_speed = state.slip_change;
    state.memory.point      = state.index;
    state.elastic_slip      = state.traction.norm() / penalty.tangential;
    const auto force        = force_of(state, placed);
    state.end_force         = on_lever(force);
    const double elastic = sliding.law.regularisation_speed > 0. ? 0. : 0.5 * state.traction.norm_square() / penalty.tangential;
    found.stored += area * (0.5 * penalty.normal * state.gap * state.gap + elastic);

    const auto by_pressure =
        -penalty.normal * outer_product(placed.gap_row, placed.gap_row) + state.pressure * placed.gap_curvature;
    Tensor<2, n> by_displacement, by_rate;
    for (unsigned int s = 0; s < 2; ++s)
    {
      by_displacement += outer_product(placed.slip_row[s], share.coefficient * direction[s] * penalty.normal * placed.gap_row) -
                         state.traction[s] * placed.slip_curvature[s];
      if (of.friction == ContactFriction::stuck)
        by_displacement -= penalty.tangential * outer_product(placed.slip_row[s], placed.slip_row[s]);
      for (unsigned int r = 0; r < 2 && slides && sliding.in_parts; ++r)
      {
        const double along = direction[s] * direction[r];
        const double turn  = speed > 0. ? share.coefficient / speed * ((s == r ? 1. : 0.) - along) : 0.;
        by_rate -= state.pressure * (share.derivative * along + turn) * outer_product(placed.slip_row[s], placed.slip_row[r]);
      }
    }
    sliding.pressure.add(point, force, by_pressure);
    sliding.friction.add(point, Tensor<1, n>(), by_displacement);
    if (sliding.in_parts)
      sliding.friction_rate.add(point, Tensor<1, n>(), by_rate);
  }

  /// Sets the slip rates of a point and returns their direction; of speed 0 its sign counts.
  template <int n>
  Tensor<1, 2> SurfaceContact::slip_rates(const Sliding &sliding, const Patches::Point &point,
                                          const SurfaceKinematicsIn<n> &placed, FacePointState<3> &state) const
  {
    state.slip_change    = Tensor<1, 2>();
    state.slip_change[0] = sliding.state.speed;
    if (const auto *const rates = sliding.state.rates; rates != nullptr)
    {
      const auto moved = Patches::position(point, sliding.rates) - point.position;
      for (unsigned int s = 0; s < 2; ++s)
        state.slip_change[s] += along(placed.slip_row[s], moved, *rates);
    }
    if (state.slip_change.norm() > 0.)
      return state.slip_change / state.slip_change.norm();
    return Tensor<1, 2>({ std::copysign(1., sliding.state.speed), 0. });
  }

  void SurfaceContact::touch(const SurfacePlace &place, SurfaceEvaluation &found)
  {
    const auto pose = pose_of(place);
    clear(found);
    found.displacement = place.ports;
    found.x            = place.x;
    for (const unsigned int patch : near(place, pose))
    {
      const auto nodal = Patches::nodal(patches.patches[patch], place.ports);
      for (unsigned int q = patches.patches[patch].begin; q < patches.patches[patch].end; ++q)
        add_point(patch, q, nodal, pose, found);
    }
  }

  std::array<double, 2> SurfaceContact::change_at(const FacePointState<3> &point, const SurfaceEvaluation &found,
                                                  const Vector<double> &change_of_ports) const
  {
    const auto pose   = pose_of({ found.displacement, found.x });
    const auto placed = properties.cylinder.kinematics(pose, point.position);
    const auto &of    = patches.points[point.index];
    const auto nodal  = Patches::nodal(patches.patches[point.patch], change_of_ports);
    const auto moved  = Patches::position(of, nodal) - of.position;
    return { { along(placed.gap_row, moved, change_of_ports), along(placed.slip_row[0], moved, change_of_ports) } };
  }

  /// A row times a motion of its point and of the ports of the frame.
  template <int n>
  double SurfaceContact::along(const Tensor<1, n> &row, const Tensor<1, 3> &moved, const Vector<double> &of_ports) const
  {
    const auto &at = properties.ports;
    double result  = row[3] * of_ports[at.rotation()] - (at.sprung ? row[4] * of_ports[at.support()] : 0.);
    for (unsigned int d = 0; d < 3; ++d)
      result += row[d] * moved[d];
    for (unsigned int i = 0; i < at.slopes && 5 + i < n; ++i)
      result += row[5 + i] * of_ports[at.slope(i)];
    return result;
  }

  double SurfaceContact::slip_at(const FacePointState<3> &point, const SurfacePlace &place) const
  {
    const auto nodal = Patches::nodal(patches.patches[point.patch], place.ports);
    return properties.cylinder.slips(pose_of(place), Patches::position(patches.points[point.index], nodal))[0];
  }
} // namespace sprag
