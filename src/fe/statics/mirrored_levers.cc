#include "fe/statics/mirrored_levers.h"

#include "base/errors.h"
#include "model/joined_memory.h"
#include "scene/mirrored_pair.h"
#include "scene/pair_closed_form.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    std::array<State, 2> states_of(const MirroredLevers &pair, const State &state)
    {
      return { { pair.state_of(0, state), pair.state_of(1, state) } };
    }

    Vector<double> joined(const std::array<Vector<double>, 2> &parts)
    {
      Vector<double> result(parts[0].size() + parts[1].size());
      std::copy(parts[0].begin(), parts[0].end(), result.begin());
      std::copy(parts[1].begin(), parts[1].end(), result.begin() + parts[0].size());
      return result;
    }

    std::array<Vector<double>, 2> halves(const Vector<double> &all)
    {
      const auto middle = all.begin() + all.size() / 2;
      return { { Vector<double>(all.begin(), middle), Vector<double>(middle, all.end()) } };
    }
  } // namespace

  LeverProperties properties_of_lever(const Scene &scene, const unsigned int lever)
  {
    LeverProperties result = lever_properties(scene_of_lever(scene, lever));
    result.spring.rest     = rest_inclination(scene);
    result.ideal_theta     = [scene, lever](const double x) { return pair_inclinations(scene, x)[lever]; };
    return result;
  }

  MirroredLevers::MirroredLevers(const Triangulation<2> &triangulation, const Scene &scene)
      : law(moment_law(scene.spring))
      , joint_is_free(swings(scene))
      , levers{ { LeverModel(triangulation, properties_of_lever(scene, 0)),
                  LeverModel(triangulation, properties_of_lever(scene, 1)) } }
  {
  }

  const LeverModel &MirroredLevers::lever(const unsigned int index) const
  {
    return levers.at(index);
  }

  State MirroredLevers::state_of(const unsigned int lever, const State &state) const
  {
    return { state.drive, halves(state.coordinates)[lever], memory_of_lever(lever, levers[0].n_face_points(), state.contact) };
  }

  State MirroredLevers::initial_state(const DrivePoint &drive) const
  {
    const State first  = levers[0].initial_state(drive);
    const State second = levers[1].initial_state(drive);
    return { drive, joined({ { first.coordinates, second.coordinates } }), {} };
  }

  void MirroredLevers::predict(State &trial, const State &accepted) const
  {
    auto guesses     = states_of(*this, trial);
    const auto start = states_of(*this, accepted);
    for (unsigned int i = 0; i < 2; ++i)
      levers[i].predict(guesses[i], start[i]);
    trial.coordinates = joined({ { guesses[0].coordinates, guesses[1].coordinates } });
  }

  double MirroredLevers::mean_turn(const std::array<State, 2> &states) const
  {
    return 0.5 * (levers[0].turn(states[0]) + levers[1].turn(states[1]));
  }

  Unbalance MirroredLevers::evaluate(const State &trial, const State &accepted, const FrictionMode mode)
  {
    const auto at       = states_of(*this, trial);
    const auto start    = states_of(*this, accepted);
    const double phi    = mean_turn(at);
    stiffness           = law.stiffness(phi);
    const auto of_lever = [&](const unsigned int i)
    {
      if (!joint_is_free)
        return levers[i].evaluate(at[i], start[i], mode);
      const double swing = phi - levers[i].turn(at[i]);
      return levers[i].evaluate(at[i], start[i], mode,
                                { law.excess(phi) + law.linear_stiffness() * swing, law.excess_stiffness(phi) });
    };
    const auto first  = of_lever(0);
    const auto second = of_lever(1);
    touches           = first.overlap > 0. || second.overlap > 0.;
    return { std::hypot(first.norm, second.norm), std::max(first.overlap, second.overlap) };
  }

  Vector<double> MirroredLevers::correction()
  {
    std::array<Vector<double>, 2> corrections{ { levers[0].correction(), levers[1].correction() } };
    // Where neither lever touches nothing holds the swing; the springs on each then stop it without touching the mean.
    if (joint_is_free && touches)
      free_swing(corrections);
    return joined(corrections);
  }

  void MirroredLevers::free_swing(std::array<Vector<double>, 2> &corrections)
  {
    const std::array<Vector<double>, 2> responses{ { levers[0].moment_response(), levers[1].moment_response() } };
    const auto hub        = levers[0].rotation();
    const double swing    = corrections[0][hub] - corrections[1][hub];
    const double response = responses[0][hub] + responses[1][hub];
    const double held     = 1. - 0.5 * stiffness * response;
    if (held == 0.)
      throw AnalysisError("the tangent of the pair's swing is singular");
    const double moment = 0.5 * stiffness * swing / held;
    corrections[0].add(moment, responses[0]);
    corrections[1].add(-moment, responses[1]);
  }

  double MirroredLevers::movement(const Vector<double> &correction) const
  {
    const auto of_levers = halves(correction);
    return std::max(levers[0].movement(of_levers[0]), levers[1].movement(of_levers[1]));
  }

  double MirroredLevers::length_scale() const
  {
    return levers[0].length_scale();
  }

  double MirroredLevers::penetration() const
  {
    return std::max(levers[0].penetration(), levers[1].penetration());
  }

  std::string MirroredLevers::objection(const State &trial) const
  {
    const auto at = states_of(*this, trial);
    if (const auto of_first = levers[0].objection(at[0]); !of_first.empty())
      return of_first;
    const auto of_second = levers[1].objection(at[1]);
    return of_second.empty() ? of_second : "of the pair's second lever, " + of_second;
  }

  void MirroredLevers::augment(State &trial) const
  {
    auto at = states_of(*this, trial);
    for (unsigned int i = 0; i < 2; ++i)
      levers[i].augment(at[i]);
    trial.contact = joined_memory(levers[0].n_face_points(), { { at[0].contact, at[1].contact } });
  }

  std::vector<ContactMemory> MirroredLevers::memory() const
  {
    return joined_memory(levers[0].n_face_points(), { { levers[0].memory(), levers[1].memory() } });
  }

  void MirroredLevers::observe(const State &trial, Row &row) const
  {
    const auto at = states_of(*this, trial);
    Row second;
    second[Column::friction_work] = 0.;
    second[Column::drive_work]    = 0.;
    levers[0].observe(at[0], row);
    levers[1].observe(at[1], second);
    row.add_second_lever(second);
    if (joint_is_free)
      row[Column::spring_energy] = 2. * law.energy(mean_turn(at));
  }

  FacePoints MirroredLevers::face_points() const
  {
    return levers[0].face_points();
  }

  FaceState MirroredLevers::face_state(const State &trial) const
  {
    return joined_faces(levers[0].face_state(state_of(0, trial)), levers[1].face_state(state_of(1, trial)));
  }
} // namespace sprag
