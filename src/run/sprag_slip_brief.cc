// SPDX-License-Identifier: GPL-3.0-only
#include "base/phase_timer.h"
#include "report/brief_lines.h"
#include "run/briefs.h"

namespace sprag
{
  namespace
  {
    void print_measured(std::ostream &stream, const Known &known, const std::string &label, const std::string &of)
    {
      if (known.number("measured_" + of))
        brief_line(stream, label,
                   known.quantity("measured_" + of) + " in time, " + known.quantity("linear_" + of) + " by the eigenvalue, " +
                       known.share(label + "_difference") + " apart");
    }

    void print_vibration(std::ostream &stream, const Known &known)
    {
      const auto kind = known.text("cycle");
      if (kind.empty())
        return;
      brief_line(stream, "comes to", kind);
      if (kind == "slide")
        return;
      brief_line(stream, "  amplitude",
                 "of P " + known.quantity("cycle_amplitude_P") + ", " + known.share("cycle_relative_amplitude") +
                     " of P of the slide, at " + known.quantity("cycle_frequency"));
      brief_line(stream, "  of its time",
                 known.share("cycle_open_share") + " out of contact, " + known.share("cycle_stick_share") +
                     " in partial or full stick");
    }
  } // namespace

  void print_brief_of_sprag_slip(std::ostream &stream, const std::vector<Entry> &summary)
  {
    const Known known(summary);
    brief_line(stream, "verdict on the slide", known.text("slide"));
    if (known.number("x"))
      brief_line(stream, "slide",
                 "at x = " + known.quantity("x") + " with P = " + known.quantity("P") + ", " + known.quantity("slip_speed") +
                     " along the lever, indentation " + known.quantity("indentation"));
    print_measured(stream, known, "growth", "growth_rate");
    print_measured(stream, known, "frequency", "frequency");
    print_vibration(stream, known);
    if (known.number("coexistence_from"))
      brief_line(stream, "slide or vibration",
                 "by what came before, from x = " + known.quantity("coexistence_from") + " to " +
                     known.quantity("coexistence_to"));
    print_brief_cost(stream, known, PhaseTimer::cpu_seconds());
  }
} // namespace sprag
