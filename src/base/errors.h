// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <boost/algorithm/string/join.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace sprag
{
  /// Everything wrong with what the user gave, all at once. The program ends with exit status 2.
  struct InputError : public std::runtime_error
  {
    explicit InputError(const std::vector<std::string> &all_messages)
        : std::runtime_error(boost::algorithm::join(all_messages, "\n"))
        , messages(all_messages)
    {
    }

    explicit InputError(const std::string &message)
        : InputError(std::vector<std::string>{ message })
    {
    }

    /// One message a mistake, each naming file, parameter, value and rule.
    const std::vector<std::string> messages;
  };

  /// The analysis of a correct scene could not be carried to its end. The program ends with exit status 1; every finished step
  /// stays readable.
  struct AnalysisError : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
} // namespace sprag
