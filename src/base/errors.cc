#include "base/errors.h"

namespace sprag
{
  namespace
  {
    std::string joined(const std::vector<std::string> &messages)
    {
      std::string text;
      for (const auto &message : messages)
        text += (text.empty() ? "" : "\n") + message;
      return text;
    }
  } // namespace

  InputError::InputError(std::vector<std::string> all_messages)
      : std::runtime_error(joined(all_messages))
      , messages(std::move(all_messages))
  {
  }

  InputError::InputError(const std::string &message)
      : InputError(std::vector<std::string>{ message })
  {
  }
} // namespace sprag
