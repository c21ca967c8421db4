// SPDX-License-Identifier: GPL-3.0-only
#include "base/error_text.h"

#include "base/text.h"

#include <deal.II/base/exceptions.h>

#include <sstream>

namespace sprag
{
  std::string message_of(const std::exception &error)
  {
    const auto *of_dealii = dynamic_cast<const dealii::ExceptionBase *>(&error);
    if (of_dealii == nullptr)
      return error.what();
    std::ostringstream text;
    of_dealii->print_info(text);
    return single_spaced(text.str());
  }
} // namespace sprag
