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

  FaceContact::FaceContact(const ElasticBody<2> &body_, Obstacle obstacle_, FrictionLaw friction_, const Enforcement enforcement_,
                           const ContactPenalties penalties)
      : body(body_)
      , obstacle(std::move(obstacle_))
      , friction(std::move(friction_))
      , enforcement(enforcement_)
      , stiffness(penalties)
  {
  }

  Tensor<1, 2> FaceContact::displacement(const unsigned int point) const
  {
    Tensor<1, 2> result;
    for (const auto &[node, shape] : body.friction_face().points[point].nodes)
    {
      result[0] += shape * nodal_displacement[2 * node];
      result[1] += shape * nodal_displacement[2 * node + 1];
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
    const auto contact = obstacle(begin, x, theta);
    const double rise  = contact.gap_row[0] * (end.xi - begin.xi) + contact.gap_row[1] * (end.eta - begin.eta);
    return contact.gap + std::min(0., rise) < 0.02 * patch.length;
  }

  FaceContact::PointState FaceContact::evaluate_point(const unsigned int q, const ContactLaw &law, const FrictionMode mode) const
  {
    PointState state;
    const auto &memory   = start[q];
    state.index          = q;
    state.position       = position(q);
    const auto contact   = obstacle(state.position, x, theta);
    state.gap            = contact.gap;
    state.trial_pressure = memory.normal_multiplier - stiffness.normal * contact.gap;
    state.slip_change    = contact.slip - memory.slip;
    if (state.trial_pressure > 0.)
      state.response = contact_response(contact, memory, law, mode);
    const double held  = enforcement == Enforcement::penalty ? 0. : memory.traction;
    state.elastic_slip = state.trial_pressure > 0. ? std::abs(state.response.traction - held) / stiffness.tangential : 0.;
    return state;
  }

  void FaceContact::evaluate(const Vector<double> &displacement_of_nodes, const double hub_theta, const State &trial,
                             const State &accepted, const FrictionMode mode)
  {
    nodal_displacement   = displacement_of_nodes;
    theta                = hub_theta;
    x                    = trial.drive.x;
    start                = trial.contact;
    step_duration        = trial.drive.time - accepted.drive.time;
    const ContactLaw law = { stiffness.normal, stiffness.tangential, friction_of_step(friction, trial.drive.v), step_duration };
    // A state with no step behind it can have no slip.
    const FrictionMode used = step_duration > 0. ? mode : FrictionMode::stick;
    states.clear();
    for (const auto &patch : body.friction_face().patches)
      if (is_near(patch))
        for (unsigned int q = patch.begin; q < patch.end; ++q)
          states.push_back(evaluate_point(q, law, used));
    sum_forces();
  }

  void FaceContact::sum_forces()
  {
    const auto &points = body.friction_face().points;
    summed.nodes.clear();
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
        for (const auto &entry : points[state.index].nodes)
          summed.nodes.push_back(entry.first);
    std::sort(summed.nodes.begin(), summed.nodes.end());
    summed.nodes.erase(std::unique(summed.nodes.begin(), summed.nodes.end()), summed.nodes.end());

    const auto rotation = 2 * static_cast<unsigned int>(summed.nodes.size());
    summed.values.reinit(rotation + 1);
    summed.tangent.reinit(rotation + 1, rotation + 1);
    for (const auto &state : states)
      if (state.trial_pressure > 0.)
      {
        const auto &point  = points[state.index];
        const auto force   = point.weight * state.response.force;
        const auto tangent = point.weight * state.response.tangent;
        summed.values[rotation] += force[2];
        summed.tangent(rotation, rotation) += tangent[2][2];
        for (const auto &[node, shape] : point.nodes)
        {
          const unsigned int i = 2 * place_of(node, summed.nodes);
          for (unsigned int d = 0; d < 2; ++d)
          {
            summed.values[i + d] += shape * force[d];
            summed.tangent(i + d, rotation) += shape * tangent[d][2];
            summed.tangent(rotation, i + d) += shape * tangent[2][d];
          }
          for (const auto &[other_node, other_shape] : point.nodes)
          {
            const unsigned int j = 2 * place_of(other_node, summed.nodes);
            for (unsigned int d = 0; d < 2; ++d)
              for (unsigned int e = 0; e < 2; ++e)
                summed.tangent(i + d, j + e) += shape * other_shape * tangent[d][e];
          }
        }
      }
  }

  const ContactForces &FaceContact::forces() const
  {
    return summed;
  }

  double FaceContact::largest_weighted_overlap() const
  {
    const auto &points = body.friction_face().points;
    const auto n       = static_cast<unsigned int>(summed.nodes.size());
    Vector<double> overlap(n);
    Vector<double> area(n);
    for (const auto &state : states)
      for (const auto &[node, shape] : points[state.index].nodes)
        if (const unsigned int i = place_of(node, summed.nodes); i < n && summed.nodes[i] == node)
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
    if (enforcement == Enforcement::augmented_lagrangian)
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
      largest = std::max(largest, state.response.pressure / stiffness.normal);
    return largest;
  }

  /// Least-squares fit of a traction by a finite-element function on the face, over the points under pressure; an entry per
  /// state.
  std::vector<double> FaceContact::projected(double ContactResponse<3>::*traction) const
  {
    const auto n = static_cast<unsigned int>(summed.nodes.size());
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
          const unsigned int i = place_of(node, summed.nodes);
          nodal[i] += weight * shape * (state.response.*traction);
          for (const auto &[other_node, other_shape] : points[state.index].nodes)
            mass(i, place_of(other_node, summed.nodes)) += weight * shape * other_shape;
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
          result[a] += shape * nodal[place_of(node, summed.nodes)];
    return result;
  }

  void FaceContact::augment(std::vector<ContactMemory> &memory) const
  {
    for (auto &point : memory)
      point.normal_multiplier = point.traction = 0.;
    const auto pressures = projected(&ContactResponse<3>::pressure);
    const auto tractions = projected(&ContactResponse<3>::traction);
    for (std::size_t a = 0; a < states.size(); ++a)
    {
      memory[states[a].index].normal_multiplier = pressures[a];
      memory[states[a].index].traction          = tractions[a];
    }
  }

  std::vector<ContactMemory> FaceContact::memory() const
  {
    std::vector<ContactMemory> result(start.size());
    if (enforcement == Enforcement::augmented_lagrangian)
      augment(result);
    else
      for (const auto &state : states)
        result[state.index].traction = state.response.traction;
    for (unsigned int q = 0; q < result.size(); ++q)
      result[q].slip = obstacle(position(q), x, theta).slip;
    return result;
  }

  const ContactPenalties &FaceContact::penalties() const
  {
    return stiffness;
  }

  const std::vector<FaceContact::PointState> &FaceContact::points() const
  {
    return states;
  }

  const Vector<double> &FaceContact::displacements() const
  {
    return nodal_displacement;
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
