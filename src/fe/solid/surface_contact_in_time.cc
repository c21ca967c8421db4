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

  StepInLanes::Constants SurfaceContact::constants_of(const PortStep &of, const FrictionLaw &friction) const
  {
    auto result                     = constants();
    result.law.friction             = friction_of_step(friction, of.to.v);
    result.law.weights              = of.weights;
    result.begin                    = begin_pose;
    result.end                      = pose_of({ of.end, of.to.x });
    result.share                    = of.weights.stiffness();
    const auto &[begin, end, share] = std::tie(result.begin, result.end, result.share);
    const auto balanced             = [&](const double a, const double b) { return (1. - share) * a + share * b; };
    result.balance =
        properties.cylinder.pose(balanced(begin.x, end.x), balanced(begin.theta, end.theta),
                                 { { balanced(begin.turned[0], end.turned[0]), balanced(begin.turned[1], end.turned[1]) } });
    result.surface_run = of.to.surface - of.from.surface;
    result.advance     = of.to.x - of.from.x;
    return result;
  }

  void SurfaceContact::evaluate(const PortStep &of, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    if (of.wanted == Wanted::tangent_of_last)
      return set_forces(of.wanted, found.forces);
    const auto &memory  = of.surface_memory != nullptr ? *of.surface_memory : no_memory;
    const bool is_first = begin_ports.size() != of.begin.position.size();
    if (is_first || begin_x != of.from.x || begin_ports != of.begin.position || !in_lanes.begins_with(memory))
    {
      begin_step({ of.begin.position, of.from.x });
      in_lanes.begin(memory);
      looked_at_first = united(near({ begin_ports, begin_x }, begin_pose), patches_of(memory));
    }
    const auto step = constants_of(of, friction);
    in_lanes.set(step);

    found.displacement = of.end;
    found.x            = of.to.x;
    found.duration     = of.weights.dt;
    found.compression  = 0.;
    looked_at          = clip(united(near({ of.end, of.to.x }, step.end), looked_at_first), found);
    place_patches(of.begin.position);
    press_patches(of.end, found);
    set_forces(of.wanted, found.forces);
  }

  void SurfaceContact::place_patches(const Vector<double> &begin)
  {
    for (const unsigned int patch : looked_at)
      if (!in_lanes.is_placed(patch))
        in_lanes.place(patch, Patches::nodal(patches.patches[patch], begin));
  }

  /// Presses the patches that are looked at, which are placed.
  void SurfaceContact::press_patches(const Vector<double> &end, SurfaceEvaluation &found)
  {
    pressed.clear();
    Patches::Indices touched;
    for (const unsigned int patch : looked_at)
    {
      auto &forces = pressed.emplace_back();
      if (in_lanes.press(patch, Patches::nodal(patches.patches[patch], end), forces, found.compression))
        touched.push_back(patch);
      else
        pressed.pop_back();
    }
    find_summed(std::move(touched));
  }

  SurfaceContact::Patches::Indices SurfaceContact::patches_of(const std::vector<SurfaceMemory> &memory) const
  {
    Patches::Indices result;
    for (const auto &entry : memory)
      if (result.empty() || entry.point >= patches.patches[result.back()].end)
        result.push_back(patches.patch_of_point(entry.point));
    return result;
  }

  /// The ports of some patches and the places of their coordinates among these are found again where the patches change alone.
  void SurfaceContact::find_summed(Patches::Indices touched)
  {
    if (touched == summed.patches)
      return;
    summed = { std::move(touched), {}, {} };
    for (const unsigned int patch : summed.patches)
    {
      summed.coordinates.push_back(coordinates_of(patch));
      const auto ports = ports_of(summed.coordinates.back());
      summed.ports.insert(summed.ports.end(), ports.begin(), ports.end());
    }
    std::sort(summed.ports.begin(), summed.ports.end());
    summed.ports.erase(std::unique(summed.ports.begin(), summed.ports.end()), summed.ports.end());
    for (auto &coordinates : summed.coordinates)
      for (auto &coordinate : coordinates)
        coordinate.port = place_of(coordinate.port, summed.ports);
  }

  /// From the patches that were pressed last.
  void SurfaceContact::set_forces(const Wanted wanted, PortForces &forces) const
  {
    forces.has_tangent = wanted != Wanted::forces;
    forces.tangent.reinit(0, 0);
    forces.ports = summed.ports;
    forces.values.reinit(static_cast<unsigned int>(summed.ports.size()));
    for (unsigned int i = 0; i < summed.patches.size(); ++i)
      for (const auto &[index, place, sign] : summed.coordinates[i])
        forces.values[place] += sign * pressed[i][index];
    if (forces.has_tangent)
      add_tangent(forces);
  }

  void SurfaceContact::add_tangent(PortForces &forces) const
  {
    const auto n = static_cast<unsigned int>(summed.ports.size());
    forces.tangent.reinit(n, n);
    for (unsigned int i = 0; i < summed.patches.size(); ++i)
    {
      const auto tangent = in_lanes.tangent(summed.patches[i]);
      for (const auto &row : summed.coordinates[i])
        for (const auto &column : summed.coordinates[i])
          forces.tangent(row.port, column.port) += row.sign * column.sign * tangent[row.index][column.index];
    }
  }

  void SurfaceContact::slide(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    if (sliding.wanted == Wanted::tangent_of_last)
      return set_forces(sliding.wanted, found.forces);
    if (sliding.rates == nullptr && sliding.friction != ContactFriction::stuck)
      return slide_in_lanes(sliding, friction, found);
    Sliding slide{ sliding, friction_of_step(friction, sliding.drive.v), pose_of({ sliding.ports, sliding.drive.x }), false };
    this->slide(slide, found);
  }

  /// A step that is balanced where it ends, and ends where it begins.
  void SurfaceContact::slide_in_lanes(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found)
  {
    const auto law    = friction_of_step(friction, sliding.drive.v);
    const bool rubs   = sliding.friction == ContactFriction::sliding;
    const auto pose   = pose_of({ sliding.ports, sliding.drive.x });
    const double keep = law.regularisation_speed > 0. ? 0. : 1. / properties.penalties.tangential;
    auto step         = constants();
    step.begin = step.balance = step.end = pose;
    step.share                           = step.law.weights.stiffness();
    step.slide                           = { sliding.speed, rubs ? sliding_friction(law, sliding.speed).coefficient : 0.,
                   rubs ? friction_coefficient(law, std::abs(sliding.speed)).coefficient : 0., rubs, keep };
    in_lanes.set(step);
    clear(found);
    found.displacement = sliding.ports;
    found.x            = sliding.drive.x;
    found.duration     = 1.; // slips are those of a second
    looked_at          = clip(near({ sliding.ports, sliding.drive.x }, pose), found);
    in_lanes.begin({});
    place_patches(sliding.ports);
    press_patches(sliding.ports, found);
    set_forces(sliding.wanted, found.forces);
    if (sliding.wanted == Wanted::with_tangent)
      complete(found);
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
