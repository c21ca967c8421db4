// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/first_rank.h"

#include <deal.II/base/mpi.h>

#include <array>
#include <chrono>
#include <thread>

namespace sprag
{
  namespace
  {
    constexpr std::chrono::microseconds nap{ 200 };

    MPI_Comm at_hand  = MPI_COMM_SELF;
    int bodies_so_far = 0;

    using Message = std::array<int, 2>;

    /// Sends or receives one, which the first rank gives.
    MPI_Request share(Message &message, const MPI_Comm ranks)
    {
      MPI_Request result;
      MPI_Ibcast(message.data(), static_cast<int>(message.size()), MPI_INT, 0, ranks, &result);
      return result;
    }
  } // namespace

  void call_others(const SharedCall &call, const MPI_Comm ranks)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(ranks) == 1)
      return;
    Message message{ { static_cast<int>(call.task), call.body } };
    MPI_Request request = share(message, ranks);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  }

  SharedCall next_call(const MPI_Comm ranks)
  {
    Message message{};
    MPI_Request request = share(message, ranks);
    for (int has_come = 0; has_come == 0;)
    {
      MPI_Test(&request, &has_come, MPI_STATUS_IGNORE);
      if (has_come == 0)
        std::this_thread::sleep_for(nap);
    }
    return { static_cast<SharedTask>(message[0]), message[1] };
  }

  RanksAtHand::RanksAtHand(const MPI_Comm ranks)
  {
    at_hand = ranks;
  }

  RanksAtHand::~RanksAtHand()
  {
    call_others({ SharedTask::end, 0 }, at_hand);
    at_hand = MPI_COMM_SELF;
  }

  MPI_Comm ranks_at_hand()
  {
    return at_hand;
  }

  BodyCalls::BodyCalls()
      : ranks(at_hand)
      , number(bodies_so_far++)
  {
  }

  void BodyCalls::operator()(const SharedTask task) const
  {
    if (number)
      call_others({ task, *number }, ranks);
  }
} // namespace sprag
