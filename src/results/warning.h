// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"

#include <string>

namespace sprag
{
  /// Something that a run met and its user should know before relying on a result. Printed, stored in /warnings, counted in the
  /// last line of a run; with Analysis/Warnings = error the run exits 1.
  struct Warning
  {
    std::string name;   ///< identifier, unique within a run, words joined by underscores: narrow_contact
    std::string found;  ///< a sentence: what was found and where, with its numbers, units and limit
    std::string effect; ///< a sentence: what it does to which result
    std::string remedy; ///< a sentence: what to do about it
  };

  using Warnings = std::vector<Warning>;

  /// Returns the warning `name` with the texts of its row in params/warnings.md, where each `*` becomes the next of `values`.
  /// Throws std::logic_error where the page has no such row or another number of them.
  Warning make_warning(const std::string &name, const std::vector<std::string> &values = {});

  /// Writes warnings for people, a paragraph each in lines of at most 100 characters; empty without warnings.
  std::string to_text(const Warnings &warnings);

  /// Returns "no warnings" or their number and names.
  std::string count_text(const Warnings &warnings);
} // namespace sprag
