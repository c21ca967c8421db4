// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "model/circle.h"
#include "model/contact_of_levers.h"
#include "model/dynamic_model.h"
#include "model/frame_coupling.h"
#include "model/growth.h"
#include "model/hub_spring.h"
#include "model/lever_frame.h"
#include "model/linearisation.h"
#include "model/modified_newton.h"
#include "model/port_newton.h"
#include "model/port_step.h"
#include "model/steady_slides.h"
#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace sprag
{
  /// An equilibrium on the way from no friction to the scene's.
  struct BranchPoint
  {
    double share;   ///< of the friction
    double overlap; ///< [mm]
  };

  /// The share of the friction up to which such a branch was followed, and whether it jams there.
  struct BranchEnd
  {
    double share;
    bool jams;
  };

  /// Returns the share of friction from the last of these points to a fold, at which the branch turns back: there the share's
  /// slope over the overlap, a straight line near the fold, falls to 0. Infinite where it does not fall. The slopes are those
  /// between points whose overlaps are a tenth apart, over which elements that come into contact count for little.
  inline double distance_to_fold(const std::vector<BranchPoint> &branch)
  {
    constexpr double none = std::numeric_limits<double>::infinity(), apart = 0.9;
    std::vector<BranchPoint> p; // the last first
    for (auto point = branch.rbegin(); point != branch.rend() && p.size() < 3; ++point)
      if (p.empty() || point->overlap <= apart * p.back().overlap)
        p.push_back(*point);
    if (p.size() < 3)
      return none;
    const auto slope  = [&](const unsigned int i) { return (p[i].share - p[i + 1].share) / (p[i].overlap - p[i + 1].overlap); };
    const double bend = (slope(1) - slope(0)) / (0.5 * (p[0].overlap - p[2].overlap));
    const double slope_at_end = slope(0) - 0.5 * bend * (p[0].overlap - p[1].overlap);
    if (!(bend > 0.))
      return none;
    return slope_at_end > 0. ? 0.5 * slope_at_end * slope_at_end / bend : 0.;
  }

  /// A linear structure, a lever or a mirrored pair of them, in unilateral frictional contact, in time. The forces, speed and
  /// slip that a slide is described by are those of the first lever; sliding at one speed, both have the same. Structure: see
  /// ModalStructure. Contact: see PointContact, MirroredContact.
  template <class Structure, class Contact>
  class DynamicLever : public DynamicModel
  {
  public:
    DynamicLever(std::unique_ptr<Structure> structure_, std::unique_ptr<Contact> contact_, LeverFrame frame_)
        : structure(std::move(structure_))
        , contact(std::move(contact_))
        , frame(std::move(frame_))
        , coupling(frame.ports, frame.rest_inclination)
        , hub_spring(frame.ports, frame.spring, frame.joined)
        , slides(*structure, *contact, found, frame, hub_spring)
    {
    }

    Motion initial_motion(const DrivePoint &drive) override
    {
      if (drive.v == 0.)
        return start_at_rest(drive);
      // Velocity and acceleration from equilibria to both sides; far enough apart to average over single points of a face.
      const double h     = 1e-3 * frame.geometries.front().cylinder_radius;
      const double ratio = slides.speed_ratio(drive, h);
      const auto before  = sliding(moved(drive, -h), ratio);
      const auto after   = sliding(moved(drive, h), ratio);
      auto here          = sliding(drive, ratio);
      if (!before || !after || !here)
        throw AnalysisError("no equilibrium of steady sliding at x = " + std::to_string(drive.x) +
                            " mm. Try less friction, another Drive/Start or, where given, Contact/Penalty = auto.");
      auto &q    = here->coordinates;
      q.velocity = after->coordinates.position;
      q.velocity -= before->coordinates.position;
      q.velocity *= drive.v / (2. * h);
      q.acceleration = after->coordinates.position;
      q.acceleration += before->coordinates.position;
      q.acceleration.add(-2., q.position);
      q.acceleration *= drive.v * drive.v / (h * h);
      return *here;
    }

    StepOutcome step(const Motion &accepted, const DrivePoint &to, const StepWeights &weights) override
    {
      structure->use_step(weights);
      const bool rates = Contact::uses_rates || frame.ports.sprung;
      const auto &near = reachable_ports(accepted);
      Kinematic begin =
          rates ? structure->port_kinematics(accepted) : Kinematic{ structure->port_positions(accepted, near), {}, {} };
      const Kinematic drifted = rates ? unaccelerated(begin, weights) : Kinematic{};
      const auto free         = structure->free_ports(accepted, near);
      const PerLever turned   = lever_rotations(frame.ports, begin.position);
      dealii::Vector<double> rate;
      const auto evaluate = [&](const dealii::Vector<double> &z, const Request request = Request::with_tangent) -> PortEvaluation
      {
        if (rates)
        {
          rate = drifted.velocity;
          rate.add(weights.rate(), z, -weights.rate(), drifted.position);
        }
        contact->evaluate(
            PortStep{ accepted.drive, accepted.contact, to, begin, z, rate, weights, &accepted.surface_contact, request }, found);
        coupling.add_forces(begin, z, weights, found.forces);
        hub_spring.add_forces(turned, lever_rotations(frame.ports, z), weights, found.forces);
        return { &found.forces, found.overlap() };
      };

      StepOutcome outcome;
      dealii::Vector<double> z;
      auto tangent       = accepted.tangent;
      const auto solved  = solve_step<Contact::keeps_tangent>({ structure->compliance(), free, frame.lengths, near }, evaluate,
                                                             weights, accepted.forces, factors, tangent, z);
      outcome.iterations = solved.newton.iterations;
      if (!solved.newton.converged)
        return outcome;
      if (!found.within_reach)
      {
        contact->widen_reach();
        return step(accepted, to, weights);
      }

      if constexpr (Contact::keeps_tangent)
        evaluate(z, Request::complete);
      Motion motion  = completed(structure->advance(accepted, *solved.forces, to), to, *solved.forces);
      motion.tangent = std::move(tangent);
      structure->add_work(accepted, motion, outcome.work);
      outcome.work += found.work();
      coupling.add_work(begin, z, weights, outcome.work);
      hub_spring.add_work(turned, lever_rotations(frame.ports, z), weights, outcome.work);
      outcome.error  = weights.wants_error ? largest_gap_change(*contact, found, structure->port_error(accepted, motion)) : 0.;
      outcome.motion = std::move(motion);
      return outcome;
    }

    std::optional<SlidingForces> sliding_forces(const DrivePoint &drive) override
    {
      // There a lever touches without force.
      if (drive.v == 0. && drive.x == 0. && frame.ports.levers == 1)
        return SlidingForces{ 0., 0. };
      if (slides.follow(drive) == nullptr)
        return {};
      return observed_forces();
    }

    std::optional<HeldSlide> hold(const DrivePoint &drive, const ContactFriction friction) override
    {
      if (friction != ContactFriction::sliding)
        return slide_at(drive, friction, 1.);
      const auto frictionless = slides.solve(drive, 1., ContactFriction::none);
      const double P_free     = frictionless == nullptr ? 0. : observed_forces().P;
      const double nearby     = 1e-3 * frame.geometries.front().cylinder_radius;
      auto slide              = slide_at(drive, friction, slides.speed_ratio(drive, nearby));
      if (!slide || !(slide->uniqueness > 0.))
      {
        const auto end = grow_friction(drive);
        if (end.share < 1. && !slide && !end.jams)
          throw no_equilibrium(drive, end.share);
        if (end.share < 1.)
          return slide;
        const auto grown   = slides.last_equilibrium();
        const double ratio = slides.speed_ratio(drive, nearby);
        slides.start_from(grown);
        slide = slide_at(drive, friction, ratio);
        if (!slide)
          throw no_equilibrium(drive, 1.);
      }
      slide->margin = P_free / slide->forces.P;
      return slide;
    }

    std::vector<Eigenmode> vibrations(const HeldSlide &slide, const bool in_contact, const unsigned int number) override
    {
      const auto forces = perturbation(sliding_state(slide), in_contact);
      return explained(*structure, structure->vibrations(forces, number), forces, frame.ports);
    }

    std::vector<std::complex<double>> eigenvalues(const HeldSlide &slide, const unsigned int number) override
    {
      std::vector<std::complex<double>> result;
      for (const auto &mode : structure->vibrations(perturbation(sliding_state(slide), true), number))
        result.push_back(mode.eigenvalue);
      return result;
    }

    Motion perturbed(const HeldSlide &slide, const Eigenmode &eigenmode, const double amplitude) override
    {
      contact->evaluate_sliding(sliding_state(slide), found);
      const std::complex<double> size = amplitude / largest_gap_change(*contact, found, eigenmode.ports);
      Motion motion                   = slide.motion;
      add_mode(size, eigenmode.mode, motion);
      dealii::Vector<double> ports = slide.ports;
      dealii::Vector<double> rates(ports.size());
      add_real_part(size, eigenmode.ports, ports);
      add_real_part(size * eigenmode.mode.eigenvalue, eigenmode.ports, rates);
      contact->evaluate_sliding(SlidingState{ ports, slide.drive, slide.speed, &rates, slide.friction }, found);
      remember(found.memory(), motion);
      return motion;
    }

    ModeShape mode_shape(const Eigenmode &mode) const override
    {
      const auto port = [&](const unsigned int i) { return std::complex<double>(mode.ports[0][i], mode.ports[1][i]); };
      ModeShape result;
      for (unsigned int lever = 0; lever < frame.ports.levers; ++lever)
      {
        const auto real      = contact->surface_shape(mode.ports[0], lever);
        const auto imaginary = contact->surface_shape(mode.ports[1], lever);
        result.xi            = real.xi;
        result.levers.push_back({ { { real.along, imaginary.along } },
                                  { { real.across, imaginary.across } },
                                  {},
                                  port(frame.ports.rotation(lever)) });
      }
      result.support = frame.ports.sprung ? port(frame.ports.support()) : 0.;
      return result;
    }

    StoredEnergy stored_energy(const Motion &motion) const override
    {
      StoredEnergy energy = structure->stored_energy(motion);
      (Contact::stands_for_layer ? energy.elastic : energy.contact) += found.energy();
      if (Contact::stands_for_layer)
        energy.layer = found.energy();
      energy.spring += hub_spring.energy(turns(motion));
      if (frame.ports.sprung)
        energy.kinetic += coupling.kinetic_energy(structure->port_kinematics(motion));
      return energy;
    }

    void observe(const Motion &motion, Row &row) const override
    {
      PortState support{};
      if (frame.ports.sprung)
        support = structure->port_state(motion, frame.ports.support());
      const double x = motion.drive.x - support.position;
      observe_lever(motion, 0, x, row);
      if (frame.ports.levers == 2)
      {
        Row second;
        observe_lever(motion, 1, x, second);
        row.add_second_lever(second);
      }
      const double support_force        = frame.support_stiffness * support.position + frame.support_damping * support.velocity;
      row[Column::support_displacement] = support.position;
      row[Column::Q_support]            = (frame.ports.sprung ? support_force : row.drive_force()) / frame.ports.levers;
    }

    double drive_force(const Motion &) const override
    {
      return contact->drive_force(found);
    }

    FacePoints face_points() const override
    {
      return contact->face_points();
    }

    FaceState face_state(const Motion &motion) const override
    {
      return contact->face_state(found, motion.drive);
    }

    void visit_history(Archive &archive) override
    {
      structure->visit_history(archive);
      contact->visit_history(archive);
      slides.visit_history(archive);
    }

  private:
    const std::unique_ptr<Structure> structure;
    const std::unique_ptr<Contact> contact;
    typename Contact::Evaluation found; ///< of the last step or equilibrium
    const LeverFrame frame;
    FrameCoupling coupling;
    HubSpringExcess hub_spring;
    SteadySlides<Structure, Contact> slides;
    JacobianFactors factors;

    PerLever turns(const Motion &motion) const
    {
      PortSelection rotations;
      for (unsigned int lever = 0; lever < frame.ports.levers; ++lever)
        rotations.push_back(frame.ports.rotation(lever));
      return lever_rotations(frame.ports, structure->port_positions(motion, rotations));
    }

    /// `x` from the pivot frame's origin.
    void observe_lever(const Motion &motion, const unsigned int lever, const double x, Row &row) const
    {
      const auto hub          = structure->port_state(motion, frame.ports.rotation(lever));
      row[Column::theta]      = frame.rest_inclination + hub.position;
      row[Column::theta_rate] = hub.velocity;
      contact->observe(found, row, lever);
      row[Column::centre_offset] = row[Column::s] - cylinder_centre(frame.geometries[lever], x, row[Column::theta]).xi;
      if (frame.ports.sensors == 0)
        return;
      PortSelection sensors;
      for (unsigned int i = 0; i < frame.ports.sensors; ++i)
        sensors.push_back(frame.ports.sensor(i, lever));
      const auto compressions = structure->port_positions(motion, sensors);
      std::vector<double> forces;
      for (const unsigned int port : sensors)
        forces.push_back(frame.sensor_stiffness * compressions[port]);
      frame.tell_sensors(std::move(forces), row);
    }

    const PortSelection &reachable_ports(const Motion &motion) const
    {
      const double u = frame.ports.sprung ? structure->port_state(motion, frame.ports.support()).position : 0.;
      return contact->reachable_ports(motion.drive.x - u, compute_inclinations(frame, turns(motion)));
    }

    /// Touching at x = 0. Further on as slowly slid there from x = 0, with friction as in a motion forward and mu at rest.
    Motion start_at_rest(const DrivePoint &drive)
    {
      const bool is_preloaded = frame.spring.moment(0.) > 0.;
      if (drive.x > 0. || is_preloaded)
        return pressed_at_rest(drive, ContactFriction::sliding);
      Motion motion = structure->rest();
      motion.drive  = drive;
      // A cylinder out of the mirror plane presses on one lever from the beginning.
      if (frame.ports.levers == 2 && overlaps(structure->port_positions(motion), drive))
        return pressed_at_rest(drive, ContactFriction::none);
      remember(contact->touch(structure->port_positions(motion), drive, found), motion);
      return motion;
    }

    bool overlaps(const dealii::Vector<double> &ports, const DrivePoint &drive)
    {
      contact->evaluate_sliding(SlidingState{ ports, drive, 1., nullptr, ContactFriction::none }, found);
      return found.overlap() > 1e-9 * frame.geometries.front().cylinder_radius;
    }

    Motion pressed_at_rest(const DrivePoint &drive, const ContactFriction friction)
    {
      const PortForces *const forces = slides.solve({ drive.time, drive.x, 0., 0. }, 1., friction);
      if (forces == nullptr)
        throw AnalysisError("no equilibrium at rest. Try another Drive/Start or a smaller Mirrored pair/Cylinder offset.");
      return completed(structure->deform(*forces), drive, *forces);
    }

    /// Forces on the first lever at the last evaluation of the contact.
    SlidingForces observed_forces() const
    {
      Row row;
      contact->observe(found, row, 0);
      return { row[Column::P], row[Column::Q] };
    }

    static SlidingState sliding_state(const HeldSlide &slide)
    {
      return { slide.ports, slide.drive, slide.speed, nullptr, slide.friction };
    }

    /// The contact's forces about a held slide, those of the hub's spring and the coupling with a sprung support.
    PortPerturbation perturbation(const SlidingState &slide, const bool in_contact)
    {
      const auto slide_rotations = lever_rotations(frame.ports, slide.ports);
      const auto theta           = compute_inclinations(frame, slide_rotations);
      contact->reachable_ports(slide.drive.x, theta);
      const auto contact_perturbation = in_contact ? contact->linearise(slide, found) : PortPerturbation();
      auto ports                      = contact_perturbation.ports;
      for (const auto &others : { coupling.coupled_ports(), hub_spring.loaded_ports() })
        ports.insert(ports.end(), others.begin(), others.end());
      std::sort(ports.begin(), ports.end());
      ports.erase(std::unique(ports.begin(), ports.end()), ports.end());

      PortPerturbation result(std::move(ports));
      result.add(contact_perturbation);
      coupling.add_inertia(result.ports, theta, result.inertia);
      hub_spring.add_stiffness(result.ports, slide_rotations, result.pressure);
      return result;
    }

    /// The determinant that HeldSlide describes.
    double uniqueness(const SlidingState &slide)
    {
      structure->use_statics();
      const auto forces = perturbation(slide, true);
      return port_determinant(structure->compliance(), forces.ports, forces.stiffness()) /
             port_determinant(structure->compliance(), forces.ports, forces.pressure);
    }

    /// Finds the slide at a ratio of speeds, see SteadySlides::speed_ratio(), from the last equilibrium; none where none is
    /// found, or with a layer pressed too far. Its margin is 1.
    std::optional<HeldSlide> slide_at(const DrivePoint &drive, const ContactFriction friction, const double ratio)
    {
      const bool with_friction = friction == ContactFriction::sliding;
      const auto law           = with_friction ? friction : ContactFriction::none;
      const auto *force        = slides.solve(drive, ratio, law);
      // If the structure's answer differs from its compliance by round-off, the forces are corrected.
      constexpr unsigned int most_corrections = 2;
      dealii::Vector<double> round_off(frame.ports.size());
      for (unsigned int i = 0; i < most_corrections && force != nullptr; ++i)
      {
        auto change = structure->port_positions(structure->deform(*force));
        change -= slides.last_equilibrium().ports;
        const auto counts = [&](const unsigned int port)
        { return std::abs(frame.lengths[port] * change[port]) > 1e-10 * found.overlap(); };
        if (std::none_of(force->ports.begin(), force->ports.end(), counts))
          break;
        round_off += change;
        force = slides.solve(drive, ratio, law, &round_off);
      }
      if (force == nullptr)
        return {};
      HeldSlide slide;
      slide.drive    = drive;
      slide.motion   = completed(structure->deform(*force), { drive.time, drive.x, 0., 0. }, *force);
      slide.ports    = slides.last_equilibrium().ports;
      slide.friction = friction;
      slide.speed    = ratio * sliding_speed(frame.geometries.front(), drive.x, drive.v);
      slide.overlap  = found.overlap();
      Row row;
      contact->observe(found, row, 0);
      slide.indentation = row[Column::indentation];
      if (with_friction && slide.indentation > frame.largest_indentation)
        return {};
      slide.margin     = 1.;
      slide.mu         = with_friction ? row[Column::mu] : 0.;
      slide.forces     = { row[Column::P], row[Column::Q] };
      slide.uniqueness = uniqueness(sliding_state(slide));
      return slide;
    }

    /// The failure of the method, beyond a share of friction at which there is an equilibrium.
    static AnalysisError no_equilibrium(const DrivePoint &drive, const double share)
    {
      return AnalysisError("no equilibrium found at x = " + std::to_string(drive.x) + " mm beyond " + std::to_string(share) +
                           " times the friction, where the lever does not jam. Try another mesh or Stability/Position.");
    }

    /// Physical compression of the layer in the last equilibrium [mm].
    double indentation() const
    {
      Row row;
      contact->observe(found, row, 0);
      return row[Column::indentation];
    }

    /// Follows the equilibrium from no friction to the scene's, in steps that are halved where Newton's method fails or has left
    /// the branch. It jams where the branch ends at a fold, or with a layer pressed too far. Where it ends elsewhere another
    /// branch crosses it, or the method fails.
    BranchEnd grow_friction(const DrivePoint &drive)
    {
      constexpr double smallest_step = 1e-4, near_fold = 1e-2; // shares of the friction
      slides.solve(drive, 1., ContactFriction::none);
      const double speed   = sliding_speed(frame.geometries.front(), drive.x, drive.v);
      const auto is_unique = [&](const double share)
      {
        const auto ports = slides.last_equilibrium().ports;
        return uniqueness({ ports, drive, speed, nullptr, ContactFriction::sliding, Request::with_tangent, share }) > 0.;
      };
      std::vector<BranchPoint> branch = { { 0., found.overlap() } };
      for (double step = 0.25; branch.back().share < 1. && step > smallest_step;)
      {
        const double next = std::min(1., branch.back().share + step);
        const auto before = slides.last_equilibrium();
        if (slides.solve_with_share(drive, next) != nullptr && is_unique(next))
        {
          if (indentation() > frame.largest_indentation)
            return { branch.back().share, true };
          branch.push_back({ next, found.overlap() });
          step *= 1.5;
        }
        else
        {
          slides.start_from(before);
          step *= 0.5;
        }
      }
      return { branch.back().share, !(distance_to_fold(branch) > near_fold) };
    }

    std::optional<Motion> sliding(const DrivePoint &drive, const double ratio)
    {
      const PortForces *const forces = slides.solve(drive, ratio);
      if (forces == nullptr)
        return {};
      return completed(structure->deform(*forces), drive, *forces);
    }

    /// Adds to a motion what the structure does not know: drive, memory of the contact and its forces.
    Motion completed(Motion motion, const DrivePoint &drive, const PortForces &forces) const
    {
      motion.drive  = drive;
      motion.forces = { forces.ports, forces.values };
      remember(found.memory(), motion);
      return motion;
    }
  };
} // namespace sprag
