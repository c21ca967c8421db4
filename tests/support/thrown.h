// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Returns the text of the error that an action throws, empty without one.
  template <class Error = InputError, class Action>
  std::string thrown_text(const Action &act)
  {
    try
    {
      act();
    }
    catch (const Error &error)
    {
      return error.what();
    }
    return {};
  }

  /// Returns the messages of the InputError that an action throws.
  template <class Action>
  std::vector<std::string> thrown_messages(const Action &act)
  {
    try
    {
      act();
    }
    catch (const InputError &error)
    {
      return error.messages;
    }
    return {};
  }
} // namespace sprag
