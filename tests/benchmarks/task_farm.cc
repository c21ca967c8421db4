// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/task_farm.h"
#include "base/phase_timer.h"
#include "input/read.h"
#include "scene/scene.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

// Shows how many ranks a study feeds: runs sleep in place of working, so that two cores stand for many. See README.md.

int main(int argc, char **argv)
{
  using namespace sprag;
  if (argc != 5)
  {
    std::cerr << "task_farm SCENE.prm OUTPUT SECONDS_OF_A_RUN RUNS_PER_RANK\n";
    return 2;
  }
  const std::chrono::duration<double> duration(std::atof(argv[3]));
  const auto runs_per_rank = static_cast<std::size_t>(std::atoi(argv[4]));
  const Scene scene        = read_scene(argv[1]);
  const std::string folder = argv[2];
  int no_arguments         = 1;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  const auto n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t run = 0; run < runs_per_rank * n_ranks; ++run)
    groups.push_back({ run });
  FarmProgress progress{ ProgressStyle::quiet };
  TaskFarm farm(scene, { folder, true, is_first_rank() }, { "study", "runs", "done again" }, progress);
  const double begin = monotonic_seconds();
  farm.carry_out(
      groups,
      [&](std::size_t)
      {
        std::this_thread::sleep_for(duration);
        return to_line(1.);
      },
      [](const std::string &) {});
  if (is_first_rank())
    std::cout << n_ranks << " ranks, runs of " << duration.count()
              << " s: " << duration.count() * static_cast<double>(runs_per_rank) / (monotonic_seconds() - begin)
              << " of the time is work\n";
  farm.remove_log();
}
