// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sprag
{
  /// The processes that write large data together. The first has the data, calls the others and sends them the list.
  struct Writers
  {
    MPI_Comm ranks = MPI_COMM_SELF;
    std::function<void()> call_others{}; ///< to take_part_in_writing(); there are none without it
  };

  /// Rows of numbers for a dataset of hdf5::create_rows() that has none yet.
  struct DatasetRows
  {
    std::string dataset; ///< its path in the file
    std::size_t rows;
    std::size_t row_size; ///< [bytes]
    const void *values;   ///< of the first process
  };

  /// Serialises what all processes know of them.
  void serialise(Archive &archive, DatasetRows &rows);

  /// Writes the rows of datasets of a file that is closed: each process compresses and writes some chunks of each. To be called
  /// by the first. Throws AnalysisError where any of the processes cannot open the file; what fails later in one of several ends
  /// all of them with a message.
  void write_rows(const std::string &path, const std::vector<DatasetRows> &all, const Writers &writers);

  /// Takes part in it. To be called by the others; throws as the first.
  void take_part_in_writing(MPI_Comm ranks);
} // namespace sprag
