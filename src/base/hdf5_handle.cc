// SPDX-License-Identifier: GPL-3.0-only
#include "base/hdf5_handle.h"

namespace sprag::hdf5
{
  std::string deepest_error()
  {
    const auto take_first = [](unsigned int, const H5E_error2_t *error, void *text) -> herr_t
    {
      auto &description = *static_cast<std::string *>(text);
      if (description.empty() && error->desc != nullptr)
        description = error->desc;
      return 0;
    };
    std::string description;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &description);
    return description.empty() ? "unknown HDF5 error" : description;
  }

  namespace
  {
    /// Takes each name that the library finds in a group or at a dataset.
    template <class Info>
    herr_t collect(hid_t, const char *const name, const Info *, void *const names)
    {
      static_cast<std::vector<std::string> *>(names)->emplace_back(name);
      return 0;
    }
  } // namespace

  std::vector<std::string> names_in(const Handle &group)
  {
    std::vector<std::string> names;
    hsize_t position  = 0;
    const auto status = H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, &position, collect<H5L_info_t>, &names);
    return status < 0 ? std::vector<std::string>() : names;
  }

  std::vector<std::string> attribute_names(const Handle &dataset)
  {
    std::vector<std::string> names;
    H5Aiterate2(dataset.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect<H5A_info_t>, &names);
    return names;
  }

  std::optional<std::string> text_attribute(const Handle &dataset, const std::string &name)
  {
    if (H5Aexists(dataset.id(), name.c_str()) <= 0)
      return std::nullopt;
    const Handle attribute(H5Aopen(dataset.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute.id()), H5Tclose);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose);
    if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1)
      return std::nullopt;
    if (H5Tis_variable_str(type.id()) > 0)
    {
      char *text = nullptr;
      if (H5Aread(attribute.id(), type.id(), &text) < 0 || text == nullptr)
        return std::nullopt;
      const std::string result = text;
      H5free_memory(text);
      return result;
    }
    std::string text(H5Tget_size(type.id()), '\0');
    if (H5Aread(attribute.id(), type.id(), text.data()) < 0)
      return std::nullopt;
    return text.substr(0, text.find('\0'));
  }
} // namespace sprag::hdf5
