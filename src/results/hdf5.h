// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/hdf5_handle.h"

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

/// Files of HDF5. Every function throws AnalysisError with the library's own message. deal.II brings the parallel HDF5, which is
/// not to be used after MPI is finalised. But for open_together() a file is used by one process, with the default driver.
namespace sprag::hdf5
{
  /// Creates or overwrites a file in the newest format.
  Handle create_file(const std::string &path);

  /// Opens an existing file for reading and writing; an abandoned one also where it is still marked as being written, as its
  /// writer was killed.
  Handle open_file(const std::string &path, bool abandoned = false);

  /// Opens an existing file for writing by all of several processes together, which must make the same calls from then on.
  Handle open_together(const std::string &path, MPI_Comm ranks);

  /// Opens an existing file for reading, also one that is being written or whose writer was killed.
  Handle open_to_read(const std::string &path);

  /// Returns whether there is such an object in a file or group.
  inline bool has(const Handle &location, const std::string &name)
  {
    return H5Lexists(location.id(), name.c_str(), H5P_DEFAULT) > 0;
  }

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

  /// Rows of create_rows() that processes never share.
  constexpr std::size_t rows_together = 8192;

  /// Creates a dataset for `rows` rows of `width` numbers of a type of the library each.
  Handle create_rows(const Handle &location, const std::string &name, hid_t type, std::size_t rows, std::size_t width);

  /// The same of float, double or unsigned int.
  template <class Number>
  Handle create_rows(const Handle &location, const std::string &name, const std::size_t rows, const std::size_t width)
  {
    const hid_t number_type = std::is_same_v<Number, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_UINT;
    return create_rows(location, name, std::is_same_v<Number, float> ? H5T_NATIVE_FLOAT : number_type, rows, width);
  }

  /// Writes so many rows of such a dataset from the one numbered `first` on. In a file of open_together() each process writes its
  /// own, which may be none.
  void write_rows(const Handle &file, const std::string &name, std::size_t first, std::size_t rows, const void *values);

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
