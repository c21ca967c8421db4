#pragma once

#include "base/hdf5_handle.h"

#include <cstddef>
#include <hdf5.h>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  // A thin owner of the HDF5 C API's identifiers. Every function throws AnalysisError with the library's own message.
  // deal.II brings the parallel HDF5; it is used serially here, with the default driver, and not after MPI is finalised.
  namespace hdf5
  {
    /// Creates or overwrites a file in the newest format.
    Handle create_file(const std::string &path);

    /// Opens an existing file for reading and writing.
    Handle open_file(const std::string &path);

    /// The same of a file that is still marked as being written, as its writer was killed.
    Handle open_abandoned_file(const std::string &path);

    /// A scalar text.
    std::string read_text(const Handle &location, const std::string &name);

    /// From here on others can read along; no object and no attribute can be created any more.
    void start_swmr_write(const Handle &file);

    /// Hands everything written so far to the operating system.
    void flush(const Handle &file);

    Handle create_group(const Handle &location, const std::string &name);

    void write_attribute(const Handle &object, const std::string &name, const std::string &text);
    void write_attribute(const Handle &object, const std::string &name, double value);

    // Datasets of fixed size, complete when written.
    Handle write_dataset(const Handle &location, const std::string &name, const std::string &text);
    Handle write_dataset(const Handle &location, const std::string &name, double value);
    Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values);
    Handle write_dataset(const Handle &location, const std::string &name, const std::vector<double> &values,
                         const std::vector<std::size_t> &shape);

    // Rows of `width` numbers each, compressed; in single precision, or as they are.
    Handle write_rows(const Handle &location, const std::string &name, const std::vector<float> &values, std::size_t width);
    Handle write_rows(const Handle &location, const std::string &name, const std::vector<double> &values, std::size_t width);
    Handle write_rows(const Handle &location, const std::string &name, const std::vector<unsigned int> &values,
                      std::size_t width);

    /// A dataset of doubles to which rows are appended: [rows] or [rows x width].
    class Series
    {
    public:
      /// One number a row, `chunk` rows stored together.
      Series(const Handle &location, const std::string &name, std::size_t chunk);

      /// `width` > 0 numbers a row, every row compressed by itself: a row that is flushed is never written again.
      static Series of_rows(const Handle &location, const std::string &name, std::size_t width);

      const Handle &handle() const
      {
        return dataset;
      }

      /// Whole rows, one after another.
      void append(const std::vector<double> &values);

    private:
      Series(Handle created, std::vector<hsize_t> initial_extent);

      Handle dataset;
      std::vector<hsize_t> extent; ///< rows, and width where there is one
    };
  } // namespace hdf5
} // namespace sprag
