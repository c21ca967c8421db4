// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/task_farm/task_farm.h"
#include "base/fingerprint.h"
#include "base/hdf5_handle.h"
#include "base/messages.h"
#include "base/system/interrupt.h"
#include "base/system/open_mpi.h"
#include "base/system/supervisor.h"
#include "base/system/terminal.h"
#include "fe/algebra/first_rank.h"
#include "fe/fields/help_first_rank.h"
#include "fe/mesh/geometry_script.h"
#include "input/read.h"
#include "program/arguments.h"
#include "program/outcome.h"
#include "program/output_folder.h"
#include "program/resources.h"
#include "program/run_log.h"
#include "run/run.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

// This program runs analyses with models and links their libraries; sprag executes it, or mpirun starts it. It does formulas as
// well.

namespace sprag
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    /// Processes of another program or scene than the first's would wait for what never comes, or give other results.
    void require_equal_arguments(const Scene &scene, const std::string &folder)
    {
      const auto fingerprints = gather(MPI_COMM_WORLD, fingerprint(program_fingerprint(), parameters_text(scene), folder));
      for (std::size_t rank = 1; rank < fingerprints.size(); ++rank)
        if (fingerprints[rank] != fingerprints[0])
          throw InputError(
              "process " + std::to_string(rank) +
              " of mpirun runs another program or scene than process 0, or to another --output: start the same on all machines");
    }

    void execute(const Arguments &arguments, const Scene &scene, const Rank &rank, RunLog &log)
    {
      const unsigned int processes = rank.is_alone ? 1 : MPI::n_mpi_processes(MPI_COMM_WORLD);
      require_useful_processes(scene, processes);
      const std::string folder = result_folder(arguments, scene);
      if (arguments.validate)
      {
        require_memory(scene, processes, folder);
        const auto warnings = validate(scene);
        if (!rank.is_first)
          return;
        if (!arguments.quiet)
          print_expectations(scene, processes, folder);
        return tell_validity(arguments, scene, warnings);
      }
      if (!rank.is_alone)
        require_equal_arguments(scene, folder);
      const auto claim = [&]
      {
        claim_folder(folder, scene, arguments.overwrite);
        require_memory(scene, processes, folder);
      };
      if (rank.is_alone)
        claim();
      else
        on_first_rank(claim);
      if (!rank.is_first && shares_body(scene))
        return help_first_rank(MPI_COMM_WORLD);
      const RunOptions options{ folder, arguments.quiet || !rank.is_first, arguments.verbose, &log, processes };
      std::optional<RanksAtHand> others;
      if (shares_body(scene))
        others.emplace(MPI_COMM_WORLD);
      run(scene, options);
    }

    /// Returns true if MPI is needed: by PETSc and meshes, or because processes share the work.
    bool needs_mpi(const Scene &scene)
    {
      return needs_mesh(scene) || is_checked_by_mesh(scene) || scene.spring.type == SpringType::leaf ||
             works_in_parallel(scene.analysis.type);
    }

    Rank rank_in_mpi()
    {
      return { MPI::this_mpi_process(MPI_COMM_WORLD) == 0, MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 };
    }

    /// Others would wait for ever for a rank that has failed alone.
    void wait_for_others(const Outcome &outcome, const Rank &rank)
    {
      if (rank.is_alone)
        return;
      using Clock          = std::chrono::steady_clock;
      const auto end       = Clock::now() + std::chrono::duration<double>(process_grace);
      MPI_Request together = MPI_REQUEST_NULL;
      MPI_Ibarrier(MPI_COMM_WORLD, &together);
      for (int done = 0; MPI_Test(&together, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && done == 0;)
      {
        if (outcome.status != success && Clock::now() > end)
        {
          if (!rank.is_first)
            report_error(outcome.failure);
          MPI_Abort(MPI_COMM_WORLD, outcome.status);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }

    int exit_status(const Arguments &arguments, const std::optional<Scene> &scene, const std::timespec &since, const Rank &rank,
                    RunLog &log)
    {
      const auto work = [&](const Scene &run_scene)
      {
        try
        {
          execute(arguments, run_scene, rank, log);
        }
        catch (const dealii::ExceptionBase &error)
        {
          throw std::runtime_error(error_message(error));
        }
      };
      try
      {
        const auto outcome = run_to_outcome(arguments, scene, since, rank, work);
        wait_for_others(outcome, rank);
        return outcome.status;
      }
      catch (const std::exception &error)
      {
        report_error(error.what());
        MPI_Abort(MPI_COMM_WORLD, analysis_failed);
        return analysis_failed;
      }
    }
  } // namespace
} // namespace sprag

int main(int argc, char **argv)
{
  using namespace sprag;
  TerminalLines output(std::cout, STDOUT_FILENO), messages(std::cerr, STDERR_FILENO);
  Arguments arguments;
  if (const auto status = read_arguments(argc, argv, arguments))
    return *status;
  if (arguments.trust_scripts)
    trust_scripts();
  const std::timespec since = file_time();
  std::optional<Scene> scene;
  if (!under_mpi() || !arguments.print_parameters.empty())
    try
    {
      if (!arguments.print_parameters.empty())
      {
        print_xml(printed_parameters(arguments));
        return success;
      }
      scene = load_scene(arguments);
      set_up_mpi_for_one();
    }
    catch (const InputError &error)
    {
      return report_error(error);
    }
  RunLog log(argc, argv);
  int no_arguments = 1;
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  if (!scene || needs_mpi(*scene))
    mpi.emplace(no_arguments, argv, 1);
  dealii::MultithreadInfo::set_thread_limit(1);
  hdf5::silence();
  catch_interrupts();
  return exit_status(arguments, scene, since, mpi ? rank_in_mpi() : Rank(), log);
}
