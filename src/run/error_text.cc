// SPDX-License-Identifier: GPL-3.0-only
#include "run/error_text.h"

#include "base/text.h"

#include <deal.II/base/exceptions.h>

#include <sstream>

namespace sprag
{
  std::string error_message(const std::exception &error)
  {
    const auto *dealii_error = dynamic_cast<const dealii::ExceptionBase *>(&error);
    if (dealii_error == nullptr)
      return error.what();
    std::ostringstream text;
    dealii_error->print_info(text);
    return single_spaced(text.str());
  }
} // namespace sprag
