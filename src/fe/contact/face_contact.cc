// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using dealii::Vector;

  void FaceContact::observe(const FaceEvaluation<2> &found, Row &row, unsigned int) const
  {
    view.observe(found, row);
    row[Column::Q]           = drive_force(found);
    row[Column::indentation] = indentation(body.friction_face(), found, row, properties.layer_thickness);
  }

  SurfaceShape FaceContact::surface_shape(const dealii::Vector<double> &displacements, unsigned int) const
  {
    SurfaceShape shape;
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int node = 0; node < nodes.size(); ++node)
    {
      shape.xi.push_back(nodes[node].position[0]);
      shape.along.push_back(displacements[2 * node]);
      shape.across.push_back(displacements[2 * node + 1]);
    }
    return shape;
  }

  namespace
  {
    std::variant<RigidObstacle, ElasticObstacle> make_obstacle(const ElasticBody<2> &body, const FacePatches<2> &face,
                                                               const FaceContactProperties &properties)
    {
      using Obstacles = std::variant<RigidObstacle, ElasticObstacle>;
      if (body.cylinder_face().patches.empty())
        return Obstacles(std::in_place_type<RigidObstacle>, body.friction_face(), face, properties);
      return Obstacles(std::in_place_type<ElasticObstacle>, body.friction_face(), body.cylinder_face(), face, properties);
    }
  } // namespace

  FaceContact::FaceContact(const ElasticBody<2> &body_, FaceContactProperties properties_)
      : body(body_)
      , properties(std::move(properties_))
      , face(body.friction_face())
      , view(body.friction_face(), face)
      , obstacle(make_obstacle(body, face, properties))
      , port_places(properties.ports.size())
  {
  }

  void FaceContact::enter(const StepPlaces &places) const
  {
    std::visit([&](auto &below) { below.enter(places); }, obstacle);
  }

  FacePatches<2>::Indices FaceContact::near() const
  {
    return std::visit([](const auto &below) { return below.near(); }, obstacle);
  }

  FaceConfiguration FaceContact::configuration(const Vector<double> &ports, const double x) const
  {
    const double inclination = properties.rest_inclination + ports[properties.ports.rotation()];
    const double relative    = x - (properties.ports.sprung ? ports[properties.ports.support()] : 0.);
    return { &ports, inclination, relative, properties.centre(relative, inclination) };
  }

  namespace
  {
    StepContactLaw step_law(const FaceContactProperties &properties, const PortStep &step,
                            const std::optional<StaticTerms> &statics)
    {
      StepContactLaw law;
      law.normal = { properties.penalties.normal, 1. };
      law.slip =
          slip_law(statics ? statics->friction : step_friction(properties.friction, step.to.v), properties.penalties.tangential);
      law.weights = step.weights;
      if (statics)
      {
        law.balance    = ForceBalance::end;
        law.mode       = statics->mode;
        law.weights.dt = statics->duration;
      }
      return law;
    }
  } // namespace

  template <class PatchVisitor>
  void FaceContact::visit_patches(const FacePatches<2>::Indices &patches, const PatchVisitor &visit_patch) const
  {
    std::visit(
        [&](auto &below)
        {
          for (const unsigned int patch : patches)
          {
            below.enter(patch);
            visit_patch(below, patch);
          }
        },
        obstacle);
  }

  void FaceContact::evaluate(const PortStep &step, FaceEvaluation<2> &found, const std::optional<StaticTerms> &statics) const
  {
    found.begin(step.end, step.to.x, step.weights.dt);
    FaceStep face_step{ step_law(properties, step, statics), step.memory, step.to.surface - step.from.surface };
    if (statics)
    {
      face_step.augmented   = statics->augmented;
      face_step.travel      = statics->travel;
      face_step.speed_ratio = statics->speed_ratio;
    }
    enter({ configuration(step.begin.position, step.from.x), configuration(step.end, step.to.x), step.weights.stiffness(),
            statics.has_value() });
    visit_patches(near_step(step.memory, face_step.law.balance, found),
                  [&](auto &below, const unsigned int patch) { step_patch(below, patch, face_step, found); });
    sum_forces(found.sums.loaded, port_places, found.forces);
    found.sums.work.drive -= found.sums.force_on_obstacle * (step.to.x - step.from.x);
  }

  /// Finds the patches of a step. Where forces are means over the step, those in contact when it began belong to them.
  FacePatches<2>::Indices FaceContact::near_step(const std::vector<ContactMemory> &memory, const ForceBalance balance,
                                                 FaceEvaluation<2> &found) const
  {
    auto patches = near();
    if (balance != ForceBalance::end)
      patches = united(patches, touched_patches(face, memory));
    return reach.clip(std::move(patches), found.within_reach);
  }

  FacePointState<2> &FaceContact::add_point(const unsigned int patch, const unsigned int point, FaceEvaluation<2> &found)
  {
    FacePointState<2> &state = found.points.emplace_back();
    state.index              = point;
    state.patch              = patch;
    return state;
  }

  template <class ObstacleBelow>
  void FaceContact::step_patch(ObstacleBelow &below, const unsigned int patch, const FaceStep &step,
                               FaceEvaluation<2> &found) const
  {
    const double penalty    = properties.penalties.normal;
    const bool ends_balance = step.law.balance == ForceBalance::end;
    auto remembered         = first_memory(step.memory, face.patches[patch].begin);
    for (unsigned int q = face.patches[patch].begin; q < face.patches[patch].end; ++q)
    {
      auto &state            = add_point(patch, q, found);
      const bool can_touch   = below.place(state);
      const bool has_memory  = remembered != step.memory.end() && remembered->point == q;
      const auto memory      = has_memory ? *remembered++ : ContactMemory{};
      state.trial_pressure   = (can_touch ? memory.normal_multiplier : 0.) - penalty * state.gap;
      const double begin_gap = ends_balance ? state.gap : below.gap_at_begin(q);
      const bool stays_open  = ends_balance ? state.trial_pressure <= 0. : state.gap >= 0. && begin_gap >= 0. && !has_memory;
      if (stays_open)
        continue;
      found.sums.compression =
          std::max(found.sums.compression, ends_balance ? state.trial_pressure / penalty : -std::min(state.gap, begin_gap));
      below.step(state, memory, step, found.sums);
    }
    below.leave(found.sums);
  }

  void FaceContact::evaluate_sliding(const SlidingState &state, FaceEvaluation<2> &found) const
  {
    slide(state, false, found);
  }

  PortPerturbation FaceContact::linearise(const SlidingState &state, FaceEvaluation<2> &found) const
  {
    slide(state, true, found);
    PortPerturbation result(found.forces.ports);
    for (const auto &patch_sum : found.sums.parts)
      result.add(patch_sum);
    found.forces.tangent = result.stiffness();
    return result;
  }

  void FaceContact::slide(const SlidingState &sliding, const bool in_parts, FaceEvaluation<2> &found) const
  {
    found.begin(sliding.ports, sliding.drive.x, 1.); // slip in a second
    found.sums.in_parts = in_parts;
    const auto at       = configuration(sliding.ports, sliding.drive.x);
    enter({ at, at });
    const auto law = slide_friction(properties.friction, sliding);
    visit_patches(reach.clip(near(), found.within_reach),
                  [&](auto &below, const unsigned int patch)
                  {
                    for (unsigned int q = face.patches[patch].begin; q < face.patches[patch].end; ++q)
                    {
                      auto &state = add_point(patch, q, found);
                      below.place(state);
                      state.trial_pressure = -properties.penalties.normal * state.gap;
                      state.slip_change[0] = sliding.speed;
                      if (state.gap < 0.)
                        below.slide(state, sliding, law, found.sums);
                    }
                    below.leave(found.sums);
                  });
    sum_forces(found.sums.loaded, port_places, found.forces);
  }

  const PortSelection &FaceContact::reachable_ports(const double x, const PerLever &inclinations, const double travel)
  {
    const double radius_limit  = properties.radius > 0. ? 0.05 * properties.radius : std::numeric_limits<double>::infinity();
    const double near_distance = reach.factor * radius_limit + std::abs(travel);
    const double aside         = 4. * properties.layer_thickness; // where the face is looked at besides
    const double xi            = properties.centre(x, inclinations.front()).xi;
    const auto patches_within  = [&](const double distance)
    {
      constexpr double infinity = std::numeric_limits<double>::max();
      return face.patches_in({ { { xi - distance, -infinity }, { xi + distance, infinity } } });
    };
    reach.set(face, patches_within(near_distance), patches_within(near_distance + aside),
              2 * static_cast<unsigned int>(body.friction_face().nodes.size()), properties.ports.size());
    return reach.ports;
  }

  std::vector<ContactMemory> FaceContact::touch(const Vector<double> &ports, const DrivePoint &drive,
                                                FaceEvaluation<2> &found) const
  {
    found.begin(ports, drive.x, 0.);
    const auto at = configuration(ports, drive.x);
    enter({ at, at });
    visit_patches(near(),
                  [&](auto &below, const unsigned int patch)
                  {
                    for (unsigned int q = face.patches[patch].begin; q < face.patches[patch].end; ++q)
                      below.place(add_point(patch, q, found));
                  });
    sum_forces(found.sums.loaded, port_places, found.forces);
    return {};
  }

  namespace
  {
    /// Returns the point in the middle of those under pressure, or the closest one if there are none.
    const FacePointState<2> &contact_middle(const std::vector<FacePointState<2>> &points)
    {
      const auto is_closed = [](const auto &point) { return point.pressure > 0.; };
      const auto first     = std::find_if(points.begin(), points.end(), is_closed);
      const auto last      = std::find_if(points.rbegin(), points.rend(), is_closed);
      if (first != points.end())
        return points[((first - points.begin()) + (points.rend() - last - 1)) / 2];
      return *std::min_element(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.gap < b.gap; });
    }
  } // namespace

  double FaceContact::gap_change(const FaceEvaluation<2> &found, const Vector<double> &port_change, unsigned int) const
  {
    const auto at = configuration(found.displacement, found.x);
    enter({ at, at });
    const auto &point = contact_middle(found.points);
    double change     = 0.;
    visit_patches({ point.patch },
                  [&](auto &below, unsigned int)
                  {
                    const auto rows = below.rows(point);
                    for (unsigned int i = 0; i < rows.ports.size(); ++i)
                      change += rows.gap[i] * port_change[rows.ports[i]];
                  });
    return change;
  }

  double FaceContact::mean_slip(const FaceEvaluation<2> &found, const Vector<double> &from, const double from_x,
                                const Vector<double> &to, const double to_x) const
  {
    enter({ configuration(from, from_x), configuration(to, to_x) });
    double weighted = 0.;
    double weights  = 0.;
    std::visit(
        [&](auto &below)
        {
          unsigned int patch = dealii::numbers::invalid_unsigned_int;
          for (const auto &point : found.points)
            if (point.pressure > 0.)
            {
              if (point.patch != patch)
                below.enter(patch = point.patch);
              const double weight = face.points[point.index].weight * point.pressure;
              weighted += weight * below.slip(point);
              weights += weight;
            }
        },
        obstacle);
    return weights > 0. ? weighted / weights : 0.;
  }
} // namespace sprag
