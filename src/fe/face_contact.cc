#include "fe/face_contact.h"

#include "laws/friction_of_step.h"
#include "scene/closed_form.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    void make_set(std::vector<unsigned int> &numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }
  } // namespace

  FaceContact::FaceContact(const ElasticBody<2> &body_, std::unique_ptr<StaticSurface> surface_,
                           FaceContactProperties contact_properties)
      : body(body_)
      , surface(std::move(surface_))
      , properties(std::move(contact_properties))
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

  /// Lists the nodes under pressure, and the ports that carry forces.
  void FaceContact::find_loaded()
  {
    loaded.clear();
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
        for (const auto &entry : body.friction_face().points[state.index].nodes)
          loaded.push_back(entry.first);
    make_set(loaded);

    summed.ports.clear();
    for (unsigned int port = properties.ports.rotation(); port < properties.ports.size(); ++port)
      summed.ports.push_back(port);
    for (const auto &patch : patches)
      summed.ports.insert(summed.ports.end(), patch.ports.begin(), patch.ports.end());
    make_set(summed.ports);
  }

  void FaceContact::sum_forces()
  {
    find_loaded();
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

  double FaceContact::largest_weighted_overlap() const
  {
    const auto &points = body.friction_face().points;
    const auto n       = static_cast<unsigned int>(loaded.size());
    Vector<double> overlap(n);
    Vector<double> area(n);
    for (const auto &state : states)
      for (const auto &[node, shape] : points[state.index].nodes)
        if (const unsigned int i = place_of(node, loaded); i < n && loaded[i] == node)
        {
          area[i] += points[state.index].weight * shape;
          if (state.trial_pressure > 0.)
            overlap[i] -= points[state.index].weight * shape * state.gap;
        }
    double largest = 0.;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, std::abs(overlap[i] / area[i]));
    return largest;
  }

  double FaceContact::penetration() const
  {
    if (properties.enforcement == Enforcement::augmented_lagrangian)
      return largest_weighted_overlap();
    double largest = 0.;
    for (const auto &state : states)
      largest = std::max(largest, -state.gap);
    return largest;
  }

  double FaceContact::overlap() const
  {
    double largest = 0.;
    for (const auto &state : states)
      largest = std::max(largest, state.response.pressure / properties.penalties.normal);
    return largest;
  }

  /// Least-squares fit of a traction by a finite-element function on the face, over the points under pressure; an entry per
  /// state.
  std::vector<double> FaceContact::projected(double ContactResponse<4>::*traction) const
  {
    const auto n = static_cast<unsigned int>(loaded.size());
    std::vector<double> result(states.size());
    if (n == 0)
      return result;
    LAPACKFullMatrix<double> mass(n);
    Vector<double> nodal(n);
    const auto &points = body.friction_face().points;
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
        for (const auto &[node, shape] : points[state.index].nodes)
        {
          const double weight  = points[state.index].weight;
          const unsigned int i = place_of(node, loaded);
          nodal[i] += weight * shape * (state.response.*traction);
          for (const auto &[other_node, other_shape] : points[state.index].nodes)
            mass(i, place_of(other_node, loaded)) += weight * shape * other_shape;
        }
    // A node whose support the contact hardly reaches has no say of its own.
    const double ridge = 1e-9 * points.front().weight;
    for (unsigned int i = 0; i < n; ++i)
      mass(i, i) += ridge;
    mass.compute_lu_factorization();
    mass.solve(nodal);
    for (std::size_t a = 0; a < states.size(); ++a)
      if (states[a].trial_pressure > 0.)
        for (const auto &[node, shape] : points[states[a].index].nodes)
          result[a] += shape * nodal[place_of(node, loaded)];
    return result;
  }

  void FaceContact::augment(std::vector<ContactMemory> &memory) const
  {
    for (auto &point : memory)
      point.normal_multiplier = point.traction = 0.;
    const auto pressures = projected(&ContactResponse<4>::pressure);
    const auto tractions = projected(&ContactResponse<4>::traction);
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
