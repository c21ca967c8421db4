// SPDX-License-Identifier: GPL-3.0-only
#include "report/brief.h"

#include "base/append.h"
#include "report/brief_lines.h"
#include "report/percent.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_reversals = 12; ///< lines of their table

    const std::vector<std::string> ways = { "forward", "backward" };

    /// A value for each way that the run has, where one is known.
    void both_ways(std::ostream &stream, const Known &known, const std::string &label, const std::string &name,
                   const std::string &unit)
    {
      std::string values;
      bool has_some = false;
      for (const auto &way : ways)
        if (known.number("peak_P_" + way))
        {
          const auto value = known.number(name + '_' + way);
          has_some         = has_some || value;
          values += padded(four_digits(value), 12);
        }
      if (has_some)
        brief_line(stream, label, values + ' ' + unit);
    }

    /// Adds, for each way, the largest deviation of P, Q and theta from the closed form, of models that are not the closed form
    /// [%].
    std::vector<Entry> with_deviations(std::vector<Entry> entries)
    {
      const Known known(entries);
      std::vector<Entry> deviations; // apart, as what is known points to the entries
      for (const auto &way : ways)
      {
        double largest = 0.;
        for (const std::string of : { "P_", "Q_", "theta_" })
          largest = std::max(largest, known.number("deviation_" + of + way).value_or(0.));
        if (largest > 0.)
          deviations.push_back({ "deviation_" + way, 100. * largest, "%", "" });
      }
      append(entries, deviations);
      return entries;
    }

    void print_strokes(std::ostream &stream, const Known &known)
    {
      std::string header;
      for (const auto &way : ways)
        header += known.number("peak_P_" + way) ? padded(way, 12) : "";
      brief_line(stream, "", header);
      both_ways(stream, known, "largest P", "peak_P", "N");
      both_ways(stream, known, "largest Q", "peak_Q", "N");
      if (known.number("peak_Q_support_forward") != known.number("peak_Q_forward") ||
          known.number("peak_Q_support_backward") != known.number("peak_Q_backward"))
        both_ways(stream, known, "on the ground", "peak_Q_support", "N");
      both_ways(stream, known, "slope of Q at x = 0", "slope", "N/mm");
      if (known.number("slope_forward") || known.number("slope_backward"))
        both_ways(stream, known, "  by the closed form", "representative_slope", "N/mm");
      both_ways(stream, known, "off the closed form", "deviation", "%");
    }

    void print_contact(std::ostream &stream, const Known &known)
    {
      if (const auto work = known.number("loop_area"))
        brief_line(stream, "work of the drive",
                   four_digits(work) + " N mm, of friction " + four_digits(known.number("friction_work")) + " N mm");
      const auto pressure = known.number("largest_pressure");
      if (pressure && *pressure > 0.)
        brief_line(stream, "largest pressure",
                   four_digits(pressure) + " MPa at x = " + four_digits(known.number("largest_pressure_x")) + " mm " +
                       known.text("largest_pressure_direction"));
      std::string stress;
      for (const std::string part : { "lever", "layer" })
        if (const auto value = known.number("largest_" + part + "_stress"))
          stress += (stress.empty() ? "" : ", ") + part + ' ' + four_digits(value) + " MPa";
      if (!stress.empty())
        brief_line(stream, "largest stress", stress + " (von Mises)");
      if (const auto force = known.number("peak_lateral_force"))
        brief_line(stream, "pair",
                   "across the path " + four_digits(force) + " N, P of the levers " +
                       four_digits(known.number("peak_difference_P")) + " N apart");
    }

    void print_reversals(std::ostream &stream, const Known &known)
    {
      const auto name      = [](const unsigned int i, const char *of) { return "reversal_" + std::to_string(i) + '_' + of; };
      unsigned int printed = 0, i = 1;
      for (; known.number(name(i, "x")); ++i)
      {
        if (printed == most_reversals)
          continue;
        if (printed++ == 0)
          stream << "  reversal   x [mm]  frequency [Hz]  growth [1/s]  overshoot of P [%]  ringing\n";
        auto overshoot = known.number(name(i, "overshoot_P"));
        if (overshoot)
          *overshoot *= 100.;
        stream << padded(std::to_string(i), 10) << padded(four_digits(known.number(name(i, "x"))), 9)
               << padded(four_digits(known.number(name(i, "frequency"))), 16)
               << padded(four_digits(known.number(name(i, "growth_rate"))), 14) << padded(four_digits(overshoot), 20) << "  "
               << known.text(name(i, "verdict")) << '\n';
      }
      if (i > printed + 1)
        stream << "             and " << i - 1 - printed << " more in /summary\n";
    }
  } // namespace

  void print_brief(std::ostream &stream, const std::vector<Entry> &summary, const std::vector<ErrorEstimate> &errors,
                   const double cpu_seconds)
  {
    const auto entries = with_deviations(summary);
    const Known known(entries);
    print_strokes(stream, known);
    print_contact(stream, known);
    print_reversals(stream, known);
    print_brief_errors(stream, errors);
    print_brief_cost(stream, known, cpu_seconds);
  }
} // namespace sprag
