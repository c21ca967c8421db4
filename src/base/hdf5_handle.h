// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"

#include <hdf5.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sprag::hdf5
{
  /// Keeps HDF5 from printing its errors from now on. What they say is in the errors that checked() throws.
  inline void silence()
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }

  /// Returns what went wrong deepest in the library in its last call: that is where the file name and the system's reason are.
  std::string deepest_error();

  /// Passes on what a call of the library has returned; throws AnalysisError with the task and the library's message where the
  /// call has failed.
  template <typename Result>
  Result checked(const std::string &task, const Result result)
  {
    if (result < 0)
      throw AnalysisError("HDF5, " + task + ": " + deepest_error());
    return result;
  }

  /// Owner of one identifier, which it closes at its end.
  class Handle
  {
  public:
    using Close = herr_t (*)(hid_t);

    Handle(hid_t owned, Close closing)
        : identifier(owned)
        , closing_function(closing)
    {
    }

    Handle(Handle &&other) noexcept
        : identifier(std::exchange(other.identifier, H5I_INVALID_HID))
        , closing_function(other.closing_function)
    {
    }

    Handle &operator=(Handle &&) = delete;

    ~Handle()
    {
      if (identifier >= 0)
        closing_function(identifier);
    }

    hid_t id() const
    {
      return identifier;
    }

    /// Closes now and reports what a destructor has to swallow. Later calls of id() are a mistake.
    void close()
    {
      checked("closing", closing_function(std::exchange(identifier, H5I_INVALID_HID)));
    }

  private:
    hid_t identifier;
    Close closing_function;
  };

  /// Returns the names in a group, or at the root of a file, in alphabetical order; none where they cannot be read.
  std::vector<std::string> names_in(const Handle &group);

  /// Returns the names of the attributes of a dataset in alphabetical order.
  std::vector<std::string> attribute_names(const Handle &dataset);

  /// Returns the text of an attribute; none where there is no such text.
  std::optional<std::string> text_attribute(const Handle &dataset, const std::string &name);
} // namespace sprag::hdf5
