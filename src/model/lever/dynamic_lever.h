// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "base/ranges.h"
#include "model/contact/circle.h"
#include "model/contact/contact_of_levers.h"
#include "model/interface/interface_newton.h"
#include "model/lever/friction_branch.h"
#include "model/lever/own_damping.h"
#include "model/lever/steady_slides.h"
#include "model/step/dynamic_model.h"
#include "model/step/interface_step.h"
#include "model/step/linearisation.h"
#include "model/step/modified_newton.h"
#include "model/structure/eigenmodes.h"
#include "model/structure/frame_coupling.h"
#include "model/structure/hub_spring.h"
#include "model/structure/lever_frame.h"
#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace sprag
{
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
        , coupling(frame.layout, frame.rest_inclination)
        , hub_spring(frame.layout, frame.springs, frame.joined)
        , slides(*structure, *contact, found, frame, hub_spring)
    {
    }

    Motion initial_motion(const DrivePoint &drive) override
    {
      if (drive.v == 0.)
        return start_at_rest(drive);
      // Velocity and acceleration from equilibria to both sides; far enough apart to average over single points of a face.
      const double h     = 1e-3 * frame.geometries.front().cylinder_radius;
      const double ratio = slides.speed_ratio(drive, h).value_or(1.);
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
      const bool rates = Contact::uses_rates || frame.layout.sprung;
      const auto &near = candidate_dofs(accepted);
      Kinematic begin  = rates ? structure->kinematics(accepted) : Kinematic{ structure->positions(accepted, near), {}, {} };
      const Kinematic drifted = rates ? unaccelerated(begin, weights) : Kinematic{};
      const auto free         = structure->free_displacements(accepted, near);
      const PerLever turned   = lever_rotations(frame.layout, begin.position);
      dealii::Vector<double> rate;
      const auto evaluate = [&](const dealii::Vector<double> &z,
                                const Request request = Request::with_tangent) -> InterfaceEvaluation
      {
        if (rates)
        {
          rate = drifted.velocity;
          rate.add(weights.rate(), z, -weights.rate(), drifted.position);
        }
        contact->evaluate(InterfaceStep{ accepted.drive, accepted.contact, to, begin, z, rate, weights, request }, found);
        coupling.add_forces(begin, z, weights, found.forces);
        hub_spring.add_forces(turned, lever_rotations(frame.layout, z), weights, found.forces);
        return { &found.forces, found.penetration() };
      };

      StepOutcome outcome;
      dealii::Vector<double> z;
      auto tangent       = accepted.tangent;
      const auto solved  = solve_step(contact->keeps_tangent(), { structure->compliance(), free, frame.lengths, near }, evaluate,
                                      weights, accepted.forces, factors, tangent, z);
      outcome.iterations = solved.newton.iterations;
      if (!solved.newton.converged)
        return outcome;
      if (!found.within_candidates)
      {
        contact->widen_candidates();
        return step(accepted, to, weights);
      }

      if (contact->keeps_tangent())
        evaluate(z, Request::complete);
      Motion motion  = completed(structure->advance(accepted, *solved.forces, to), to, *solved.forces);
      motion.tangent = std::move(tangent);
      structure->add_work(accepted, motion, outcome.work);
      outcome.work += found.work();
      coupling.add_work(begin, z, weights, outcome.work);
      hub_spring.add_work(turned, lever_rotations(frame.layout, z), weights, outcome.work);
      outcome.error  = weights.wants_error ? largest_gap_change(*contact, found, structure->local_error(accepted, motion)) : 0.;
      outcome.motion = std::move(motion);
      return outcome;
    }

    std::vector<SlidingForces> sliding_forces(const DrivePoint &drive) override
    {
      // There a lever touches without force.
      if (drive.v == 0. && drive.x == 0. && frame.layout.levers == 1 && !frame.is_preloaded())
        return { { 0., 0. } };
      if (slides.solve(drive, 1.) == nullptr)
        return {};
      return last_forces();
    }

    std::optional<HeldSlide> hold(const DrivePoint &drive, const ContactFriction friction) override
    {
      if (friction != ContactFriction::sliding)
        return slide_at(drive, friction, 1.);
      const auto frictionless = slides.solve(drive, 1., ContactFriction::none);
      const auto free_forces  = frictionless == nullptr ? std::vector<SlidingForces>() : last_forces();
      const double nearby     = 1e-3 * frame.geometries.front().cylinder_radius;
      const auto usual_ratio  = slides.speed_ratio(drive, nearby);
      auto at_rigid_speed     = usual_ratio ? last_forces() : std::vector<SlidingForces>();
      auto slide              = slide_at(drive, friction, usual_ratio.value_or(1.));
      if (!usual_ratio || !slide || !(slide->uniqueness > 0.))
      {
        if (const auto end = grow_friction(drive, 1.); end.share < 1.)
          return jammed(drive, slide, end);
        const auto grown   = slides.last;
        const auto grow_at = [&](const DrivePoint &at) { return grow_friction(at, 1.).share == 1.; };
        const double ratio = slides.speed_ratio(drive, nearby, grow_at).value_or(1.);
        at_rigid_speed     = last_forces();
        slides.last        = grown;
        slide              = slide_at(drive, friction, ratio);
        if (!slide || !(slide->uniqueness > 0.))
        {
          const auto end = grow_friction(drive, ratio);
          if (end.share == 1.)
            slide = slide_at(drive, friction, ratio);
          if (!slide || end.share < 1.)
            return jammed(drive, slide, end);
        }
      }
      slide->margin = free_forces.empty() ? 0. : free_forces.front().P / slide->forces.P;
      if (!at_rigid_speed.empty() && slide->forces.P > 0.)
        slide->own_speed_share = std::abs(1. - at_rigid_speed.front().P / slide->forces.P);
      if (slide->second && slide->second->P > 0. && !free_forces.empty())
        slide->margin = std::fmin(slide->margin, free_forces.back().P / slide->second->P);
      return slide;
    }

    double largest_friction_share(const DrivePoint &drive, const double resolution) override
    {
      // The last share that was tried and failed is one to two resolutions beyond the last that was found.
      const double share = grow_friction(drive, 1., resolution).share;
      return share > 0. && share < 1. ? share + 0.75 * resolution : share;
    }

    std::vector<Eigenmode> vibrations(const HeldSlide &slide, const bool in_contact, const unsigned int number) override
    {
      if (frame.loss_factor == 0. || !in_contact)
        return vibrations_now(sliding_state(slide), in_contact, number);
      std::vector<Eigenmode> result;
      for (const auto &own : own_damped(slide, number))
      {
        const auto modes = vibrations_now(with_relaxation(slide, own.relaxation), in_contact, number);
        result.push_back(*std::min_element(modes.begin(), modes.end(),
                                           [&](const Eigenmode &a, const Eigenmode &b) {
                                             return std::abs(a.mode.eigenvalue - own.eigenvalue) <
                                                    std::abs(b.mode.eigenvalue - own.eigenvalue);
                                           }));
      }
      return result;
    }

    std::vector<std::complex<double>> eigenvalues(const HeldSlide &slide, const unsigned int number) override
    {
      if (frame.loss_factor == 0.)
        return eigenvalues_now(sliding_state(slide), number);
      return mapped(own_damped(slide, number), &OwnDamped::eigenvalue);
    }

    Motion perturbed(const HeldSlide &slide, const Eigenmode &eigenmode, const double amplitude) override
    {
      contact->evaluate_sliding(sliding_state(slide), found);
      const std::complex<double> size = amplitude / largest_gap_change(*contact, found, eigenmode.displacements);
      Motion motion                   = slide.motion;
      add_mode(size, eigenmode.mode, motion);
      dealii::Vector<double> displacements = slide.displacements;
      dealii::Vector<double> rates(displacements.size());
      add_real_part(size, eigenmode.displacements, displacements);
      add_real_part(size * eigenmode.mode.eigenvalue, eigenmode.displacements, rates);
      contact->evaluate_sliding(SlidingState{ displacements, slide.drive, slide.speed, &rates, slide.friction }, found);
      motion.contact = found.history();
      return motion;
    }

    ModeShape mode_shape(const Eigenmode &mode) const override
    {
      const auto at = [&](const unsigned int i)
      { return std::complex<double>(mode.displacements[0][i], mode.displacements[1][i]); };
      ModeShape result;
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
      {
        const auto real      = contact->surface_shape(mode.displacements[0], lever);
        const auto imaginary = contact->surface_shape(mode.displacements[1], lever);
        result.xi            = real.xi;
        result.levers.push_back(
            { { { real.along, imaginary.along } }, { { real.across, imaginary.across } }, {}, at(frame.layout.rotation(lever)) });
      }
      result.support = frame.layout.sprung ? at(frame.layout.support()) : 0.;
      return result;
    }

    StoredEnergy stored_energy(const Motion &motion) const override
    {
      StoredEnergy energy = structure->stored_energy(motion);
      (Contact::stands_for_layer ? energy.elastic : energy.contact) += found.energy();
      if (Contact::stands_for_layer)
        energy.layer = found.energy();
      energy.spring += hub_spring.energy(turns(motion));
      if (frame.layout.sprung)
        energy.kinetic += coupling.kinetic_energy(structure->kinematics(motion));
      return energy;
    }

    void observe(const Motion &motion, Row &row) const override
    {
      DofState support{};
      if (frame.layout.sprung)
        support = structure->dof_state(motion, frame.layout.support());
      const double x = motion.drive.x - support.position;
      observe_lever(motion, 0, x, row);
      if (frame.layout.levers == 2)
      {
        Row second;
        observe_lever(motion, 1, x, second);
        row.add_second_lever(second);
      }
      const double support_force        = frame.support_stiffness * support.position + frame.support_damping * support.velocity;
      row[Column::support_displacement] = support.position;
      row[Column::Q_support]            = (frame.layout.sprung ? support_force : row.drive_force()) / frame.layout.levers;
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

    void serialise_history(Archive &archive) override
    {
      structure->serialise_history(archive);
      contact->serialise_history(archive);
      slides.serialise_history(archive);
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
      DofSelection rotations;
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
        rotations.push_back(frame.layout.rotation(lever));
      return lever_rotations(frame.layout, structure->positions(motion, rotations));
    }

    /// `x` from the pivot frame's origin.
    void observe_lever(const Motion &motion, const unsigned int lever, const double x, Row &row) const
    {
      const auto hub          = structure->dof_state(motion, frame.layout.rotation(lever));
      row[Column::theta]      = frame.rest_inclination + hub.position;
      row[Column::theta_rate] = hub.velocity;
      observe_contact([&](const DofSelection &dofs) { return structure->positions(motion, dofs); }, lever, row);
      row[Column::centre_offset] = row[Column::s] - cylinder_centre(frame.geometries[lever], x, row[Column::theta]).xi;
      if (frame.layout.sensors == 0)
        return;
      DofSelection sensors;
      for (unsigned int i = 0; i < frame.layout.sensors; ++i)
        sensors.push_back(frame.layout.sensor(i, lever));
      const auto compressions = structure->positions(motion, sensors);
      const auto force        = [&](const unsigned int dof) { return frame.sensor_stiffness * compressions[dof]; };
      frame.observe_sensors(mapped(sensors, force), row);
    }

    const DofSelection &candidate_dofs(const Motion &motion) const
    {
      const double u = frame.layout.sprung ? structure->dof_state(motion, frame.layout.support()).position : 0.;
      return contact->candidate_dofs(motion.drive.x - u, compute_inclinations(frame, turns(motion)));
    }

    /// Touching at x = 0. Further on as slowly slid there from x = 0, with friction as in a motion forward and mu at rest.
    Motion start_at_rest(const DrivePoint &drive)
    {
      if (drive.x > 0. || frame.is_preloaded())
        return pressed_at_rest(drive, ContactFriction::sliding);
      Motion motion = structure->rest();
      motion.drive  = drive;
      // A cylinder out of the mirror plane presses on one lever from the beginning.
      if (frame.layout.levers == 2 && penetrates(structure->positions(motion), drive))
        return pressed_at_rest(drive, ContactFriction::none);
      contact->touch(structure->positions(motion), drive, found);
      motion.contact = found.history();
      return motion;
    }

    bool penetrates(const dealii::Vector<double> &displacements, const DrivePoint &drive)
    {
      contact->evaluate_sliding(SlidingState{ displacements, drive, 1., nullptr, ContactFriction::none }, found);
      return found.penetration() > 1e-9 * frame.geometries.front().cylinder_radius;
    }

    Motion pressed_at_rest(const DrivePoint &drive, const ContactFriction friction)
    {
      const InterfaceForces *const forces = slides.solve({ drive.time, drive.x, 0., 0. }, 1., friction);
      if (forces == nullptr)
        throw AnalysisError("no equilibrium at rest. Try another Drive/Start or a smaller Mirrored pair/Cylinder offset.");
      return completed(structure->deform(*forces), drive, *forces);
    }

    /// Fills the columns of a contact at its last evaluation. `positions`(dofs) returns displacements there.
    template <class Positions>
    void observe_contact([[maybe_unused]] const Positions &positions, const unsigned int lever, Row &row) const
    {
      contact->observe(found, row, lever);
      if constexpr (Contact::looks_beside)
      {
        const auto shares        = contact->indentation_shares(row, lever);
        row[Column::indentation] = 0.;
        if (shares.dofs.empty())
          return;
        const auto displacements = positions(shares.dofs);
        for (unsigned int i = 0; i < shares.dofs.size(); ++i)
          row[Column::indentation] += shares.values[i] * displacements[shares.dofs[i]];
      }
    }

    /// Columns of the contact of each lever at its last evaluation. `positions`: see observe_contact().
    template <class Positions>
    std::vector<Row> observed_contacts(const Positions &positions) const
    {
      std::vector<Row> rows(frame.layout.levers);
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
        observe_contact(positions, lever, rows[lever]);
      return rows;
    }

    /// P and Q of each lever at the last evaluation.
    std::vector<SlidingForces> last_forces() const
    {
      std::vector<Row> rows(frame.layout.levers);
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
        contact->observe(found, rows[lever], lever);
      return contact_forces(rows);
    }

    static std::vector<SlidingForces> contact_forces(const std::vector<Row> &contacts)
    {
      return mapped(contacts, [](const Row &row) { return SlidingForces{ row[Column::P], row[Column::Q] }; });
    }

    /// Indentation of the lever that is indented most [mm].
    static double largest_indentation(const std::vector<Row> &contacts)
    {
      double result = unknown;
      for (const Row &row : contacts)
        result = std::fmax(result, row[Column::indentation]);
      return result;
    }

    static SlidingState sliding_state(const HeldSlide &slide)
    {
      return { slide.displacements, slide.drive, slide.speed, nullptr, slide.friction };
    }

    /// The state of a slide whose contact and layer have another damping over their stiffness [s].
    SlidingState with_relaxation(const HeldSlide &slide, const double relaxation)
    {
      structure->use_relaxation(relaxation);
      auto state       = sliding_state(slide);
      state.relaxation = relaxation;
      return state;
    }

    std::vector<Eigenmode> vibrations_now(const SlidingState &state, const bool in_contact, const unsigned int number)
    {
      const auto forces = perturbation(state, in_contact);
      return explained(*structure, structure->vibrations(forces, number), forces, frame.layout);
    }

    std::vector<std::complex<double>> eigenvalues_now(const SlidingState &state, const unsigned int number)
    {
      return mapped(structure->vibrations(perturbation(state, true), number, false), &StructureMode::eigenvalue);
    }

    std::vector<OwnDamped> own_damped(const HeldSlide &slide, const unsigned int number)
    {
      return own_damped_vibrations(frame.loss_factor, number,
                                   [&](const double relaxation)
                                   { return eigenvalues_now(with_relaxation(slide, relaxation), number); });
    }

    /// The contact's forces about a held slide, those of the hub's spring and the coupling with a sprung support.
    LinearisedForces perturbation(const SlidingState &slide, const bool in_contact)
    {
      const auto slide_rotations      = lever_rotations(frame.layout, slide.displacements);
      const auto theta                = compute_inclinations(frame, slide_rotations);
      const auto contact_perturbation = in_contact ? contact->linearise(slide, found) : LinearisedForces();
      auto dofs                       = contact_perturbation.dofs;
      for (const auto &others : { coupling.coupled_dofs(), hub_spring.loaded_dofs() })
        append(dofs, others);
      sort_unique(dofs);

      LinearisedForces result(std::move(dofs));
      result.add(contact_perturbation);
      coupling.add_inertia(result.dofs, theta, result.inertia);
      hub_spring.add_stiffness(result.dofs, slide_rotations, result.pressure);
      return result;
    }

    /// The determinant that HeldSlide describes.
    double uniqueness(const SlidingState &slide)
    {
      structure->use_statics();
      const auto forces      = perturbation(slide, true);
      const auto determinant = [&](const dealii::FullMatrix<double> &tangent)
      { return InterfaceFactors(structure->compliance(), forces.dofs, tangent).determinant(); };
      return determinant(forces.stiffness()) / determinant(forces.pressure);
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
      dealii::Vector<double> round_off(frame.layout.size());
      for (unsigned int i = 0; i < most_corrections && force != nullptr; ++i)
      {
        auto change = structure->positions(structure->deform(*force));
        change -= slides.last.displacements;
        const auto counts = [&](const unsigned int dof)
        { return std::abs(frame.lengths[dof] * change[dof]) > 1e-10 * found.penetration(); };
        if (std::none_of(force->dofs.begin(), force->dofs.end(), counts))
          break;
        round_off += change;
        force = slides.solve(drive, ratio, law, &round_off);
      }
      if (force == nullptr)
        return {};
      HeldSlide slide;
      slide.drive         = drive;
      slide.motion        = completed(structure->deform(*force), { drive.time, drive.x, 0., 0. }, *force);
      slide.displacements = slides.last.displacements;
      slide.friction      = friction;
      slide.speed         = ratio * sliding_speed(frame.geometries.front(), drive.x, drive.v);
      slide.penetration   = found.penetration();
      const auto contacts = observed_contacts([&](const DofSelection &dofs) { return structure->positions(slide.motion, dofs); });
      slide.indentation   = largest_indentation(contacts);
      if (with_friction && slide.indentation > frame.largest_indentation)
        return {};
      slide.margin     = 1.;
      slide.mu         = with_friction ? contacts.front()[Column::mu] : 0.;
      const auto loads = contact_forces(contacts);
      slide.forces     = loads.front();
      if (loads.size() == 2)
        slide.second = loads.back();
      slide.uniqueness = uniqueness(sliding_state(slide));
      return slide;
    }

    /// The failure of the method, beyond a share of friction at which there is an equilibrium.
    static AnalysisError no_equilibrium(const DrivePoint &drive, const double share)
    {
      return AnalysisError(
          "no equilibrium found at x = " + mm(drive.x) + " with all of the friction" +
          (share < 1. ? "; with " + formatted("%.6g", 100. * share) + " % of it there is one" : "") +
          ", and no fold at which the lever would jam. Try another Friction/Factor, Stability/Position or mesh.");
    }

    /// Returns the slide where its branch ends, if any, as one that jams. Throws where it does not end at a fold.
    static std::optional<HeldSlide> jammed(const DrivePoint &drive, const std::optional<HeldSlide> &slide, const BranchEnd &end)
    {
      if (!slide && !end.jams)
        throw no_equilibrium(drive, end.share);
      return slide;
    }

    /// Follows the equilibrium at a ratio of speeds from no friction to the scene's, in steps that are halved where Newton's
    /// method fails or has left the branch. It jams where the branch ends at a fold, or with a layer pressed too far. Where it
    /// ends elsewhere another branch crosses it, or the method fails.
    BranchEnd grow_friction(const DrivePoint &drive, const double ratio, const double smallest_step = 1e-4)
    {
      constexpr double near_fold = 1e-2; // shares of the friction
      if (slides.solve(drive, 1., ContactFriction::none) == nullptr)
      {
        slides.last = {}; // of another slide, too far off
        slides.solve(drive, 1., ContactFriction::none);
      }
      const double speed   = ratio * sliding_speed(frame.geometries.front(), drive.x, drive.v);
      const auto is_unique = [&](const double share)
      {
        const auto displacements = slides.last.displacements;
        return uniqueness({ displacements, drive, speed, nullptr, ContactFriction::sliding, share }) > 0.;
      };
      std::vector<BranchPoint> branch = { { 0., found.penetration() } };
      bool is_pressed_too_far         = false;
      for (double step = 0.25; branch.back().share < 1. && step > smallest_step;)
      {
        const double next      = std::min(1., branch.back().share + step);
        const auto before      = slides.last;
        const bool is_followed = slides.solve_with_share(drive, ratio, next) != nullptr && is_unique(next);
        const auto positions   = [&](const DofSelection &dofs)
        { return structure->positions(structure->deform(found.forces), dofs); };
        is_pressed_too_far = is_followed && largest_indentation(observed_contacts(positions)) > frame.largest_indentation;
        if (is_followed && !is_pressed_too_far)
        {
          branch.push_back({ next, found.penetration() });
          step *= 1.5;
        }
        else
        {
          slides.last = before;
          step *= 0.5;
        }
      }
      return { branch.back().share, is_pressed_too_far || !(distance_to_fold(branch) > near_fold) };
    }

    std::optional<Motion> sliding(const DrivePoint &drive, const double ratio)
    {
      const InterfaceForces *const forces = slides.solve(drive, ratio);
      if (forces == nullptr)
        return {};
      return completed(structure->deform(*forces), drive, *forces);
    }

    /// Adds to a motion what the structure does not know: drive, history of the contact and its forces.
    Motion completed(Motion motion, const DrivePoint &drive, const InterfaceForces &forces) const
    {
      motion.drive   = drive;
      motion.forces  = forces;
      motion.contact = found.history();
      return motion;
    }
  };
} // namespace sprag
