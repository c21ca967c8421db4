#include "analysis/jamming.h"

#include "base/errors.h"
#include "base/text.h"
#include "model/reduced_lever.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    constexpr unsigned int samples = 64;

    /// The scene as a beam moving back at x with a constant mu; none where it has no equilibrium, or not a unique one.
    std::optional<HeldSlide> beam_slide(const Scene &scene, const double x, const double mu)
    {
      Scene beam          = scene;
      beam.analysis.model = ModelType::beam;
      beam.friction       = {};
      beam.friction.law   = CoulombFriction{ mu };
      beam.support.type   = SupportType::rigid;
      beam.contact.type   = ContactType::compliant;
      auto slide          = make_reduced_lever(beam)->hold({ 0., x, -scene.drive.peak_speed(), 0. }, ContactFriction::sliding);
      if (slide && slide->forces.P > 0. && slide->uniqueness > 0.)
        return slide;
      return {};
    }

    /// Bisection between a mu at which the equilibrium is unique and one at which it is not.
    std::optional<double> critical_mu(const Scene &scene, const double x, double unique, double jammed)
    {
      const auto is_unique = [&](const double mu) { return beam_slide(scene, x, mu).has_value(); };
      if (!is_unique(unique) || is_unique(jammed))
        return {};
      while (jammed - unique > 1e-4 * jammed)
      {
        const double middle                   = 0.5 * (unique + jammed);
        (is_unique(middle) ? unique : jammed) = middle;
      }
      return 0.5 * (unique + jammed);
    }

    void add_flexure(const Scene &scene, JammingMargin &margin)
    {
      constexpr double largest_mu = 5.;
      if (const auto slide = beam_slide(scene, margin.x, margin.mu))
        margin.flexible = slide->margin;
      margin.flexible_critical_mu = critical_mu(scene, margin.x, 0., std::min(3. * margin.critical_mu, largest_mu));
    }
  } // namespace

  JammingMargin jamming_margin(const Scene &scene, const bool flexible)
  {
    const double e = scene.geometry.interface_offset;
    JammingMargin margin;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i <= samples; ++i)
    {
      const double x  = scene.drive.minimum() + (scene.drive.maximum() - scene.drive.minimum()) * i / samples;
      const double s  = kinematics(scene.geometry, x).s;
      const double mu = sliding_friction(scene, x, -scene.drive.peak_speed()).coefficient;
      if (s - mu * e >= least)
        continue;
      least  = s - mu * e;
      margin = { x, s, mu, mu * e, e > 0. ? s / e : std::numeric_limits<double>::infinity(), {}, {} };
    }
    if (flexible)
      add_flexure(scene, margin);
    return margin;
  }

  std::string jamming_text(const JammingMargin &margin)
  {
    std::string text = "Jamming:      closest moving back at x = " + rounded_text(margin.x) +
                       " mm: s = " + rounded_text(margin.s) + " mm, mu e = " + rounded_text(margin.mu_e) + " mm, margin " +
                       rounded_text(1. - margin.mu_e / margin.s) + "; a rigid lever locks at " +
                       (std::isfinite(margin.critical_mu) ? "mu = " + rounded_text(margin.critical_mu) : "no mu");
    if (margin.flexible)
      text += "; margin of the flexible one " + rounded_text(*margin.flexible);
    if (margin.flexible_critical_mu)
      text +=
          (margin.flexible ? ", jams at mu = " : "; the flexible one jams at mu = ") + rounded_text(*margin.flexible_critical_mu);
    return text;
  }
} // namespace sprag
