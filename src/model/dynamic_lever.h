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
      Kinematic begin  = rates ? structure->port_kinematics(accepted) : Kinematic{ structure->port_positions(accepted), {}, {} };
      const Kinematic drifted = rates ? unaccelerated(begin, weights) : Kinematic{};
      const auto free         = structure->free_ports(accepted);

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
      add_response(structure->compliance(), last.ports, last.values, z);
      const auto solved = solve_ports(
          structure->compliance(), free, frame.lengths, evaluate, [&] { return contact->overlap(); }, z);
      outcome.iterations = solved.iterations;
      if (!solved.converged)
        return outcome;

      Motion motion        = structure->advance(accepted, *solved.forces, to);
      motion.drive         = to;
      motion.contact       = contact->memory();
      motion.forces.ports  = solved.forces->ports;
      motion.forces.values = solved.forces->values;
      structure->add_work(accepted, motion, outcome.work);
      contact->add_work(outcome.work);
      coupling.add_work(begin, z, weights, outcome.work);
      outcome.error  = std::abs(contact->gap_change(structure->port_error(accepted, motion)));
      outcome.motion = std::move(motion);
      return outcome;
    }

    std::optional<SlidingForces> sliding_forces(const DrivePoint &drive) override
    {
      if (drive.v == 0.)
        return {};
      if (!sliding(drive, 1.))
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
      const auto ports        = structure->port_kinematics(motion);
      const unsigned int hub  = frame.ports.rotation();
      row[Column::theta]      = frame.rest_inclination + ports.position[hub];
      row[Column::theta_rate] = ports.velocity[hub];
      contact->observe(row);
      row[Column::support_displacement] = 0.;
      row[Column::Q_support]            = row[Column::Q];
      double x_lever                    = motion.drive.x;
      if (frame.ports.sprung)
      {
        const unsigned int u              = frame.ports.support();
        row[Column::support_displacement] = ports.position[u];
        row[Column::Q_support] = frame.support_stiffness * ports.position[u] + frame.support_damping * ports.velocity[u];
        x_lever -= ports.position[u];
      }
      row[Column::centre_offset] = row[Column::s] - cylinder_centre(frame.geometry, x_lever, row[Column::theta]).xi;
    }

    FacePoints face_points() const override
    {
      return contact->face_points();
    }

    FaceState face_state(const Motion &motion) const override
    {
      return contact->face_state(motion.drive);
    }

    const Structure &linear_structure() const
    {
      return *structure;
    }

    const Contact &contact_law() const
    {
      return *contact;
    }

  private:
    const std::unique_ptr<Structure> structure;
    const std::unique_ptr<Contact> contact;
    const LeverFrame frame;
    FrameCoupling coupling;
    dealii::Vector<double> last_sliding; ///< ports of the last equilibrium, from which the next one starts
    double last_sliding_theta = 0.;      ///< of the ideal contact there

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
      const auto before = sliding(moved(drive, -h), 1.);
      const auto from   = last_sliding;
      const auto after  = sliding(moved(drive, h), 1.);
      if (!before || !after)
        return 1.;
      const double slip = contact->mean_slip(from, drive.x - h, last_sliding, drive.x + h);
      return slip / (2. * h * sliding_speed(frame.geometry, drive.x, 1.));
    }

    std::optional<Motion> sliding(const DrivePoint &drive, const double ratio)
    {
      structure->use_statics();
      const unsigned int hub            = frame.ports.rotation();
      const double ideal                = kinematics(frame.geometry, drive.x).theta;
      dealii::Vector<double> z          = structure->port_positions(structure->rest());
      const dealii::Vector<double> free = z;
      if (last_sliding.size() == z.size())
        z = last_sliding;
      z[hub] += ideal - (last_sliding.size() == z.size() ? last_sliding_theta : frame.rest_inclination);
      const double speed  = ratio * sliding_speed(frame.geometry, drive.x, drive.v);
      const auto evaluate = [&](const dealii::Vector<double> &ports) -> const PortForces &
      {
        contact->evaluate_sliding(ports, drive, speed);
        return contact->forces();
      };
      const auto solved = solve_ports(
          structure->compliance(), free, frame.lengths, evaluate, [&] { return contact->overlap(); }, z);
      if (!solved.converged)
        return {};
      last_sliding         = z;
      last_sliding_theta   = ideal;
      Motion motion        = structure->deform(*solved.forces);
      motion.drive         = drive;
      motion.contact       = contact->memory();
      motion.forces.ports  = solved.forces->ports;
      motion.forces.values = solved.forces->values;
      return motion;
    }
  };
} // namespace sprag
