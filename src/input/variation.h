// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"
#include "scene/study_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  /// The most runs that a study may have: all processes keep what all found.
  constexpr double most_runs = 2e4;

  /// Parameters and values as the texts of a study give them, and everything wrong with the text.
  struct Variation
  {
    std::vector<VariedParameter> parameters;
    std::vector<std::string> mistakes; ///< "'Lever/Dpth' is no parameter; did you mean 'Lever/Depth'?"
  };

  /// Reads "Section/Name = VALUES; ...", where VALUES are separated by commas and may be ranges, FIRST ... LAST : NUMBER, which
  /// hold both ends and go by equal differences, or with "log" behind the number by equal ratios. Names must be declared and
  /// belong to a run, values keep their rule. Files are relative to `folder`; their values become paths.
  /// Without `lists` there is one value each, which may hold commas, or no parameter.
  Variation parse_variation(const std::string &text, const std::vector<Parameter> &declared, const std::string &folder,
                            bool lists);

  /// Returns what keeps a study's parameters from being combined; none where nothing does.
  std::vector<std::string> combination_mistakes(const StudySettings &study);

  /// Returns what is wrong with a study's asking for a reference; none where nothing is.
  std::vector<std::string> reference_mistakes(const StudySettings &study);

  /// Writes the text that parse_variation() reads.
  std::string variation_text(const std::vector<VariedParameter> &parameters);
} // namespace sprag
