#pragma once

#include <string>
#include <vector>

namespace sprag
{
  /// A rule between parameters that a scene breaks.
  struct Violation
  {
    std::string parameter;           ///< "Section/Name" of the one to be changed
    std::vector<std::string> others; ///< that the rule also depends on
    std::string rule;                ///< "must be ..."
  };

  /// Collects the rules that are broken.
  struct Rules
  {
    std::vector<Violation> broken;

    void need(const bool kept, const std::string &parameter, const std::vector<std::string> &others, const std::string &rule)
    {
      if (!kept)
        broken.push_back({ parameter, others, rule });
    }
  };
} // namespace sprag
