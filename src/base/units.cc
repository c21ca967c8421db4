// SPDX-License-Identifier: GPL-3.0-only
#include "base/units.h"

#include "base/errors.h"
#include "base/pattern.h"
#include "base/text.h"

#include <boost/algorithm/string/predicate.hpp>

#include <array>
#include <memory>
#include <optional>
#include <udunits2.h>

namespace sprag
{
  namespace
  {
    using Unit = std::unique_ptr<ut_unit, void (*)(ut_unit *)>;

    /// Reading the library's units takes some 10 ms, which only those spend who need them.
    ut_system *all_units()
    {
      static ut_system *const system = []
      {
        ut_set_error_message_handler(ut_ignore);
        ut_system *const read = ut_read_xml(nullptr);
        if (read == nullptr)
          throw InputError("units cannot be converted: udunits2.xml of the package libudunits2-data cannot be read");
        for (const auto &[name, meaning] : { std::pair("deg", "degree"), { "Nm", "N m" }, { "Nmm", "N mm" }, { "Ns", "N s" } })
          ut_map_name_to_unit(name, UT_ASCII, Unit(ut_parse(read, meaning, UT_ASCII), ut_free).get());
        return read;
      }();
      return system;
    }

    /// Null where there is no such unit. Numbers are exponents alone, but the 1 of "1/s": "5 mm 20" is no length.
    Unit parsed(const std::string &text)
    {
      const std::string non_unit = "[^-A-Za-z0-9 ./*^()%\\x80-\\xff]|(^|[^A-Za-z0-9)^\\x80-\\xff-])[0-9]";
      const std::string unit     = text == "-" ? "" : boost::starts_with(text, "1/") ? "(s/s)" + text.substr(1) : text;
      const bool is_unit         = unit == "1" || !contains_match(unit, non_unit);
      return { is_unit ? ut_parse(all_units(), unit.c_str(), UT_UTF8) : nullptr, ut_free };
    }

    /// "0.001 m.kg.s-2"
    std::string in_base_units(const Unit &unit)
    {
      std::array<char, 200> text{};
      const int length = ut_format(unit.get(), text.data(), text.size(), UT_ASCII | UT_DEFINITION);
      return length < 0 || length >= static_cast<int>(text.size()) ? "?" : text.data();
    }

    std::string dimension(const Unit &unit)
    {
      const auto text   = in_base_units(unit);
      const auto number = leading_number(text);
      const auto bases  = number ? number->rest : text;
      return bases.empty() || bases == "1" ? "has no dimension" : "has the dimension " + bases;
    }

    /// Returns one unit over another; none where their dimensions differ.
    std::optional<double> quotient(const Unit &from, const Unit &to)
    {
      const Unit ratio(ut_divide(from.get(), to.get()), ut_free);
      const auto number = leading_number(in_base_units(ratio));
      return number && (number->rest.empty() || number->rest == "1") ? std::make_optional(number->value) : std::nullopt;
    }
  } // namespace

  bool is_unit(const std::string &text)
  {
    return parsed(text) != nullptr;
  }

  double unit_factor(const std::string &from, const std::string &to)
  {
    if (from == to)
      return 1.;
    const Unit own = parsed(to), source = parsed(from);
    if (!source)
      throw InputError("there is no unit '" + from + "'");
    if (!own)
      throw InputError("no unit can be converted to " + to);
    if (const auto factor = quotient(source, own))
      return *factor;
    const std::string gravity = replace_matches(from, "(^|[^A-Za-z])g(?![A-Za-z])", "$1gravity");
    if (const Unit accelerated = parsed(gravity); accelerated)
      if (const auto factor = quotient(accelerated, own))
        return *factor;
    throw InputError("'" + from + "' " + dimension(source) + ", " + (to.empty() ? "a bare number" : to) + ' ' + dimension(own));
  }
} // namespace sprag
