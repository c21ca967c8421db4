#include "fe/face_contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// The law seen by one step: with the drive's speed mu is a constant of the step.
    FrictionLaw law_of_step(const FrictionLaw &friction, const double drive_speed)
    {
      if (friction.speed == FrictionSpeed::sliding)
        return friction;
      return { CoulombFriction{ friction_coefficient(friction, std::abs(drive_speed)).coefficient }, FrictionSpeed::drive };
    }
  } // namespace

  FaceContact::FaceContact(std::vector<FaceNode<2>> nodes, Obstacle obstacle_, FrictionLaw friction_,
                           const Enforcement enforcement_, const ContactPenalties penalties)
      : face(std::move(nodes))
      , obstacle(std::move(obstacle_))
      , friction(std::move(friction_))
      , enforcement(enforcement_)
      , stiffness(penalties)
      , gap(face.size())
      , slip(face.size())
  {
  }

  void FaceContact::evaluate(const dealii::Vector<double> &face_displacement, const double theta, const State &trial,
                             const State &accepted, const FrictionMode mode)
  {
    displacement = face_displacement;
    start        = trial.contact;
    duration     = trial.drive.time - accepted.drive.time;
    active_nodes.clear();
    active_responses.clear();
    // A state at rest, with no step behind it, can have no slip.
    const FrictionMode used = duration > 0. ? mode : FrictionMode::stick;
    const ContactLaw law    = { stiffness.normal, stiffness.tangential, law_of_step(friction, trial.drive.v), duration };
    for (unsigned int i = 0; i < face.size(); ++i)
    {
      const LeverPoint point{ face[i].position[0] + displacement[2 * i], face[i].position[1] + displacement[2 * i + 1] };
      const auto kinematics = obstacle(point, trial.drive.x, theta);
      gap[i]                = kinematics.gap;
      slip[i]               = kinematics.slip;
      if (trial_pressure(i) > 0.)
      {
        active_nodes.push_back(i);
        active_responses.push_back(contact_response(kinematics, start[i], law, used));
      }
    }
  }

  const std::vector<FaceNode<2>> &FaceContact::nodes() const
  {
    return face;
  }

  const std::vector<unsigned int> &FaceContact::active() const
  {
    return active_nodes;
  }

  const std::vector<ContactResponse<3>> &FaceContact::responses() const
  {
    return active_responses;
  }

  ContactResultant FaceContact::resultant() const
  {
    dealii::Tensor<1, 3> sum;
    for (std::size_t a = 0; a < active_nodes.size(); ++a)
      sum += face[active_nodes[a]].weight * active_responses[a].force;
    return { sum[0], sum[1], sum[2] };
  }

  double FaceContact::trial_pressure(const unsigned int node) const
  {
    return start[node].normal_multiplier - stiffness.normal * gap[node];
  }

  double FaceContact::penetration() const
  {
    double largest = 0.;
    for (const unsigned int i : active_nodes)
      largest = std::max(largest, -gap[i]);
    return largest;
  }

  double FaceContact::overlap() const
  {
    double largest = 0.;
    for (const auto &response : active_responses)
      largest = std::max(largest, response.pressure / stiffness.normal);
    return largest;
  }

  void FaceContact::augment(std::vector<ContactMemory> &memory) const
  {
    for (auto &point : memory)
    {
      point.normal_multiplier = 0.;
      point.traction          = 0.;
    }
    for (std::size_t a = 0; a < active_nodes.size(); ++a)
    {
      memory[active_nodes[a]].normal_multiplier = active_responses[a].pressure;
      memory[active_nodes[a]].traction          = active_responses[a].traction;
    }
  }

  std::vector<ContactMemory> FaceContact::memory() const
  {
    std::vector<ContactMemory> result(face.size());
    augment(result);
    for (unsigned int i = 0; i < face.size(); ++i)
    {
      result[i].slip = slip[i];
      if (enforcement == Enforcement::penalty)
        result[i].normal_multiplier = 0.;
    }
    return result;
  }

  double FaceContact::contact_width() const
  {
    double width = 0.;
    for (unsigned int i = 0; i + 1 < face.size(); ++i)
    {
      const double length = face[i + 1].position[0] - face[i].position[0];
      const double left   = trial_pressure(i);
      const double right  = trial_pressure(i + 1);
      if (left > 0. && right > 0.)
        width += length;
      else if (left > 0. || right > 0.)
        width += length * std::max(left, right) / (std::max(left, right) - std::min(left, right));
    }
    return width;
  }

  double FaceContact::indentation(const double centre, const double half_width, const double layer_thickness) const
  {
    if (layer_thickness == 0.)
      return 0.;
    const auto normal_displacement = [&](const double xi)
    {
      const auto after = std::lower_bound(face.begin(), face.end(), xi,
                                          [](const auto &node, const double value) { return node.position[0] < value; });
      const auto i =
          static_cast<unsigned int>(std::clamp<std::ptrdiff_t>(after - face.begin(), 1, static_cast<int>(face.size()) - 1));
      const double begin = face[i - 1].position[0];
      const double share = std::clamp((xi - begin) / (face[i].position[0] - begin), 0., 1.);
      return (1. - share) * displacement[2 * i - 1] + share * displacement[2 * i + 1];
    };
    const double aside = half_width + 4. * layer_thickness;
    return normal_displacement(centre) - 0.5 * (normal_displacement(centre - aside) + normal_displacement(centre + aside));
  }

  double FaceContact::cone_violation() const
  {
    double excess = 0.;
    double peak   = 0.;
    for (const auto &response : active_responses)
    {
      excess = std::max(excess, std::abs(response.traction) - response.mu * response.pressure);
      peak   = std::max(peak, response.mu * response.pressure);
    }
    return peak > 0. ? excess / peak : 0.;
  }

  double FaceContact::elastic_slip() const
  {
    double largest = 0.;
    for (std::size_t a = 0; a < active_nodes.size(); ++a)
    {
      const double held = enforcement == Enforcement::penalty ? 0. : start[active_nodes[a]].traction;
      largest           = std::max(largest, std::abs(active_responses[a].traction - held) / stiffness.tangential);
    }
    return largest;
  }

  void FaceContact::observe(const double layer_thickness, Row &row) const
  {
    double force = 0., friction_force = 0., position = 0., speed = 0., mu = 0., power = 0., energy = 0.;
    for (std::size_t a = 0; a < active_nodes.size(); ++a)
    {
      const unsigned int i = active_nodes[a];
      const auto &response = active_responses[a];
      const double normal  = face[i].weight * response.pressure;
      const double rate    = duration > 0. ? (slip[i] - start[i].slip) / duration : 0.;
      force += normal;
      friction_force += face[i].weight * response.traction;
      position += normal * (face[i].position[0] + displacement[2 * i]);
      speed += normal * rate;
      mu += normal * response.mu;
      power += face[i].weight * response.traction * rate;
      energy += 0.5 * face[i].weight * (response.force[0] * displacement[2 * i] + response.force[1] * displacement[2 * i + 1]);
    }
    const auto total                = resultant();
    row[Column::P]                  = total.across;
    row[Column::F]                  = -total.along;
    row[Column::normal_resultant]   = force;
    row[Column::friction_resultant] = friction_force;
    row[Column::friction_power]     = power;
    row[Column::elastic_energy]     = energy;
    row[Column::contact_width]      = contact_width();
    row[Column::penetration]        = penetration();
    row[Column::cone_violation]     = cone_violation();
    row[Column::elastic_slip]       = elastic_slip();
    row[Column::active_points]      = static_cast<double>(active_nodes.size());
    row[Column::indentation]        = 0.;
    if (force > 0.)
    {
      row[Column::s]           = position / force;
      row[Column::mu]          = mu / force;
      row[Column::indentation] = indentation(position / force, 0.5 * row[Column::contact_width], layer_thickness);
      if (duration > 0.)
        row[Column::v_rel] = speed / force;
    }
  }

  const ContactPenalties &FaceContact::penalties() const
  {
    return stiffness;
  }

  FacePoints FaceContact::points() const
  {
    FacePoints result;
    for (const auto &node : face)
    {
      result.xi.push_back(node.position[0]);
      result.weight.push_back(node.weight);
    }
    return result;
  }

  FaceState FaceContact::state(const DrivePoint &drive) const
  {
    FaceState result;
    result.time = drive.time;
    result.x    = drive.x;
    result.pressure.resize(face.size());
    result.traction.resize(face.size());
    for (std::size_t a = 0; a < active_nodes.size(); ++a)
    {
      result.pressure[active_nodes[a]] = active_responses[a].pressure;
      result.traction[active_nodes[a]] = active_responses[a].traction;
    }
    return result;
  }
} // namespace sprag
