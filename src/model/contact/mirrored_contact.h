// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact/contact_of_levers.h"
#include "model/interface/interface_layout.h"
#include "model/step/interface_step.h"
#include "model/step/linearisation.h"
#include "model/structure/joined_interfaces.h"

#include <algorithm>
#include <array>
#include <memory>

namespace sprag
{
  /// The contacts of both levers of a mirrored pair, each with dofs of its own in its own axes. Contact: see PointContact.
  template <class Contact>
  class MirroredContact
  {
  public:
    static constexpr bool uses_rates       = Contact::uses_rates;
    static constexpr bool stands_for_layer = Contact::stands_for_layer;
    static constexpr bool looks_beside     = Contact::looks_beside;
    static constexpr unsigned int levers   = 2;

    /// Result of an evaluation.
    struct Evaluation
    {
      std::array<typename Contact::Evaluation, 2> per_lever;
      InterfaceForces forces;
      bool within_candidates = true;
      unsigned int points    = 0; ///< of a lever, see joined_history()

      auto history() const
      {
        return joined_history(points, per_lever[0].history(), per_lever[1].history());
      }
      StepWork work() const
      {
        StepWork result = per_lever[0].work();
        result += per_lever[1].work();
        return result;
      }
      double energy() const
      {
        return per_lever[0].energy() + per_lever[1].energy();
      }
      double penetration() const
      {
        return std::max(per_lever[0].penetration(), per_lever[1].penetration());
      }
    };

    /// `layout` is the pair's; histories of a contact number fewer than `points`.
    MirroredContact(std::array<std::unique_ptr<Contact>, 2> contacts, const InterfaceLayout &layout_, const unsigned int points_)
        : contact(std::move(contacts))
        , layout(layout_)
        , points(points_)
    {
    }

    bool keeps_tangent() const
    {
      return contact[0]->keeps_tangent();
    }

    void evaluate(const InterfaceStep &step, Evaluation &found) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto history = lever_history(lever, points, step.history);
        const Kinematic begin{ lever_part(lever, step.begin.position), lever_part(lever, step.begin.velocity),
                               lever_part(lever, step.begin.acceleration) };
        const auto end  = lever_part(lever, step.end);
        const auto rate = lever_part(lever, step.end_rate);
        contact[lever]->evaluate(InterfaceStep{ step.from, history, step.to, begin, end, rate, step.weights, step.request },
                                 found.per_lever[lever]);
      }
      join(found);
    }

    void evaluate_sliding(const SlidingState &state, Evaluation &found) const
    {
      for_each_lever(state, found,
                     [&](const unsigned int lever, const SlidingState &own)
                     { contact[lever]->evaluate_sliding(own, found.per_lever[lever]); });
    }

    LinearisedForces linearise(const SlidingState &state, Evaluation &found) const
    {
      std::array<LinearisedForces, 2> own;
      for_each_lever(state, found,
                     [&](const unsigned int lever, const SlidingState &sliding)
                     { own[lever] = contact[lever]->linearise(sliding, found.per_lever[lever]); });
      LinearisedForces result(found.forces.dofs);
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        for (auto &dof : own[lever].dofs)
          dof = joined_dof(layout, lever, dof);
        result.add(own[lever]);
      }
      return result;
    }

    const DofSelection &candidate_dofs(const double x, const PerLever &theta)
    {
      candidates.clear();
      for (unsigned int lever = 0; lever < levers; ++lever)
        for (const unsigned int dof : contact[lever]->candidate_dofs(x, { { theta[lever] } }))
          if (dof < layout.dofs_per_lever())
            candidates.push_back(layout.first(lever) + dof);
      if (layout.sprung)
        candidates.push_back(layout.support());
      return candidates;
    }

    void widen_candidates()
    {
      for (const auto &lever_contact : contact)
        lever_contact->widen_candidates();
    }

    void touch(const dealii::Vector<double> &displacements, const DrivePoint &drive, Evaluation &found) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
        contact[lever]->touch(lever_part(lever, displacements), drive, found.per_lever[lever]);
      join(found);
    }

    double gap_change(const Evaluation &found, const dealii::Vector<double> &change, const unsigned int lever) const
    {
      return contact[lever]->gap_change(found.per_lever[lever], lever_part(lever, change));
    }

    /// Mean slip of the first lever [mm].
    double mean_slip(const Evaluation &found, const dealii::Vector<double> &from, const double from_x,
                     const dealii::Vector<double> &to, const double to_x) const
    {
      return contact[0]->mean_slip(found.per_lever[0], lever_part(0, from), from_x, lever_part(0, to), to_x);
    }

    void observe(const Evaluation &found, Row &row, const unsigned int lever) const
    {
      contact[lever]->observe(found.per_lever[lever], row);
    }

    DofLoads indentation_shares(const Row &row, const unsigned int lever) const
    {
      auto shares = contact[lever]->indentation_shares(row);
      for (unsigned int &dof : shares.dofs)
        dof += layout.first(lever);
      return shares;
    }

    double drive_force(const Evaluation &found) const
    {
      return contact[0]->drive_force(found.per_lever[0]) + contact[1]->drive_force(found.per_lever[1]);
    }

    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, const unsigned int lever) const
    {
      return contact[lever]->surface_shape(lever_part(lever, displacements));
    }

    /// Points of the face of either lever.
    FacePoints face_points() const
    {
      return contact[0]->face_points();
    }
    FaceState face_state(const Evaluation &found, const DrivePoint &drive) const
    {
      return joined_faces(contact[0]->face_state(found.per_lever[0], drive), contact[1]->face_state(found.per_lever[1], drive));
    }

    void serialise_history(Archive &archive)
    {
      for (const auto &lever_contact : contact)
        lever_contact->serialise_history(archive);
    }

  private:
    const std::array<std::unique_ptr<Contact>, 2> contact;
    const InterfaceLayout layout;
    const unsigned int points;
    DofSelection candidates;

    dealii::Vector<double> lever_part(const unsigned int lever, const dealii::Vector<double> &pair_displacements) const
    {
      return extract_lever(layout, lever, pair_displacements);
    }

    /// Evaluates both contacts, each at its own displacements.
    template <class Evaluate>
    void for_each_lever(const SlidingState &state, Evaluation &found, const Evaluate &evaluate) const
    {
      for (unsigned int lever = 0; lever < levers; ++lever)
      {
        const auto displacements = lever_part(lever, state.displacements);
        const auto rates         = state.rates != nullptr ? lever_part(lever, *state.rates) : dealii::Vector<double>();
        evaluate(lever, SlidingState{ displacements, state.drive, state.speed, state.rates != nullptr ? &rates : nullptr,
                                      state.friction, state.friction_share, state.relaxation });
      }
      join(found);
    }

    void join(Evaluation &found) const
    {
      const auto &evaluations = found.per_lever;
      join_forces(layout, { &evaluations[0].forces, &evaluations[1].forces }, found.forces);
      found.within_candidates = evaluations[0].within_candidates && evaluations[1].within_candidates;
      found.points            = points;
    }
  };
} // namespace sprag
