// SPDX-License-Identifier: GPL-3.0-only
#include "report/isolation_brief.h"
#include "base/phase_timer.h"
#include "base/text.h"
#include "report/brief_lines.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    void print_transmissibility(std::ostream &stream, const Known &known)
    {
      std::string text;
      for (const auto &[name, label] : { std::pair<std::string, std::string>{ "peak", "peak" },
                                         { "fundamental", "first harmonic" },
                                         { "rms", "root mean square" } })
        if (const auto value = known.number("transmissibility_" + name))
          text += (text.empty() ? "" : ", ") + label + ' ' + four_digits(value);
      if (const auto low = known.number("transmissibility_rms_low"))
        text += " (" + four_digits(low) + " to " + four_digits(known.number("transmissibility_rms_high")) + " with 95 %)";
      if (!text.empty())
        brief_line(stream, "transmissibility", text);
    }

    void print_steadiness(std::ostream &stream, const Known &known)
    {
      if (known.number("steady_state") != 1.)
        return;
      const auto periods = known.number("periods_to_repeat");
      brief_line(stream, "steady",
                 "from " + known.quantity("steady_from") + " on, repeats after " + four_digits(periods) +
                     (periods == 1. ? " period" : " periods") + ", |z| up to " + known.quantity("relative_amplitude") + ", " +
                     four_digits(known.number("stops_a_period")) + " stops a period");
    }

    void print_harmonic_balance(std::ostream &stream, const Known &known)
    {
      const auto ratio = known.number("harmonic_balance_transmissibility");
      if (ratio)
        brief_line(stream, "harmonic balance",
                   "transmissibility " + four_digits(ratio) + ", " + known.share("harmonic_balance_error") +
                       " off the run's first harmonic, amplitude " + known.quantity("harmonic_balance_amplitude"));
    }

    /// Where the table ends, with what is round-off as 0.
    std::string end_text(const Known &known)
    {
      const double z        = known.number("residual_offset").value_or(0.);
      const bool is_noise   = std::abs(z) < 1e-6 * known.number("largest_displacement").value_or(0.);
      const std::string how = known.number("rests_at_end") == 1. ? "rests at z = " : "moves about z = ";
      return how + with_unit(is_noise ? 0. : z, "mm");
    }

    void print_energies(std::ostream &stream, const Known &known)
    {
      const auto work = known.number("base_work");
      brief_line(stream, "energy",
                 "dissipated by the damper " + known.quantity("dissipated_energy") +
                     (work && *work != 0. ? ", brought in by the base " + known.quantity("base_work") : ""));
    }
  } // namespace

  void print_brief_of_isolation(std::ostream &stream, const std::vector<Entry> &summary)
  {
    const Known known(summary);
    brief_line(stream, "table", known.quantity("natural_frequency") + " on its restoring spring alone");
    brief_line(stream, "displacement", "up to " + known.quantity("largest_displacement") + " relative to the base");
    brief_line(stream, "acceleration",
               "up to " + known.quantity("largest_acceleration") + ", root mean square " + known.quantity("rms_acceleration"));
    print_transmissibility(stream, known);
    print_steadiness(stream, known);
    print_harmonic_balance(stream, known);
    brief_line(stream, "at the end",
               end_text(known) + " after " + known.quantity("end_time") + ", " + four_digits(known.number("turns")) +
                   " turns and " + four_digits(known.number("stops")) + " stops");
    print_energies(stream, known);
    print_brief_cost(stream, known, PhaseTimer::cpu_seconds());
  }
} // namespace sprag
