// SPDX-License-Identifier: GPL-3.0-only
#include "results/hdf5.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/unknown.h"

#include <algorithm>

namespace sprag::hdf5
{
  namespace
  {
    Handle file_access()
    {
      Handle access(checked("file access", H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
      checked("file format", H5Pset_libver_bounds(access.id(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST));
      // A reader's lock, or a network disk without locks, must not end a run; readers are protected by the file's own flags.
      checked("file locking", H5Pset_file_locking(access.id(), false, true));
      return access;
    }

    Handle text_type()
    {
      Handle type(checked("text type", H5Tcopy(H5T_C_S1)), H5Tclose);
      checked("text type", H5Tset_size(type.id(), H5T_VARIABLE));
      checked("text type", H5Tset_cset(type.id(), H5T_CSET_UTF8));
      return type;
    }

    Handle scalar_space()
    {
      return Handle(checked("scalar space", H5Screate(H5S_SCALAR)), H5Sclose);
    }

    Handle simple_space(const std::vector<hsize_t> &extent, const std::vector<hsize_t> &maximum)
    {
      return Handle(checked("array space", H5Screate_simple(static_cast<int>(extent.size()), extent.data(), maximum.data())),
                    H5Sclose);
    }

    Handle storage()
    {
      return Handle(checked("storage", H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
    }

    void write_attribute(const Handle &object, const std::string &name, const hid_t type, const void *data)
    {
      const Handle space = scalar_space();
      const Handle attribute(
          checked("attribute " + name, H5Acreate2(object.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT)),
          H5Aclose);
      checked("attribute " + name, H5Awrite(attribute.id(), type, data));
    }

    Handle create_dataset(const Handle &location, const std::string &name, const hid_t type, const Handle &space,
                          const Handle &storage)
    {
      return Handle(checked("dataset " + name,
                            H5Dcreate2(location.id(), name.c_str(), type, space.id(), H5P_DEFAULT, storage.id(), H5P_DEFAULT)),
                    H5Dclose);
    }

    Handle open_dataset(const Handle &location, const std::string &name)
    {
      return Handle(checked("dataset " + name, H5Dopen2(location.id(), name.c_str(), H5P_DEFAULT)), H5Dclose);
    }

    Handle get_dataspace(const Handle &dataset)
    {
      return Handle(checked("space of a dataset", H5Dget_space(dataset.id())), H5Sclose);
    }

    Handle write_dataset(const Handle &location, const std::string &name, const hid_t type, const Handle &space, const void *data)
    {
      Handle dataset = create_dataset(location, name, type, space, storage());
      checked("dataset " + name, H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
      return dataset;
    }

    bool is_open_together(const Handle &file)
    {
      const Handle access(checked("file access", H5Fget_access_plist(file.id())), H5Pclose);
      return H5Pget_driver(access.id()) == H5FD_MPIO;
    }

    std::vector<hsize_t> with_rows(const hsize_t rows, std::vector<hsize_t> row)
    {
      row.insert(row.begin(), rows);
      return row;
    }

    /// Rows that are not written yet are NaN.
    Handle create_series(const Handle &location, const std::string &name, const std::size_t chunk,
                         const std::vector<hsize_t> &row)
    {
      const Handle chunks = storage();
      checked("chunks", H5Pset_chunk(chunks.id(), static_cast<int>(row.size() + 1), with_rows(chunk, row).data()));
      checked("fill value", H5Pset_fill_value(chunks.id(), H5T_NATIVE_DOUBLE, &unknown));
      if (!row.empty())
        checked("compression", H5Pset_deflate(chunks.id(), 1));
      const Handle space = simple_space(with_rows(0, row), with_rows(H5S_UNLIMITED, row));
      return create_dataset(location, name, H5T_NATIVE_DOUBLE, space, chunks);
    }
  } // namespace

  Handle create_file(const std::string &path)
  {
    return Handle(checked("creating " + path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, file_access().id())), H5Fclose);
  }

  Handle open_file(const std::string &path, const bool abandoned)
  {
    const Handle access = file_access();
    const hbool_t clear = true; // as h5clear does
    if (abandoned)
      checked("file access", H5Pset(access.id(), "clear_status_flags", &clear));
    return Handle(checked("opening " + path, H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id())), H5Fclose);
  }

  Handle open_together(const std::string &path, const MPI_Comm ranks)
  {
    const Handle access = file_access();
    checked("file access", H5Pset_fapl_mpio(access.id(), ranks, MPI_INFO_NULL));
    return Handle(checked("opening " + path, H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id())), H5Fclose);
  }

  Handle open_to_read(const std::string &path)
  {
    const Handle access = file_access();
    hid_t file          = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id());
    if (file < 0)
      file = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.id());
    return Handle(checked("opening " + path, file), H5Fclose);
  }

  std::string read_text(const Handle &location, const std::string &name)
  {
    const Handle dataset = open_dataset(location, name);
    char *text           = nullptr;
    checked("dataset " + name, H5Dread(dataset.id(), text_type().id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &text));
    const std::string result = text != nullptr ? text : "";
    H5free_memory(text);
    return result;
  }

  Handle create_group(const Handle &location, const std::string &name)
  {
    const Handle order(checked("group " + name, H5Pcreate(H5P_GROUP_CREATE)), H5Pclose);
    checked("group " + name, H5Pset_link_creation_order(order.id(), H5P_CRT_ORDER_TRACKED));
    return Handle(checked("group " + name, H5Gcreate2(location.id(), name.c_str(), H5P_DEFAULT, order.id(), H5P_DEFAULT)),
                  H5Gclose);
  }

  void write_attribute(const Handle &object, const std::string &name, const std::string &text)
  {
    const char *const characters = text.c_str();
    write_attribute(object, name, text_type().id(), &characters);
  }

  void write_attribute(const Handle &object, const std::string &name, const double value)
  {
    write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  }

  void describe(const Handle &dataset, const std::string &unit, const std::string &description)
  {
    write_attribute(dataset, "unit", unit);
    write_attribute(dataset, "description", description);
  }

  Handle write_dataset(const Handle &location, const std::string &name, const std::string &text)
  {
    const char *const characters = text.c_str();
    return write_dataset(location, name, text_type().id(), scalar_space(), &characters);
  }

  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<std::string> &texts)
  {
    const auto characters             = mapped(texts, [](const std::string &text) { return text.c_str(); });
    const std::vector<hsize_t> extent = { texts.size() };
    return write_dataset(location, name, text_type().id(), simple_space(extent, extent), characters.data());
  }

  Handle write_dataset(const Handle &location, const std::string &name, const double value)
  {
    return write_dataset(location, name, H5T_NATIVE_DOUBLE, scalar_space(), &value);
  }

  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values,
                       const std::vector<std::size_t> &shape)
  {
    const std::vector<hsize_t> extent =
        shape.empty() ? std::vector<hsize_t>{ values.size() } : std::vector<hsize_t>(shape.begin(), shape.end());
    return write_dataset(location, name, H5T_NATIVE_DOUBLE, simple_space(extent, extent), values.data());
  }

  Handle create_rows(const Handle &location, const std::string &name, const hid_t type, const std::size_t rows,
                     const std::size_t width)
  {
    const auto extent = with_rows(rows, width > 1 ? std::vector<hsize_t>{ width } : std::vector<hsize_t>());
    return create_dataset(location, name, type, simple_space(extent, extent), storage());
  }

  void write_rows(const Handle &file, const std::string &name, const std::size_t first, const std::size_t rows,
                  const void *values)
  {
    const Handle dataset = open_dataset(file, name);
    const Handle type(checked("type of a dataset", H5Dget_type(dataset.id())), H5Tclose);
    const Handle whole = get_dataspace(dataset);
    std::vector<hsize_t> count(checked("space of a dataset", H5Sget_simple_extent_ndims(whole.id())));
    std::vector<hsize_t> start(count.size(), 0);
    checked("space of a dataset", H5Sget_simple_extent_dims(whole.id(), count.data(), nullptr));
    start[0] = first;
    count[0] = rows;
    checked("choosing rows", H5Sselect_hyperslab(whole.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
    const Handle own = simple_space(count, count);
    const Handle transfer(checked("transfer", H5Pcreate(H5P_DATASET_XFER)), H5Pclose);
    if (is_open_together(file))
      checked("transfer", H5Pset_dxpl_mpio(transfer.id(), H5FD_MPIO_COLLECTIVE));
    checked("dataset " + name, H5Dwrite(dataset.id(), type.id(), own.id(), whole.id(), transfer.id(), values));
  }

  Series::Series(const Handle &location, const std::string &name, const std::size_t chunk, const std::vector<hsize_t> &row)
      : extent(with_rows(0, row))
      , dataset(create_series(location, name, chunk, row))
  {
  }

  void Series::append(const std::vector<double> &values)
  {
    const std::size_t width = extent.size() == 1 ? 1 : extent[1];
    std::vector<hsize_t> start(extent.size(), 0);
    std::vector<hsize_t> count = extent;
    start[0]                   = extent[0];
    count[0]                   = values.size() / width;
    extent[0] += count[0];
    checked("growing a dataset", H5Dset_extent(dataset.id(), extent.data()));
    const Handle whole = get_dataspace(dataset);
    checked("choosing rows", H5Sselect_hyperslab(whole.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
    const Handle rows = simple_space(count, count);
    checked("writing rows", H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, rows.id(), whole.id(), H5P_DEFAULT, values.data()));
  }
} // namespace sprag::hdf5
