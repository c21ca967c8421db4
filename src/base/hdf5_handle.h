#pragma once

#include "base/errors.h"

#include <hdf5.h>
#include <string>
#include <utility>
#include <vector>

namespace sprag::hdf5
{
  /// Keeps HDF5 from printing its error stack while in scope; the stack itself stays.
  class SilencedHdf5
  {
  public:
    SilencedHdf5()
    {
      H5Eget_auto2(H5E_DEFAULT, &function, &data);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    ~SilencedHdf5()
    {
      H5Eset_auto2(H5E_DEFAULT, function, data);
    }

    SilencedHdf5 &operator=(SilencedHdf5 &&) = delete;

  private:
    H5E_auto2_t function = nullptr;
    void *data           = nullptr;
  };

  /// What went wrong deepest in the library: that is where the file name and the system's reason are.
  std::string deepest_error();

  /// Returns what a call of the library returns; throws AnalysisError with the task and the library's message where it failed.
  template <typename Call>
  auto checked(const std::string &task, const Call &call)
  {
    const SilencedHdf5 silenced;
    const auto result = call();
    if (result < 0)
      throw AnalysisError("HDF5, " + task + ": " + deepest_error());
    return result;
  }

  /// Owner of one identifier, closed with it.
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

    ~Handle();

    hid_t id() const
    {
      return identifier;
    }

    /// Closes now and reports what a destructor has to swallow. Later calls of id() are a mistake.
    void close();

  private:
    hid_t identifier;
    Close closing_function;
  };

  /// Names in a group, or at the root of a file, in alphabetical order; empty where they cannot be read.
  std::vector<std::string> names_in(const Handle &group);
} // namespace sprag::hdf5
