// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/jamming.h"
#include "base/errors.h"
#include "model/lever/reduced_lever.h"
#include "scene/contact_estimates.h"
#include "scene/device.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// The scene as a beam moving at x with a constant mu; none where it has no equilibrium, or not a unique one.
    std::optional<HeldSlide> beam_slide(const Device &device, const JammingMargin &at, const double mu)
    {
      const auto law         = face_law(device);
      Device beam            = device;
      beam.contact.stiffness = law.stiffness;
      beam.contact.exponent  = law.exponent;
      beam.analysis.model    = ModelType::beam;
      beam.friction          = {};
      beam.friction.law      = CoulombFriction{ mu };
      beam.support.type      = SupportType::rigid;
      beam.contact.type      = ContactType::compliant;
      const double v         = std::copysign(device.drive.peak_speed(), at.v);
      try
      {
        auto slide = make_reduced_lever(beam)->hold({ 0., at.x, v, 0. }, ContactFriction::sliding);
        if (slide && slide->forces.P > 0. && slide->uniqueness > 0.)
          return slide;
      }
      catch (const AnalysisError &)
      {
        // No such equilibrium is found.
      }
      return {};
    }

    /// Bisection between a mu at which the equilibrium is unique and one at which it is not.
    std::optional<double> critical_mu(const Device &device, const JammingMargin &at, double unique, double jammed)
    {
      const auto is_unique = [&](const double mu) { return beam_slide(device, at, mu).has_value(); };
      if (!is_unique(unique) || is_unique(jammed))
        return {};
      while (jammed - unique > 1e-4 * jammed)
      {
        const double middle                   = 0.5 * (unique + jammed);
        (is_unique(middle) ? unique : jammed) = middle;
      }
      return 0.5 * (unique + jammed);
    }

    void add_flexure(const Device &device, JammingMargin &margin)
    {
      constexpr double largest_mu = 5.;
      if (const auto slide = beam_slide(device, margin, margin.mu))
        margin.flexible = slide->margin;
      margin.flexible_critical_mu = critical_mu(device, margin, 0., std::min(3. * margin.critical_mu, largest_mu));
    }
  } // namespace

  JammingMargin jamming_margin(const Device &device, const bool flexible)
  {
    JammingMargin margin = rigid_jamming_margin(device);
    if (flexible)
      add_flexure(device, margin);
    return margin;
  }
} // namespace sprag
