#include "run/brief.h"

#include "base/text.h"
#include "run/percent.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_reversals = 12; ///< lines of their table
    constexpr int label_width             = 22;

    /// Entries by name, those that are known.
    class Known
    {
    public:
      explicit Known(const std::vector<Entry> &entries)
      {
        for (const auto &entry : entries)
        {
          const auto *const number = std::get_if<double>(&entry.value);
          if (number == nullptr || !std::isnan(*number))
            known.emplace(entry.name, &entry);
        }
      }

      std::optional<double> number(const std::string &name) const
      {
        const auto found = known.find(name);
        return found == known.end() ? std::optional<double>() : std::get<double>(found->second->value);
      }

      std::string text(const std::string &name) const
      {
        const auto found = known.find(name);
        return found == known.end() ? "" : std::get<std::string>(found->second->value);
      }

    private:
      std::map<std::string, const Entry *> known;
    };

    std::string padded(const std::string &text, const int width)
    {
      return formatted("%*s", width, text.c_str());
    }

    std::string four_digits(const std::optional<double> &value)
    {
      return value ? formatted("%.4g", *value) : "-";
    }

    void line(std::ostream &stream, const std::string &label, const std::string &text)
    {
      stream << "  " << padded(label, -label_width) << text << '\n';
    }

    const std::vector<std::string> ways = { "forward", "backward" };

    /// A value for each way that the run has, where one is known.
    void line(std::ostream &stream, const Known &known, const std::string &label, const std::string &name,
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
        line(stream, label, values + ' ' + unit);
    }

    /// Adds, for each way, the largest deviation of P, Q and theta from the closed form, of models that are not the closed form
    /// [%].
    std::vector<Entry> with_deviations(std::vector<Entry> entries)
    {
      const Known known(entries);
      for (const auto &way : ways)
      {
        double largest = 0.;
        for (const std::string of : { "P_", "Q_", "theta_" })
          largest = std::max(largest, known.number("deviation_" + of + way).value_or(0.));
        if (largest > 0.)
          entries.push_back({ "deviation_" + way, 100. * largest, "%", "" });
      }
      return entries;
    }

    void print_strokes(std::ostream &stream, const Known &known)
    {
      std::string header;
      for (const auto &way : ways)
        header += known.number("peak_P_" + way) ? padded(way, 12) : "";
      line(stream, "", header);
      line(stream, known, "largest P", "peak_P", "N");
      line(stream, known, "largest Q", "peak_Q", "N");
      if (known.number("peak_Q_support_forward") != known.number("peak_Q_forward") ||
          known.number("peak_Q_support_backward") != known.number("peak_Q_backward"))
        line(stream, known, "on the ground", "peak_Q_support", "N");
      line(stream, known, "slope of Q at x = 0", "slope", "N/mm");
      if (known.number("slope_forward") || known.number("slope_backward"))
        line(stream, known, "  by the closed form", "representative_slope", "N/mm");
      line(stream, known, "off the closed form", "deviation", "%");
    }

    void print_contact(std::ostream &stream, const Known &known)
    {
      if (const auto work = known.number("loop_area"))
        line(stream, "work of the drive",
             four_digits(work) + " N mm, of friction " + four_digits(known.number("friction_work")) + " N mm");
      const auto pressure = known.number("largest_pressure");
      if (pressure && *pressure > 0.)
        line(stream, "largest pressure",
             four_digits(pressure) + " MPa at x = " + four_digits(known.number("largest_pressure_x")) + " mm " +
                 known.text("largest_pressure_direction"));
      std::string stress;
      for (const std::string part : { "lever", "layer" })
        if (const auto value = known.number("largest_" + part + "_stress"))
          stress += (stress.empty() ? "" : ", ") + part + ' ' + four_digits(value) + " MPa";
      if (!stress.empty())
        line(stream, "largest stress", stress + " (von Mises)");
      if (const auto force = known.number("peak_lateral_force"))
        line(stream, "pair",
             "across the path " + four_digits(force) + " N, P of the levers " + four_digits(known.number("peak_difference_P")) +
                 " N apart");
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

    void print_errors(std::ostream &stream, const std::vector<ErrorEstimate> &errors)
    {
      std::string told, untold;
      const ErrorEstimate *worst = nullptr;
      for (const auto &error : errors)
      {
        if (error.parts.empty())
          untold += (untold.empty() ? "" : ", ") + error.quantity;
        else
          told += (told.empty() ? "" : ", ") + error.quantity + ' ' + percent(total_error(error));
        if (!error.parts.empty() && (worst == nullptr || total_error(error) > total_error(*worst)))
          worst = &error;
      }
      if (!told.empty())
        line(stream, "errors, estimated", told);
      if (!untold.empty())
        line(stream, "not estimated", untold + " (the reason is in /accuracy)");
      if (worst != nullptr)
        line(stream, "to improve the worst", largest_part(*worst).remedy);
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
    print_errors(stream, errors);
    line(stream, "cost",
         formatted("%.2g", cpu_seconds) + " s of CPU time, " + rounded_text(known.number("steps").value_or(0.)) + " steps");
  }
} // namespace sprag
