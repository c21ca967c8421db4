// SPDX-License-Identifier: GPL-3.0-only
#include "base/hdf5_handle.h"
#include "base/system/child_process.h"
#include "base/system/interrupt.h"
#include "base/system/open_mpi.h"
#include "base/system/supervisor.h"
#include "base/system/terminal.h"
#include "input/read.h"
#include "program/arguments.h"
#include "program/outcome.h"
#include "program/output_folder.h"
#include "program/resources.h"
#include "program/run_by_formulas.h"
#include "program/run_log.h"
#include "report/warnings.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <csignal>
#include <cstring>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

// The program that one calls. It reads, checks and supervises runs and does itself what formulas answer; for models, which take
// some 200 shared libraries, it becomes sprag-models. Linking it says what it must not use.

namespace sprag
{
  namespace
  {
    /// Models overflow a smaller stack [bytes].
    constexpr rlim_t least_stack = 1024 * 1024;

    void require_stack()
    {
      rlimit limit = {};
      if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least_stack)
        return;
      const auto soft_limit = limit.rlim_cur;
      limit.rlim_cur        = least_stack;
      if (limit.rlim_max < least_stack || ::setrlimit(RLIMIT_STACK, &limit) != 0)
        throw InputError("the stack may have " + std::to_string(soft_limit / 1024) + " kB by ulimit -s: must be at least " +
                         std::to_string(least_stack / 1024) + " kB");
    }

    void require_processor()
    {
#ifdef __AVX2__
      if (!__builtin_cpu_supports("avx2"))
        throw InputError("this build needs a processor with AVX2, which this one lacks: configure it anew here, or with "
                         "-DSPRAG_AVX2=OFF");
#endif
    }

    std::string describe_end(const WorkEnd &end)
    {
      const bool by_user = end.requested || end.signal == SIGINT || end.signal == SIGTERM || end.signal == SIGHUP;
      if (by_user)
        return interruption;
      if (end.signal == SIGKILL)
        return "killed by the system, probably for want of memory; every finished step is kept";
      const std::string reason = end.signal != 0 ? strsignal(end.signal) : "exit status " + std::to_string(end.status);
      return "crashed (" + reason + "); every finished step is kept";
    }

    /// The exit status of a run that was supervised.
    int conclude(const WorkEnd &end, const Arguments &arguments, const Scene &scene, const std::timespec &since)
    {
      const bool ended_itself = end.signal == 0 && end.status <= bad_input;
      if (ended_itself && end.status != analysis_failed)
        return end.status;
      const std::string fate = describe_end(end);
      const bool unfinished  = finish(arguments, scene, fate, since);
      if (unfinished)
        add_to_log(result_folder(arguments, scene), fate);
      return ended_itself && !unfinished ? analysis_failed : report_error(fate);
    }

    /// Cells of a map or runs of a study.
    std::size_t count_pieces(const Scene &scene)
    {
      if (scene.analysis.type == AnalysisType::map)
        return std::size_t(scene.map.first.points) * scene.map.second.points;
      std::size_t runs = 1;
      for (const auto &parameter : scene.study.varied)
        runs = scene.study.combine == Combination::grid ? runs * parameter.values.size() : parameter.values.size();
      return runs;
    }

    /// More than there are pieces would only wait.
    unsigned int processes_for(const Arguments &arguments, const Scene &scene)
    {
      const unsigned int n_jobs = arguments.jobs > 0 ? arguments.jobs : available_cores();
      return works_in_parallel(scene.analysis.type) && count_pieces(scene) < n_jobs
                 ? static_cast<unsigned int>(count_pieces(scene))
                 : n_jobs;
    }

    bool needs_models(const Arguments &arguments, const Scene &scene)
    {
      if (scene.spring.type == SpringType::leaf || scene.analysis.type == AnalysisType::study)
        return true;
      const bool tells_nothing = arguments.validate && arguments.quiet;
      return tells_nothing ? needs_mesh(scene) : !follows_formulas(scene);
    }

    void do_without_models(const Arguments &arguments, const Scene &scene, RunLog &log)
    {
      if (arguments.validate)
      {
        require_memory(scene);
        if (!arguments.quiet)
          print_cost(std::cout, formula_cost(scene));
        return tell_validity(arguments, scene, scene_warnings(scene));
      }
      const std::string folder = result_folder(arguments, scene);
      claim_folder(folder, scene, arguments.overwrite);
      require_memory(scene);
      const RunOptions options{ folder, arguments.quiet, arguments.verbose, &log };
      run_from_margin_to_warnings(scene, options, run_formulas);
    }

    int run_looked_after(const Arguments &arguments, const std::timespec &since, const int argc, char **argv)
    {
      if (!arguments.print_parameters.empty())
      {
        if (arguments.print_parameters != "prm")
          execute_beside("sprag-models", argv); // which reads them again
        std::cout << printed_parameters(arguments);
        return success;
      }
      const Scene scene            = load_scene(arguments);
      const unsigned int processes = processes_for(arguments, scene);
      // A map or a study is carried out by several processes. A folder that cannot serve is for the run itself to refuse.
      const bool on_all_cores = is_run(arguments) && works_in_parallel(scene.analysis.type) && works_on_all_cores(processes);
      if (const auto end = on_all_cores ? supervise(SIGTERM, process_grace) : supervise(SIGKILL, grace))
        return conclude(*end, arguments, scene, since);
      if (on_all_cores)
        become_mpirun(argv, processes);
      if (needs_models(arguments, scene))
        execute_beside("sprag-models", argv);
      hdf5::silence();
      catch_interrupts();
      RunLog log(argc, argv);
      return run_to_outcome(arguments, scene, since, {},
                            [&](const Scene &run_scene) { do_without_models(arguments, run_scene, log); })
          .status;
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
  const std::timespec since = file_time();
  try
  {
    require_processor();
    require_stack();
    if (under_mpi() && arguments.print_parameters.empty())
      execute_beside("sprag-models", argv);
    return run_looked_after(arguments, since, argc, argv);
  }
  catch (const InputError &error)
  {
    return report_error(error);
  }
  catch (const std::exception &error)
  {
    return report_error(error.what());
  }
}
