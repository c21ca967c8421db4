// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact/circle.h"
#include "model/contact/contact_of_levers.h"
#include "model/step/interface_step.h"
#include "model/step/linearisation.h"
#include "model/step/state_archive.h"
#include "model/structure/hub_spring.h"
#include "model/structure/joined_interfaces.h"
#include "model/structure/lever_frame.h"
#include "scene/closed_form.h"

#include <optional>

namespace sprag
{
  /// Inclinations of the levers by turns of their hubs [rad].
  inline PerLever compute_inclinations(const LeverFrame &frame, const PerLever &turns)
  {
    return { { frame.rest_inclination + turns[0], frame.rest_inclination + turns[1] } };
  }

  /// The drive at another position.
  inline DrivePoint moved(DrivePoint drive, const double dx)
  {
    drive.x += dx;
    return drive;
  }

  /// Equilibria of a structure in contact with the cylinder that slides on it steadily, each sought from the one before.
  /// Structure and Contact: see DynamicLever.
  template <class Structure, class Contact>
  class SteadySlides
  {
  public:
    /// The last equilibrium, from which the next one is sought.
    struct Equilibrium
    {
      dealii::Vector<double> displacements;
      DofLoads forces;
      PerLever ideal{}; ///< inclinations of the levers in ideal contact
    };

    /// All are kept by reference.
    SteadySlides(Structure &structure_, Contact &contact_, typename Contact::Evaluation &found_, const LeverFrame &frame_,
                 HubSpringExcess &hub_spring_)
        : structure(structure_)
        , contact(contact_)
        , found(found_)
        , frame(frame_)
        , hub_spring(hub_spring_)
    {
    }

    /// Finds the equilibrium of steady sliding at a ratio of speeds, see speed_ratio(). Returns its forces, for which the contact
    /// was evaluated last, and null where none is found. `round_off`: displacements that the interface has besides.
    const InterfaceForces *solve(const DrivePoint &drive, const double ratio,
                                 const ContactFriction friction          = ContactFriction::sliding,
                                 const dealii::Vector<double> *round_off = nullptr)
    {
      if (const auto *forces = solve_from_last(drive, ratio, friction, round_off))
        return forces;
      // Between points that just touch Newton's method may go round in a circle; from a neighbour it comes another way.
      const double nearby = 1e-3 * frame.geometries.front().cylinder_radius;
      for (const double dx : { -nearby, nearby })
        if (solve_from_last(moved(drive, dx), ratio, friction, nullptr) != nullptr)
          if (const auto *forces = solve_from_last(drive, ratio, friction, round_off))
            return forces;
      return nullptr;
    }

    /// Does as solve() with a share of the friction, 0 to 1, from the last equilibrium alone.
    const InterfaceForces *solve_with_share(const DrivePoint &drive, const double ratio, const double share)
    {
      return solve_from_last(drive, ratio, ContactFriction::sliding, nullptr, share);
    }

    /// Returns the slip speed of the deformable lever over that of the rigid one, slip(x - h to x + h)/(2 h w_rigid), with
    /// w_rigid the rigid slip speed per drive speed and h in mm; none where there is no slide at one of both. The next
    /// equilibrium is sought from the mean of both.
    std::optional<double> speed_ratio(const DrivePoint &drive, const double h)
    {
      return speed_ratio(drive, h, [this](const DrivePoint &at) { return solve(at, 1.) != nullptr; });
    }

    /// Does as speed_ratio(), with slides that `find`(at) makes the last ones. It returns false where there is none.
    template <class Find>
    std::optional<double> speed_ratio(const DrivePoint &drive, const double h, const Find &find)
    {
      const bool before = find(moved(drive, -h));
      const auto from   = last;
      const bool after  = find(moved(drive, h));
      if (!before || !after)
        return {};
      const double slip = contact.mean_slip(found, from.displacements, drive.x - h, last.displacements, drive.x + h);
      last              = mean(from, last);
      return slip / (2. * h * sliding_speed(frame.geometries.front(), drive.x, 1.));
    }

    Equilibrium last; ///< that was found, from which the next one is sought

    /// Serialises the equilibrium from which the next one is sought.
    void serialise_history(Archive &archive)
    {
      archive(last.displacements, last.forces, last.ideal);
    }

  private:
    Structure &structure;
    Contact &contact;
    typename Contact::Evaluation &found; ///< the model's
    const LeverFrame &frame;
    HubSpringExcess &hub_spring;

    static Equilibrium mean(const Equilibrium &a, const Equilibrium &b)
    {
      Equilibrium result = a;
      result.displacements.sadd(0.5, 0.5, b.displacements);
      for (double &value : result.forces.values)
        value *= 0.5;
      add_dofs(b.forces.dofs, result.forces);
      for (unsigned int i = 0; i < b.forces.dofs.size(); ++i)
        result.forces.values[find_index(b.forces.dofs[i], result.forces.dofs)] += 0.5 * b.forces.values[i];
      for (std::size_t lever = 0; lever < result.ideal.size(); ++lever)
        result.ideal[lever] = 0.5 * (a.ideal[lever] + b.ideal[lever]);
      return result;
    }

    /// Evaluates the contact at interface displacements.
    InterfaceEvaluation evaluate(const SlidingState &state)
    {
      contact.evaluate_sliding(state, found);
      hub_spring.add_forces(lever_rotations(frame.layout, state.displacements), true, found.forces);
      return { &found.forces, found.penetration() };
    }

    /// See solve(), from the last equilibrium.
    const InterfaceForces *solve_from_last(const DrivePoint &drive, const double ratio, const ContactFriction friction,
                                           const dealii::Vector<double> *round_off, const double share = 1.)
    {
      structure.use_statics();
      PerLever ideal{};
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
        ideal[lever] = kinematics(frame.geometries[lever], drive.x).theta;
      const auto &near            = contact.candidate_dofs(drive.x, ideal);
      dealii::Vector<double> free = structure.positions(structure.rest(), near);
      if (round_off != nullptr)
        for (const unsigned int dof : near)
          free[dof] += (*round_off)[dof];
      dealii::Vector<double> z = free;
      add_response(structure.compliance(), last.forces.dofs, last.forces.values, near, z);
      for (unsigned int lever = 0; lever < frame.layout.levers; ++lever)
      {
        // The hub turns on from the last equilibrium as ideal contact does.
        const unsigned int hub = frame.layout.rotation(lever);
        z[hub] = (last.displacements.size() > 0 ? last.displacements[hub] - last.ideal[lever] : -frame.rest_inclination) +
                 ideal[lever];
      }

      const double speed = ratio * sliding_speed(frame.geometries.front(), drive.x, drive.v);
      const auto at      = [&](const dealii::Vector<double> &displacements) {
        return evaluate({ displacements, drive, speed, nullptr, friction, share });
      };
      const auto solved = solve_interface({ structure.compliance(), free, frame.lengths, near }, at, z);
      if (!solved.newton.converged)
        return nullptr;
      if (!found.within_candidates)
      {
        contact.widen_candidates();
        return solve_from_last(drive, ratio, friction, round_off, share);
      }
      last = { z, *solved.forces, ideal };
      return solved.forces;
    }
  };
} // namespace sprag
