#pragma once

#include "base/hdf5_handle.h"

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

/// Files of HDF5. Every function throws AnalysisError with the library's own message. deal.II brings the parallel HDF5; it is
/// used serially here, with the default driver, and not after MPI is finalised.
namespace sprag::hdf5
{
  /// Creates or overwrites a file in the newest format.
  Handle create_file(const std::string &path);

  /// Opens an existing file for reading and writing; an abandoned one also where it is still marked as being written, as its
  /// writer was killed.
  Handle open_file(const std::string &path, bool abandoned = false);

  /// Opens an existing file for reading, also one that is being written or whose writer was killed.
  Handle open_to_read(const std::string &path);

  /// Returns whether there is such an object in a file or group.
  bool has(const Handle &location, const std::string &name);

  /// Reads a scalar text.
  std::string read_text(const Handle &location, const std::string &name);

  Handle create_group(const Handle &location, const std::string &name);

  void write_attribute(const Handle &object, const std::string &name, const std::string &text);
  void write_attribute(const Handle &object, const std::string &name, double value);

  /// Writes the attributes that every dataset has.
  void describe(const Handle &dataset, const std::string &unit, const std::string &description);

  // Datasets of fixed size, complete when written. Without a shape they have one dimension.
  Handle write_dataset(const Handle &location, const std::string &name, const std::string &text);
  Handle write_dataset(const Handle &location, const std::string &name, double value);
  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<std::string> &texts);
  Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values,
                       const std::vector<std::size_t> &shape = {});

  /// Writes `rows` rows of `width` numbers of a type of the library each, compressed.
  Handle write_rows(const Handle &location, const std::string &name, hid_t type, const void *values, std::size_t rows,
                    std::size_t width);

  /// Writes float, double or unsigned int in rows of `width` numbers each, compressed.
  template <class Number>
  Handle write_rows(const Handle &location, const std::string &name, const std::vector<Number> &values, const std::size_t width)
  {
    const hid_t of_double = std::is_same_v<Number, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_UINT;
    return write_rows(location, name, std::is_same_v<Number, float> ? H5T_NATIVE_FLOAT : of_double, values.data(),
                      values.size() / width, width);
  }

  /// A dataset of doubles to which rows are appended.
  class Series
  {
  public:
    /// Creates the dataset. A row is one number, or numbers of the shape given, which are compressed; `chunk` rows are stored
    /// together.
    Series(const Handle &location, const std::string &name, std::size_t chunk, const std::vector<hsize_t> &row = {});

    const Handle &handle() const
    {
      return dataset;
    }

    /// Appends whole rows, one after another.
    void append(const std::vector<double> &values);

  private:
    std::vector<hsize_t> extent; ///< the number of rows and the shape of a row
    Handle dataset;
  };
} // namespace sprag::hdf5
