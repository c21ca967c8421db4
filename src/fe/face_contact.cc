#include "fe/face_contact.h"

#include "laws/friction_of_step.h"
#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  FaceContact::FaceContact(const ElasticBody<2> &body_, std::unique_ptr<StaticSurface> surface_,
                           FaceContactProperties contact_properties)
      : body(body_)
      , surface(std::move(surface_))
      , properties(std::move(contact_properties))
      , multipliers(body_.friction_face())
  {
  }

  FaceConfiguration FaceContact::configuration(const Vector<double> &displacements, const double of_drive) const
  {
    const auto &layout = properties.ports;
    const double theta = properties.rest_inclination + displacements[layout.rotation()];
    const double x     = of_drive - (layout.sprung ? displacements[layout.support()] : 0.);
    return { &displacements, theta, x, properties.centre(x, theta) };
  }

  /// Nothing has been rubbed yet where no step led to the state.
  ContactLaw FaceContact::law_of_step(const double v, const FrictionMode mode) const
  {
    const auto &[normal, tangential] = properties.penalties;
    if (mode == FrictionMode::cone && step_duration == 0.)
      return { normal, tangential, { CoulombFriction{ 0. } }, 1. };
    return { normal, tangential, friction_of_step(properties.friction, v), step_duration };
  }

  /// Travel and ratio as of a rigid lever on a rigid support.
  StaticStep FaceContact::step_to(const DrivePoint &end, const DrivePoint &begin, const FrictionMode mode) const
  {
    constexpr double least_ratio = 1e-6;
    StaticStep step{ start, law_of_step(end.v, mode), mode, properties.enforcement == Enforcement::augmented_lagrangian };
    if (!properties.geometry || end.x == begin.x || step_duration == 0.)
      return step;
    const auto &geometry = *properties.geometry;
    const auto from      = kinematics(geometry, begin.x);
    const auto to        = kinematics(geometry, end.x);
    step.travel          = to.s - from.s;
    const double slid    = -step.travel - geometry.cylinder_radius * (to.theta - from.theta);
    step.speed_ratio     = std::max(least_ratio, sliding_speed(geometry, end.x, end.v) * step_duration / slid);
    step.law.dt /= step.speed_ratio;
    return step;
  }

  void FaceContact::evaluate(const Vector<double> &displacements, const State &trial, const State &accepted,
                             const FrictionMode mode)
  {
    ports           = displacements;
    drive_x         = trial.drive.x;
    start           = trial.contact;
    step_duration   = trial.drive.time - accepted.drive.time;
    const auto step = step_to(trial.drive, accepted.drive, mode);
    surface->enter(configuration(ports, drive_x));
    states.clear();
    patches.clear();
    for (const unsigned int patch : surface->near())
      surface->evaluate(patch, step, states, patches);
    sum_forces();
  }

  void FaceContact::list_ports()
  {
    summed.ports.clear();
    for (unsigned int port = properties.ports.rotation(); port < properties.ports.size(); ++port)
      summed.ports.push_back(port);
    for (const auto &patch : patches)
      summed.ports.insert(summed.ports.end(), patch.ports.begin(), patch.ports.end());
    std::sort(summed.ports.begin(), summed.ports.end());
    summed.ports.erase(std::unique(summed.ports.begin(), summed.ports.end()), summed.ports.end());
  }

  void FaceContact::sum_forces()
  {
    list_ports();
    const auto n = static_cast<unsigned int>(summed.ports.size());
    summed.values.reinit(n);
    summed.tangent.reinit(n, n);
    std::vector<unsigned int> places;
    for (const auto &patch : patches)
    {
      places.clear();
      for (const unsigned int port : patch.ports)
        places.push_back(place_of(port, summed.ports));
      for (unsigned int i = 0; i < places.size(); ++i)
      {
        summed.values[places[i]] += patch.values[i];
        for (unsigned int j = 0; j < places.size(); ++j)
          summed.tangent(places[i], places[j]) += patch.tangent(i, j);
      }
    }
  }

  const PortForces &FaceContact::forces() const
  {
    return summed;
  }

  double FaceContact::penetration() const
  {
    double largest = 0.;
    for (const auto &state : states)
      largest = std::max(largest, -state.gap);
    return largest;
  }

  double FaceContact::unaugmented_overlap() const
  {
    const auto pressures = multipliers.averaged(states, &ContactResponse<4>::pressure);
    double largest       = 0.;
    for (std::size_t a = 0; a < states.size(); ++a)
      largest = std::max(largest, std::abs(pressures[a] - start[states[a].index].normal_multiplier));
    return largest / properties.penalties.normal;
  }

  double FaceContact::overlap() const
  {
    double largest = 0.;
    for (const auto &state : states)
      largest = std::max(largest, state.response.pressure / properties.penalties.normal);
    return largest;
  }

  void FaceContact::augment(std::vector<ContactMemory> &memory) const
  {
    for (auto &point : memory)
      point.normal_multiplier = point.traction = 0.;
    const auto pressures = multipliers.averaged(states, &ContactResponse<4>::pressure);
    const auto tractions = multipliers.averaged(states, &ContactResponse<4>::traction);
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      memory[states[a].index].normal_multiplier = pressures[a];
      memory[states[a].index].traction          = tractions[a];
    }
  }

  std::vector<ContactMemory> FaceContact::memory() const
  {
    std::vector<ContactMemory> result(start.size());
    if (properties.enforcement == Enforcement::augmented_lagrangian)
      augment(result);
    else
      for (const auto &state : states)
        result[state.index].traction = state.response.traction;
    set_slips(configuration(ports, drive_x), result);
    return result;
  }

  void FaceContact::set_slips(const FaceConfiguration &at, std::vector<ContactMemory> &memory) const
  {
    surface->enter(at);
    for (unsigned int patch = 0; patch < body.friction_face().patches.size(); ++patch)
    {
      const auto slips = surface->slips(patch);
      for (unsigned int q = 0; q < slips.size(); ++q)
        memory[body.friction_face().patches[patch].begin + q].slip = slips[q];
    }
  }

  std::vector<ContactMemory> FaceContact::untouched(const Vector<double> &displacements, const double x) const
  {
    std::vector<ContactMemory> result(body.friction_face().points.size());
    set_slips(configuration(displacements, x), result);
    return result;
  }

  std::string FaceContact::objection() const
  {
    return surface->objection();
  }

  const ContactPenalties &FaceContact::penalties() const
  {
    return properties.penalties;
  }

  const std::vector<FaceContact::PointState> &FaceContact::points() const
  {
    return states;
  }

  const Vector<double> &FaceContact::displacements() const
  {
    return ports;
  }

  double FaceContact::duration() const
  {
    return step_duration;
  }

  const ElasticBody<2> &FaceContact::elastic_body() const
  {
    return body;
  }
} // namespace sprag
