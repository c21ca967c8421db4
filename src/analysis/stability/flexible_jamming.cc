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
    /// Makes the scene's beam on the law of its layer, with a constant mu.
    std::unique_ptr<DynamicModel> make_beam(const Device &device, const double mu)
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
      return make_reduced_lever(beam);
    }

    void add_flexure(const Device &device, JammingMargin &margin)
    {
      constexpr double largest_mu = 5., resolution = 1e-5;
      const DrivePoint drive{ 0., margin.x, std::copysign(device.drive.peak_speed(), margin.v), 0. };
      try
      {
        const auto slide = make_beam(device, margin.mu)->hold(drive, ContactFriction::sliding);
        if (slide && slide->forces.P > 0. && slide->uniqueness > 0.)
          margin.flexible = slide->margin;
      }
      catch (const AnalysisError &)
      {
        // No such equilibrium is found.
      }
      try
      {
        const double mu    = std::min(3. * margin.critical_mu, largest_mu);
        const double share = make_beam(device, mu)->largest_friction_share(drive, resolution);
        if (share > 0. && share < 1.)
          margin.flexible_critical_mu = share * mu;
      }
      catch (const AnalysisError &)
      {
        // The slide cannot be followed.
      }
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
