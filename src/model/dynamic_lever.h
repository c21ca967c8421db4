#pragma once

#include "base/errors.h"
#include "model/circle.h"
#include "model/dynamic_model.h"
#include "model/frame_coupling.h"
#include "model/lever_frame.h"
#include "model/port_newton.h"
#include "model/port_step.h"
#include "scene/closed_form.h"

#include <cmath>
#include <memory>

namespace sprag
{
  /// A linear structure in unilateral frictional contact, in time.
  /// Structure: see ModalStructure. Contact: see PointContact.
  template <class Structure, class Contact>
  class DynamicLever : public DynamicModel
  {
  public:
    DynamicLever(std::unique_ptr<Structure> structure_, std::unique_ptr<Contact> contact_, LeverFrame frame_)
        : structure(std::move(structure_))
        , contact(std::move(contact_))
        , frame(std::move(frame_))
        , coupling(frame.ports, frame.rest_inclination)
    {
    }

    Motion initial_motion(const DrivePoint &drive) override
    {
      if (drive.v == 0.)
        return start_at_rest(drive);
      // Velocity and acceleration from equilibria to both sides; far enough apart to average over single points of a face.
      const double h     = 1e-3 * frame.geometry.cylinder_radius;
      const double ratio = speed_ratio(drive, h);
      const auto before  = sliding(moved(drive, -h), ratio);
      const auto after   = sliding(moved(drive, h), ratio);
      auto here          = sliding(drive, ratio);
      if (!before || !after || !here)
        throw AnalysisError("no equilibrium of steady sliding at x = " + std::to_string(drive.x) +
                            " mm. Try a smaller friction coefficient or another Drive/Start.");
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

      dealii::Vector<double> rate;
      const auto evaluate = [&](const dealii::Vector<double> &z) -> const PortForces &
      {
        if (rates)
        {
          rate = drifted.velocity;
          rate.add(weights.rate(), z, -weights.rate(), drifted.position);
        }
        contact->evaluate(PortStep{ accepted, to, begin, z, rate, weights });
        return coupling.add_forces(contact->forces(), begin, z, weights);
      };

      StepOutcome outcome;
      dealii::Vector<double> z = free;
      const auto &last         = accepted.forces;
      add_response(structure->compliance(), last.ports, last.values, near, z);
      const auto solved = solve_ports(
          structure->compliance(), free, frame.lengths, near, evaluate, [&] { return contact->overlap(); }, z);
      outcome.iterations = solved.iterations;
      if (!solved.converged)
        return outcome;
      if (!contact->within_reach())
      {
        contact->widen_reach();
        return step(accepted, to, weights);
      }

      Motion motion = completed(structure->advance(accepted, *solved.forces, to), to, *solved.forces);
      structure->add_work(accepted, motion, outcome.work);
      contact->add_work(outcome.work);
      coupling.add_work(begin, z, weights, outcome.work);
      outcome.error  = weights.wants_error ? std::abs(contact->gap_change(structure->port_error(accepted, motion))) : 0.;
      outcome.motion = std::move(motion);
      return outcome;
    }

    std::optional<SlidingForces> sliding_forces(const DrivePoint &drive) override
    {
      if (drive.v == 0.)
        return {};
      if (solve_sliding(drive, 1.) == nullptr)
        return {};
      Row row;
      contact->observe(row);
      return SlidingForces{ row[Column::P], row[Column::Q] };
    }

    StoredEnergy stored_energy(const Motion &motion) const override
    {
      StoredEnergy energy = structure->stored_energy(motion);
      energy.contact      = contact->energy();
      if (frame.ports.sprung)
        energy.kinetic += coupling.kinetic_energy(structure->port_kinematics(motion));
      return energy;
    }

    void observe(const Motion &motion, Row &row) const override
    {
      const auto hub          = structure->port_state(motion, frame.ports.rotation());
      row[Column::theta]      = frame.rest_inclination + hub.position;
      row[Column::theta_rate] = hub.velocity;
      contact->observe(row);
      row[Column::support_displacement] = 0.;
      row[Column::Q_support]            = row[Column::Q];
      if (frame.ports.sprung)
      {
        const auto support                = structure->port_state(motion, frame.ports.support());
        row[Column::support_displacement] = support.position;
        row[Column::Q_support]            = frame.support_stiffness * support.position + frame.support_damping * support.velocity;
      }
      const double x             = motion.drive.x - row[Column::support_displacement];
      row[Column::centre_offset] = row[Column::s] - cylinder_centre(frame.geometry, x, row[Column::theta]).xi;
    }

    FacePoints face_points() const override
    {
      return contact->face_points();
    }

    FaceState face_state(const Motion &motion) const override
    {
      return contact->face_state(motion.drive);
    }

  private:
    const std::unique_ptr<Structure> structure;
    const std::unique_ptr<Contact> contact;
    const LeverFrame frame;
    FrameCoupling coupling;
    dealii::Vector<double> last_sliding; ///< ports of the last equilibrium, from which the next one starts
    PortLoads last_forces;               ///< there
    double last_sliding_theta = 0.;      ///< of the ideal contact there

    const PortSelection &reachable_ports(const Motion &motion) const
    {
      const double theta = frame.rest_inclination + structure->port_state(motion, frame.ports.rotation()).position;
      const double u     = frame.ports.sprung ? structure->port_state(motion, frame.ports.support()).position : 0.;
      return contact->reachable_ports(motion.drive.x - u, theta);
    }

    static DrivePoint moved(DrivePoint drive, const double dx)
    {
      drive.x += dx;
      return drive;
    }

    Motion start_at_rest(const DrivePoint &drive)
    {
      Motion motion  = structure->rest();
      motion.drive   = drive;
      motion.contact = contact->touch(structure->port_positions(motion), drive);
      return motion;
    }

    /// Slip speed of the deformable lever over that of the rigid one.
    double speed_ratio(const DrivePoint &drive, const double h)
    {
      const bool before = solve_sliding(moved(drive, -h), 1.) != nullptr;
      const auto from   = last_sliding;
      const bool after  = solve_sliding(moved(drive, h), 1.) != nullptr;
      if (!before || !after)
        return 1.;
      const double slip = contact->mean_slip(from, drive.x - h, last_sliding, drive.x + h);
      return slip / (2. * h * sliding_speed(frame.geometry, drive.x, 1.));
    }

    /// Contact and its forces in steady sliding at the ratio of speeds; null where there is no equilibrium.
    const PortForces *solve_sliding(const DrivePoint &drive, const double ratio)
    {
      structure->use_statics();
      const unsigned int hub            = frame.ports.rotation();
      const double ideal                = kinematics(frame.geometry, drive.x).theta;
      const auto &near                  = contact->reachable_ports(drive.x, ideal);
      const dealii::Vector<double> free = structure->port_positions(structure->rest(), near);
      dealii::Vector<double> z          = free;
      add_response(structure->compliance(), last_forces.ports, last_forces.values, near, z);
      z[hub] = (last_sliding.size() > 0 ? last_sliding[hub] - last_sliding_theta : -frame.rest_inclination) + ideal;

      const double speed  = ratio * sliding_speed(frame.geometry, drive.x, drive.v);
      const auto evaluate = [&](const dealii::Vector<double> &ports) -> const PortForces &
      {
        contact->evaluate_sliding(ports, drive, speed);
        return contact->forces();
      };
      const auto solved = solve_ports(
          structure->compliance(), free, frame.lengths, near, evaluate, [&] { return contact->overlap(); }, z);
      if (!solved.converged)
        return nullptr;
      if (!contact->within_reach())
      {
        contact->widen_reach();
        return solve_sliding(drive, ratio);
      }
      last_sliding       = z;
      last_sliding_theta = ideal;
      last_forces        = { solved.forces->ports, solved.forces->values };
      return solved.forces;
    }

    std::optional<Motion> sliding(const DrivePoint &drive, const double ratio)
    {
      const PortForces *const forces = solve_sliding(drive, ratio);
      if (forces == nullptr)
        return {};
      return completed(structure->deform(*forces), drive, *forces);
    }

    /// With what the structure does not know: drive, memory of the contact and its forces.
    Motion completed(Motion motion, const DrivePoint &drive, const PortForces &forces) const
    {
      motion.drive   = drive;
      motion.contact = contact->memory();
      motion.forces  = { forces.ports, forces.values };
      return motion;
    }
  };
} // namespace sprag
