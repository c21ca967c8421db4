// SPDX-License-Identifier: GPL-3.0-only
#include "base/messages.h"

#include <algorithm>
#include <cstdint>

namespace sprag
{
  namespace
  {
    constexpr std::uint64_t most_at_once = 1 << 30; // MPI counts by int

    int count_ranks(const MPI_Comm ranks)
    {
      int initialised = 0, number = 1;
      MPI_Initialized(&initialised);
      if (initialised != 0)
        MPI_Comm_size(ranks, &number);
      return number;
    }

    /// Gives all ranks the bytes of one of them.
    void send(const MPI_Comm ranks, const int root, std::string &bytes)
    {
      std::uint64_t size = bytes.size();
      MPI_Bcast(&size, 1, MPI_UINT64_T, root, ranks);
      bytes.resize(size);
      for (std::uint64_t first = 0; first < size; first += most_at_once)
        MPI_Bcast(&bytes[first], static_cast<int>(std::min(most_at_once, size - first)), MPI_BYTE, root, ranks);
    }
  } // namespace

  bool is_alone(const MPI_Comm ranks)
  {
    return count_ranks(ranks) == 1;
  }

  std::string broadcast_bytes(const MPI_Comm ranks, std::string bytes)
  {
    if (!is_alone(ranks))
      send(ranks, 0, bytes);
    return bytes;
  }

  std::vector<std::string> gather_bytes(const MPI_Comm ranks, const std::string &bytes)
  {
    std::vector<std::string> all(count_ranks(ranks), bytes);
    for (std::size_t rank = 0; all.size() > 1 && rank < all.size(); ++rank)
      send(ranks, static_cast<int>(rank), all[rank]);
    return all;
  }
} // namespace sprag
