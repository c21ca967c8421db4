#include "fe/solid/first_rank.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <thread>

namespace sprag
{
  namespace
  {
    constexpr std::chrono::microseconds nap{ 200 };
  }

  void call_others(const SharedTask task, const MPI_Comm ranks)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(ranks) == 1)
      return;
    int what = static_cast<int>(task);
    MPI_Request request;
    MPI_Ibcast(&what, 1, MPI_INT, 0, ranks, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  }

  SharedTask next_call(const MPI_Comm ranks)
  {
    int what = 0;
    MPI_Request request;
    MPI_Ibcast(&what, 1, MPI_INT, 0, ranks, &request);
    for (int has_come = 0; has_come == 0;)
    {
      MPI_Test(&request, &has_come, MPI_STATUS_IGNORE);
      if (has_come == 0)
        std::this_thread::sleep_for(nap);
    }
    return static_cast<SharedTask>(what);
  }
} // namespace sprag
