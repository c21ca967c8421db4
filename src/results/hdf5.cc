#include "results/hdf5.h"

#include "base/errors.h"

#include <deal.II/base/exceptions.h>

#include <limits>

namespace sprag::hdf5
{
  namespace
  {
    Handle file_access()
    {
      Handle access(checked("file access", [] { return H5Pcreate(H5P_FILE_ACCESS); }), H5Pclose);
      checked("file format", [&] { return H5Pset_libver_bounds(access.id(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST); });
      // A reader's lock, or a network disk without locks, must not end a run; readers are protected by the file's own flags.
      checked("file locking", [&] { return H5Pset_file_locking(access.id(), false, true); });
      return access;
    }

    Handle text_type()
    {
      Handle type(checked("text type", [] { return H5Tcopy(H5T_C_S1); }), H5Tclose);
      checked("text type", [&] { return H5Tset_size(type.id(), H5T_VARIABLE); });
      checked("text type", [&] { return H5Tset_cset(type.id(), H5T_CSET_UTF8); });
      return type;
    }

    Handle scalar_space()
    {
      return Handle(checked("scalar space", [] { return H5Screate(H5S_SCALAR); }), H5Sclose);
    }

    Handle simple_space(const std::vector<hsize_t> &extent, const std::vector<hsize_t> &maximum)
    {
      return Handle(checked("array space",
                            [&] { return H5Screate_simple(static_cast<int>(extent.size()), extent.data(), maximum.data()); }),
                    H5Sclose);
    }

    void write_attribute(const Handle &object, const std::string &name, const hid_t type, const void *data)
    {
      const Handle space = scalar_space();
      const Handle attribute(
          checked("attribute " + name,
                  [&] { return H5Acreate2(object.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT); }),
          H5Aclose);
      checked("attribute " + name, [&] { return H5Awrite(attribute.id(), type, data); });
    }

    Handle create_dataset(const Handle &location, const std::string &name, const hid_t type, const Handle &space,
                          const hid_t creation = H5P_DEFAULT)
    {
      return Handle(
          checked("dataset " + name,
                  [&] { return H5Dcreate2(location.id(), name.c_str(), type, space.id(), H5P_DEFAULT, creation, H5P_DEFAULT); }),
          H5Dclose);
    }

    Handle write_dataset(const Handle &location, const std::string &name, const hid_t type, const Handle &space, const void *data)
    {
      Handle dataset = create_dataset(location, name, type, space);
      checked("dataset " + name, [&] { return H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data); });
      return dataset;
    }

    /// One chunk, its bytes sorted before they are compressed.
    template <typename Number>
    Handle write_compressed(const Handle &location, const std::string &name, const hid_t type, const std::vector<Number> &values,
                            const std::size_t width)
    {
      Assert(values.size() % width == 0, dealii::ExcMessage("Not a whole number of rows."));
      std::vector<hsize_t> extent = { values.size() / width };
      if (width > 1)
        extent.push_back(width);
      Handle creation(checked("storage", [] { return H5Pcreate(H5P_DATASET_CREATE); }), H5Pclose);
      if (!values.empty())
      {
        checked("chunks", [&] { return H5Pset_chunk(creation.id(), static_cast<int>(extent.size()), extent.data()); });
        checked("compression", [&] { return H5Pset_shuffle(creation.id()); });
        checked("compression", [&] { return H5Pset_deflate(creation.id(), 1); });
      }
      Handle dataset = create_dataset(location, name, type, simple_space(extent, extent), creation.id());
      checked("dataset " + name, [&] { return H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()); });
      return dataset;
    }

    Handle chunked(const std::vector<hsize_t> &chunk)
    {
      Handle creation(checked("storage", [] { return H5Pcreate(H5P_DATASET_CREATE); }), H5Pclose);
      checked("chunks", [&] { return H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data()); });
      const double missing = std::numeric_limits<double>::quiet_NaN();
      checked("fill value", [&] { return H5Pset_fill_value(creation.id(), H5T_NATIVE_DOUBLE, &missing); });
      return creation;
    }
  } // namespace

  Handle create_file(const std::string &path)
  {
    const Handle access = file_access();
    return Handle(checked("creating " + path, [&] { return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()); }),
                  H5Fclose);
  }

  Handle open_file(const std::string &path)
  {
    const Handle access = file_access();
    return Handle(checked("opening " + path, [&] { return H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()); }), H5Fclose);
  }

  Handle open_abandoned_file(const std::string &path)
  {
    const Handle access = file_access();
    const hbool_t clear = true; // as h5clear does
    checked("file access", [&] { return H5Pset(access.id(), "clear_status_flags", &clear); });
    return Handle(checked("opening " + path, [&] { return H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()); }), H5Fclose);
  }

  std::string read_text(const Handle &location, const std::string &name)
  {
    const Handle dataset(checked("dataset " + name, [&] { return H5Dopen2(location.id(), name.c_str(), H5P_DEFAULT); }),
                         H5Dclose);
    char *text = nullptr;
    checked("dataset " + name, [&] { return H5Dread(dataset.id(), text_type().id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &text); });
    const std::string result = text != nullptr ? text : "";
    H5free_memory(text);
    return result;
  }

  void start_swmr_write(const Handle &file)
  {
    checked("letting others read", [&] { return H5Fstart_swmr_write(file.id()); });
  }

  void flush(const Handle &file)
  {
    checked("flushing", [&] { return H5Fflush(file.id(), H5F_SCOPE_LOCAL); });
  }

  Handle create_group(const Handle &location, const std::string &name)
  {
    return Handle(
        checked("group " + name, [&] { return H5Gcreate2(location.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT); }),
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

  Handle write_dataset(const Handle &location, const std::string &name, const std::string &text)
  {
    const char *const characters = text.c_str();
    return write_dataset(location, name, text_type().id(), scalar_space(), &characters);
  }

  Handle write_dataset(const Handle &location, const std::string &name, const double value)
  {
    return write_dataset(location, name, H5T_NATIVE_DOUBLE, scalar_space(), &value);
  }

  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values)
  {
    const std::vector<hsize_t> extent = { values.size() };
    return write_dataset(location, name, H5T_NATIVE_DOUBLE, simple_space(extent, extent), values.data());
  }

  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values,
                       const std::vector<std::size_t> &shape)
  {
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return write_dataset(location, name, H5T_NATIVE_DOUBLE, simple_space(extent, extent), values.data());
  }

  Handle write_rows(const Handle &location, const std::string &name, const std::vector<float> &values, const std::size_t width)
  {
    return write_compressed(location, name, H5T_NATIVE_FLOAT, values, width);
  }

  Handle write_rows(const Handle &location, const std::string &name, const std::vector<double> &values, const std::size_t width)
  {
    return write_compressed(location, name, H5T_NATIVE_DOUBLE, values, width);
  }

  Handle write_rows(const Handle &location, const std::string &name, const std::vector<unsigned int> &values,
                    const std::size_t width)
  {
    return write_compressed(location, name, H5T_NATIVE_UINT, values, width);
  }

  Series::Series(Handle created, std::vector<hsize_t> initial_extent)
      : dataset(std::move(created))
      , extent(std::move(initial_extent))
  {
  }

  Series::Series(const Handle &location, const std::string &name, const std::size_t chunk)
      : Series(create_dataset(location, name, H5T_NATIVE_DOUBLE, simple_space({ 0 }, { H5S_UNLIMITED }), chunked({ chunk }).id()),
               { 0 })
  {
  }

  Series Series::of_rows(const Handle &location, const std::string &name, const std::size_t width)
  {
    // A compressed chunk changes its length when a row is added to it, and the space it leaves is lost while others
    // read. With a row a chunk nothing is written twice.
    const Handle creation = chunked({ 1, width });
    checked("compression", [&] { return H5Pset_deflate(creation.id(), 4); });
    const Handle space = simple_space({ 0, width }, { H5S_UNLIMITED, width });
    return Series(create_dataset(location, name, H5T_NATIVE_DOUBLE, space, creation.id()), { 0, width });
  }

  void Series::append(const std::vector<double> &values)
  {
    const std::size_t width = extent.size() == 1 ? 1 : extent[1];
    Assert(values.size() % width == 0, dealii::ExcMessage("Not a whole number of rows."));
    std::vector<hsize_t> start(extent.size(), 0);
    std::vector<hsize_t> count = extent;
    start[0]                   = extent[0];
    count[0]                   = values.size() / width;
    extent[0] += count[0];
    checked("growing a dataset", [&] { return H5Dset_extent(dataset.id(), extent.data()); });
    const Handle whole(checked("space of a dataset", [&] { return H5Dget_space(dataset.id()); }), H5Sclose);
    checked("choosing rows",
            [&] { return H5Sselect_hyperslab(whole.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr); });
    const Handle rows = simple_space(count, count);
    checked("writing rows",
            [&] { return H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, rows.id(), whole.id(), H5P_DEFAULT, values.data()); });
  }
} // namespace sprag::hdf5
