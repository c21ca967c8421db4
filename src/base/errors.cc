#include "base/errors.h"

#include <boost/algorithm/string/join.hpp>

namespace sprag
{
  InputError::InputError(std::vector<std::string> all_messages)
      : std::runtime_error(boost::algorithm::join(all_messages, "\n"))
      , messages(std::move(all_messages))
  {
  }

  InputError::InputError(const std::string &message)
      : InputError(std::vector<std::string>{ message })
  {
  }
} // namespace sprag
