#include "base/hdf5_handle.h"

namespace sprag::hdf5
{
  namespace
  {
    herr_t take_first_description(unsigned int, const H5E_error2_t *error, void *text)
    {
      auto &description = *static_cast<std::string *>(text);
      if (description.empty() && error->desc != nullptr)
        description = error->desc;
      return 0;
    }

    herr_t collect_name(const hid_t, const char *name, const H5L_info_t *, void *names)
    {
      static_cast<std::vector<std::string> *>(names)->emplace_back(name);
      return 0;
    }
  } // namespace

  std::string deepest_error()
  {
    std::string description;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first_description, &description);
    return description.empty() ? "unknown HDF5 error" : description;
  }

  Handle::~Handle()
  {
    if (identifier >= 0)
    {
      const SilencedHdf5 silenced;
      closing_function(identifier);
    }
  }

  void Handle::close()
  {
    const hid_t closed = std::exchange(identifier, H5I_INVALID_HID);
    checked("closing", [&] { return closing_function(closed); });
  }

  std::vector<std::string> names_in(const Handle &group)
  {
    std::vector<std::string> names;
    hsize_t position = 0;
    if (H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, &position, collect_name, &names) < 0)
      return {};
    return names;
  }
} // namespace sprag::hdf5
