#include "fe/face_contact.h"

#include "laws/friction_of_step.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    unsigned int place_of(const unsigned int node, const std::vector<unsigned int> &nodes)
    {
      return static_cast<unsigned int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    }
  } // namespace

  FaceContact::FaceContact(const ElasticBody<2> &body_, FaceContactProperties contact_properties)
      : body(body_)
      , properties(std::move(contact_properties))
  {
  }

  Tensor<1, 2> FaceContact::displacement(const unsigned int point) const
  {
    Tensor<1, 2> result;
    for (const auto &[node, shape] : body.friction_face().points[point].nodes)
    {
      result[0] += shape * ports[2 * node];
      result[1] += shape * ports[2 * node + 1];
    }
    return result;
  }

  LeverPoint FaceContact::position(const unsigned int point) const
  {
    const auto moved = body.friction_face().points[point].position + displacement(point);
    return { moved[0], moved[1] };
  }

  /// The gap along a straight patch to a convex obstacle lies above its tangent at the first point; the margin covers bending.
  bool FaceContact::is_near(const FacePatch &patch) const
  {
    const auto begin   = position(patch.begin);
    const auto end     = position(patch.end - 1);
    const auto contact = properties.obstacle(begin, x, theta);
    const double rise  = contact.gap_row[0] * (end.xi - begin.xi) + contact.gap_row[1] * (end.eta - begin.eta);
    return contact.gap + std::min(0., rise) < 0.02 * patch.length;
  }

  FaceContact::PointState FaceContact::evaluate_point(const unsigned int q, const ContactLaw &law, const FrictionMode mode) const
  {
    PointState state;
    const auto &memory   = start[q];
    state.index          = q;
    state.position       = position(q);
    const auto contact   = properties.obstacle(state.position, x, theta);
    state.gap            = contact.gap;
    state.trial_pressure = memory.normal_multiplier - properties.penalties.normal * contact.gap;
    state.slip_change    = contact.slip - memory.slip;
    if (state.trial_pressure > 0.)
      state.response = contact_response(contact, memory, law, mode);
    const double held = properties.enforcement == Enforcement::penalty ? 0. : memory.traction;
    state.elastic_slip =
        state.trial_pressure > 0. ? std::abs(state.response.traction - held) / properties.penalties.tangential : 0.;
    return state;
  }

  void FaceContact::evaluate(const Vector<double> &displacements_of_ports, const State &trial, const State &accepted,
                             const FrictionMode mode)
  {
    const auto &layout   = properties.ports;
    ports                = displacements_of_ports;
    theta                = properties.rest_inclination + ports[layout.rotation()];
    x                    = trial.drive.x - (layout.sprung ? ports[layout.support()] : 0.);
    start                = trial.contact;
    step_duration        = trial.drive.time - accepted.drive.time;
    const ContactLaw law = { properties.penalties.normal, properties.penalties.tangential,
                             friction_of_step(properties.friction, trial.drive.v), step_duration };
    // A state with no step behind it can have no slip.
    const FrictionMode used = step_duration > 0. ? mode : FrictionMode::stick;
    states.clear();
    for (const auto &patch : body.friction_face().patches)
      if (is_near(patch))
        for (unsigned int q = patch.begin; q < patch.end; ++q)
          states.push_back(evaluate_point(q, law, used));
    sum_forces();
  }

  /// Lists the nodes under pressure, and the ports that carry forces with them.
  void FaceContact::find_loaded()
  {
    loaded.clear();
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
        for (const auto &entry : body.friction_face().points[state.index].nodes)
          loaded.push_back(entry.first);
    std::sort(loaded.begin(), loaded.end());
    loaded.erase(std::unique(loaded.begin(), loaded.end()), loaded.end());

    summed.ports.clear();
    for (const unsigned int node : loaded)
      for (unsigned int d = 0; d < 2; ++d)
        summed.ports.push_back(2 * node + d);
    for (unsigned int port = properties.ports.rotation(); port < properties.ports.size(); ++port)
      summed.ports.push_back(port);
    const auto n = static_cast<unsigned int>(summed.ports.size());
    summed.values.reinit(n);
    summed.tangent.reinit(n, n);
  }

  void FaceContact::sum_forces()
  {
    find_loaded();
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
        add_forces(state);
  }

  /// The support's displacement moves the obstacle's position back.
  void FaceContact::add_forces(const PointState &state)
  {
    struct Mover
    {
      unsigned int place; ///< among the ports with forces
      double weight;
    };
    const auto &point = body.friction_face().points[state.index];
    const auto hub    = 2 * static_cast<unsigned int>(loaded.size());
    const Mover rest[2]{ { hub, 1. }, { hub + 1, -1. } };
    const unsigned int n_rest = properties.ports.sprung ? 2 : 1;
    const auto force          = point.weight * state.response.force;
    const auto tangent        = point.weight * state.response.tangent;
    for (unsigned int a = 0; a < n_rest; ++a)
    {
      summed.values[rest[a].place] += rest[a].weight * force[2 + a];
      for (unsigned int b = 0; b < n_rest; ++b)
        summed.tangent(rest[a].place, rest[b].place) += rest[a].weight * rest[b].weight * tangent[2 + a][2 + b];
    }
    for (const auto &[node, shape] : point.nodes)
    {
      const unsigned int i = 2 * place_of(node, loaded);
      for (unsigned int d = 0; d < 2; ++d)
      {
        summed.values[i + d] += shape * force[d];
        for (unsigned int b = 0; b < n_rest; ++b)
        {
          summed.tangent(i + d, rest[b].place) += shape * rest[b].weight * tangent[d][2 + b];
          summed.tangent(rest[b].place, i + d) += shape * rest[b].weight * tangent[2 + b][d];
        }
      }
      for (const auto &[other_node, other_shape] : point.nodes)
      {
        const unsigned int j = 2 * place_of(other_node, loaded);
        for (unsigned int d = 0; d < 2; ++d)
          for (unsigned int e = 0; e < 2; ++e)
            summed.tangent(i + d, j + e) += shape * other_shape * tangent[d][e];
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
    for (unsigned int q = 0; q < result.size(); ++q)
      result[q].slip = properties.obstacle(position(q), x, theta).slip;
    return result;
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
