// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// Returns whether there is one rank, as before MPI has begun.
  bool is_alone(MPI_Comm ranks);

  /// Returns the bytes of the first rank on all ranks.
  std::string broadcast_bytes(MPI_Comm ranks, std::string bytes);

  /// Returns the bytes of each rank on all ranks.
  std::vector<std::string> gather_bytes(MPI_Comm ranks, const std::string &bytes);

  /// Returns what the first rank has on all ranks, see Archive. deal.II's function of this name compresses by Boost, which takes
  /// seconds to compile.
  template <class Item>
  Item broadcast(const MPI_Comm ranks, Item item)
  {
    if (is_alone(ranks))
      return item;
    Archive written;
    written(item);
    Archive received(broadcast_bytes(ranks, written.bytes()));
    received(item);
    return item;
  }

  /// Returns what each rank has on all ranks.
  template <class Item>
  std::vector<Item> gather(const MPI_Comm ranks, Item item)
  {
    Archive written;
    written(item);
    std::vector<Item> items;
    for (auto &bytes : gather_bytes(ranks, written.bytes()))
    {
      Archive received(std::move(bytes));
      received(items.emplace_back());
    }
    return items;
  }
} // namespace sprag
