// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/shared_writing.h"

#include "base/errors.h"
#include "base/messages.h"
#include "base/system/open_file.h"
#include "results/hdf5.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <optional>

namespace sprag
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    /// Plan of a file that all processes write: its path and datasets.
    struct Plan
    {
      std::string path;
      std::vector<DatasetRows> datasets;
    };

    SPRAG_SERIALISE(Plan, path, datasets)

    /// Returns where the rows of a rank begin, at a chunk: the rank behind the last has none.
    std::size_t first_row(const std::size_t rows, const unsigned int rank, const unsigned int ranks)
    {
      const std::size_t chunks = (rows + hdf5::rows_together - 1) / hdf5::rows_together;
      return std::min(rows, (chunks * rank + ranks - 1) / ranks * hdf5::rows_together);
    }

    /// Hands the first rank's rows out. The others receive theirs in `received`.
    void hand_out(const DatasetRows &all, const MPI_Comm ranks, std::vector<char> &received)
    {
      const unsigned int n = MPI::n_mpi_processes(ranks);
      std::vector<int> first, count;
      for (unsigned int rank = 0; rank < n; ++rank)
      {
        first.push_back(static_cast<int>(first_row(all.rows, rank, n)));
        count.push_back(static_cast<int>(first_row(all.rows, rank + 1, n)) - first.back());
      }
      const unsigned int rank = MPI::this_mpi_process(ranks);
      received.resize(rank == 0 ? 0 : count[rank] * all.row_size);
      MPI_Datatype row;
      MPI_Type_contiguous(static_cast<int>(all.row_size), MPI_BYTE, &row);
      MPI_Type_commit(&row);
      MPI_Scatterv(all.values, count.data(), first.data(), row, rank == 0 ? MPI_IN_PLACE : received.data(), count[rank], row, 0,
                   ranks);
      MPI_Type_free(&row);
    }

    std::string named(const std::string &problem, const std::size_t rank)
    {
      return (rank > 0 ? "process " + std::to_string(rank) + " of mpirun: " : "") + problem;
    }

    /// Throws in all processes where one of them cannot write the file: in the midst of it the others would wait for ever.
    void require_access(const std::string &path, const MPI_Comm ranks)
    {
      std::string problem;
      if (!OpenFile(path, O_RDWR).is_open())
        problem = "cannot write " + path + ": " + std::strerror(errno);
      const auto problems = gather(ranks, problem);
      for (std::size_t rank = 0; rank < problems.size(); ++rank)
        if (!problems[rank].empty())
          throw AnalysisError(named(problems[rank], rank) + (rank > 0 ? ". All of them need the folder of --output" : ""));
    }

    /// Ends all processes if one fails alone, as by a full disk: the others would wait for it inside of libraries.
    template <class Work>
    void all_or_end(const std::string &path, const MPI_Comm ranks, const Work &work)
    {
      try
      {
        work();
      }
      catch (const AnalysisError &error)
      {
        if (MPI::n_mpi_processes(ranks) == 1)
          throw;
        std::cerr << "sprag: " << named("writing " + path + ": " + error.what(), MPI::this_mpi_process(ranks)) << std::endl;
        MPI_Abort(ranks, 1);
      }
    }

    void write_shares(const Plan &plan, const MPI_Comm ranks)
    {
      const unsigned int rank = MPI::this_mpi_process(ranks), n = MPI::n_mpi_processes(ranks);
      std::vector<std::vector<char>> received(plan.datasets.size());
      for (std::size_t i = 0; i < received.size(); ++i)
        hand_out(plan.datasets[i], ranks, received[i]);
      require_access(plan.path, ranks);
      std::optional<hdf5::Handle> file; // not closed where one process fails, which would wait for the others
      const auto write = [&]
      {
        file.emplace(n == 1 ? hdf5::open_file(plan.path) : hdf5::open_together(plan.path, ranks));
        for (std::size_t i = 0; i < received.size(); ++i)
        {
          const auto &all         = plan.datasets[i];
          const std::size_t first = first_row(all.rows, rank, n), end = first_row(all.rows, rank + 1, n);
          hdf5::write_rows(*file, all.dataset, first, end - first, rank == 0 ? all.values : received[i].data());
        }
        file->close();
      };
      all_or_end(plan.path, ranks, write);
    }
  } // namespace

  void serialise(Archive &archive, DatasetRows &rows)
  {
    archive(rows.dataset, rows.rows, rows.row_size);
  }

  void write_rows(const std::string &path, const std::vector<DatasetRows> &all, const Writers &writers)
  {
    if (writers.call_others)
      writers.call_others();
    Plan plan{ path, all };
    Archive archive;
    serialise(archive, plan);
    broadcast_bytes(writers.ranks, archive.bytes());
    write_shares(plan, writers.ranks);
  }

  void take_part_in_writing(const MPI_Comm ranks)
  {
    Plan plan;
    Archive archive(broadcast_bytes(ranks, std::string()));
    serialise(archive, plan);
    write_shares(plan, ranks);
  }
} // namespace sprag
