// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/jamming.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/device.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

namespace sprag
{
  namespace
  {
    constexpr unsigned int samples = 64;

    using Visit = std::function<void(const DrivePoint &)>;

    /// Calls visit along a part of the drive, on both sides of where it turns.
    void follow(const Drive &drive, const double begin, const double end, const Visit &visit)
    {
      const double spacing = (drive.maximum() - drive.minimum()) / samples;
      visit(drive.at(begin, Drive::Side::after));
      for (double time = begin; time < end;)
      {
        // The middle is visited too: near a turn the speed changes much while x changes little.
        const double far    = drive.step(time, spacing).time;
        const double middle = 0.5 * (time + far);
        visit(drive.at(middle));
        visit(drive.at(far, Drive::Side::before));
        visit(drive.at(far, Drive::Side::after));
        time = far;
      }
    }

    /// Strokes of a periodic drive are equal except the first, and the last, which may be cut short or end at full speed.
    void follow(const Drive &drive, const Visit &visit)
    {
      const auto &turns  = drive.reversals();
      const bool repeats = drive.profile() != DriveProfile::table && turns.size() > 3;
      follow(drive, 0., repeats ? turns[2] : drive.duration(), visit);
      if (repeats)
        follow(drive, turns.back(), drive.duration(), visit);
    }

    void visit_held(const Drive &drive, const Visit &visit)
    {
      for (unsigned int i = 0; i <= samples; ++i)
        for (const double sign : { 1., -1. })
          visit({ 0., drive.minimum() + (drive.maximum() - drive.minimum()) * i / samples, sign * drive.peak_speed(), 0. });
    }
  } // namespace

  JammingMargin jamming_margin(const Device &device)
  {
    const double e = device.geometry.interface_offset;
    JammingMargin margin;
    // Without an offset the margin is 1 everywhere; then the result is the shortest s moving back.
    const auto rank  = [](const JammingMargin &at) { return std::make_tuple(at.margin(), at.s, drive_direction(at.v)); };
    bool begins      = true;
    const auto visit = [&](const DrivePoint &point)
    {
      const auto state = closed_form(device, point.x, point.v);
      const double s = state.contact.s, mu = state.mu;
      const JammingMargin here{ point.x, point.v, s, mu * e, e > 0. ? s / e : std::numeric_limits<double>::infinity() };
      if (begins || rank(here) < rank(margin))
        margin = here;
      begins = false;
    };
    if (holds_slide(device.analysis.type) || device.analysis.type == AnalysisType::calibration)
      visit_held(device.drive, visit);
    else
      follow(device.drive, visit);
    return margin;
  }

  std::string jamming_text(const JammingMargin &margin)
  {
    const auto at_mu = [](const double mu) { return std::isfinite(mu) ? "mu = " + formatted("%.4g", mu) : "no mu"; };
    return "Jamming:      margin " + formatted("%.4g", 100. * margin.margin()) +
           " % of a rigid lever, least at x = " + mm(margin.x) + " moving " +
           (drive_direction(margin.v) < 0 ? "backward" : "forward") + "; a rigid lever locks at " + at_mu(margin.critical_mu);
  }
} // namespace sprag
