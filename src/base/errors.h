#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sprag
{
  /// Everything wrong with what the user gave, all at once. The program ends with exit status 2.
  class InputError : public std::runtime_error
  {
  public:
    explicit InputError(std::vector<std::string> all_messages);
    explicit InputError(const std::string &message);

    /// One message a mistake, each naming file, parameter, value and rule.
    const std::vector<std::string> messages;
  };

  /// A correct scene whose analysis could not be carried to its end. Exit status 1; every finished step stays readable.
  class AnalysisError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace sprag
