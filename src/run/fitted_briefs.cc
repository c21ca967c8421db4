// SPDX-License-Identifier: GPL-3.0-only
#include "base/phase_timer.h"
#include "base/text.h"
#include "report/brief_lines.h"
#include "run/briefs.h"

namespace sprag
{
  namespace
  {
    std::string law(const Known &known, const std::string &stiffness, const std::string &exponent)
    {
      return "P = " + known.quantity(stiffness) + " delta^n with n = " + four_digits(known.number(exponent));
    }

    void print_parts(std::ostream &stream, const Known &known)
    {
      const std::vector<std::pair<std::string, std::string>> parts = { { "leaf_thickness", "leaf thickness" },
                                                                       { "tip_mass", "mass at the tip" },
                                                                       { "hub_inertia", "inertia at the hub" } };
      for (const auto &[name, label] : parts)
        if (known.number(name))
          brief_line(stream, label, known.quantity(name));
    }

    void print_frequencies(std::ostream &stream, const Known &known)
    {
      brief_line(stream, "", "  meshed [Hz]   beam [Hz]     off [%]");
      for (const std::string where : { "free", "contact" })
        for (int i = 1; known.number(where + "_frequency_" + std::to_string(i)); ++i)
        {
          const auto name = where + "_frequency_" + std::to_string(i);
          const auto off  = known.number(name + "_deviation");
          brief_line(stream, (where == "free" ? "out of contact, " : "in contact, ") + std::to_string(i) + '.',
                     padded(four_digits(known.number(name)), 13) + padded(four_digits(known.number(name + "_beam")), 12) +
                         padded(formatted("%.2g", 100. * off.value_or(0.)), 12));
        }
    }
  } // namespace

  void print_brief_of_calibration(std::ostream &stream, const std::vector<Entry> &summary)
  {
    const Known known(summary);
    print_parts(stream, known);
    brief_line(stream, "calibrated to", "k = " + known.quantity("stiffness") + ", J = " + known.quantity("moment_of_inertia"));
    brief_line(stream, "beam like it",
               "EI = " + known.quantity("bending_stiffness") + ", neutral axis at " + known.quantity("neutral_axis_offset") +
                   ", deflections " + known.share("bending_error") + " off");
    brief_line(stream, "contact of the beam",
               law(known, "contact_stiffness", "contact_exponent") + ", P " + known.share("contact_error") + " off");
    brief_line(stream, "in steady sliding",
               "P " + known.share("P_deviation") + ", Q " + known.share("Q_deviation") + " off the meshed lever");
    print_frequencies(stream, known);
    print_brief_cost(stream, known, PhaseTimer::cpu_seconds());
  }

  void print_brief_of_contact_law(std::ostream &stream, const std::vector<Entry> &summary)
  {
    const Known known(summary);
    brief_line(stream, "contact law", law(known, "stiffness", "exponent") + ", fitted up to P = " + known.quantity("largest_P"));
    brief_line(stream, "P by that law",
               known.share("rms_error") + " off (root mean square), at worst " + known.share("largest_error"));
    brief_line(stream, "P by the penalty", known.share("penalty_error") + " off in the indentation itself");
    print_brief_cost(stream, known, PhaseTimer::cpu_seconds());
  }
} // namespace sprag
