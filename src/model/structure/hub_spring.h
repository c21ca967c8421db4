// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/moment_law.h"
#include "model/interface/interface_layout.h"
#include "model/step/dynamic_model.h"

#include <algorithm>
#include <vector>

namespace sprag
{
  /// The rotational springs' moments in excess of k phi of each hub, k the law's linear stiffness, as forces on the hubs'
  /// rotations; k phi belongs to the structure. A linear spring of each lever's own does nothing and costs nothing.
  ///
  /// The springs of a mirrored pair whose joint nothing else carries take up what both levers open, energy
  /// 2 W((phi_1 + phi_2)/2) with W that of the law, and swing with them: of the stiffness against swinging,
  /// (phi_1 - phi_2)/2, a small share is left, so that levers which touch nothing have a place.
  class HubSpringExcess
  {
  public:
    /// A law for each lever. `joined`: by a free joint; needs two levers, and the first law counts. `swing_stiffness`: the share
    /// of k then left against swinging.
    HubSpringExcess(const InterfaceLayout &layout, std::vector<MomentLaw> laws, bool joined = false,
                    double swing_stiffness = 1e-6);

    /// Adds the forces of a step from some turns of the hubs to others: the mean over the turn (discrete gradient) with
    /// generalised-alpha's delay, so that no energy is made.
    void add_forces(const PerLever &begin, const PerLever &end, const StepWeights &weights, InterfaceForces &forces) const;

    /// Adds the forces at turns of the hubs. Where nothing else holds the swing of joined springs, the tangent is that of springs
    /// which leave it where it is.
    void add_forces(const PerLever &turns, bool swing_is_held, InterfaceForces &forces) const;

    /// Adds the algorithmic dissipation of the step.
    void add_work(const PerLever &begin, const PerLever &end, const StepWeights &weights, StepWork &work) const;

    /// [N mm]
    double energy(const PerLever &turns) const;

    /// Adds the derivative of the forces to the matrix of those dofs, which hold loaded_dofs().
    void add_stiffness(const DofSelection &dofs, const PerLever &turns, dealii::FullMatrix<double> &stiffness) const;

    /// The rotations, or none where it does nothing.
    DofSelection loaded_dofs() const;

  private:
    /// Moments on the hubs and their derivatives by the turns.
    struct Moments
    {
      PerLever values{};
      std::array<PerLever, 2> tangent{};
    };

    bool is_active() const
    {
      return joined || !std::all_of(laws.begin(), laws.end(), [](const MomentLaw &law) { return law.is_linear(); });
    }

    template <class Excess>
    Moments find_moments(const Excess &excess, double moment, double moment_stiffness) const;
    Moments moments_at(const PerLever &turns, bool swing_is_held) const;
    void add(const Moments &moments, InterfaceForces &forces) const;

    const InterfaceLayout layout;
    const std::vector<MomentLaw> laws;
    const bool joined;
    const double coupling_stiffness; ///< stiffness against swinging that the joint takes from the structure's [N mm/rad]
  };
} // namespace sprag
