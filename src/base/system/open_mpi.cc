// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/open_mpi.h"

#include "base/system/terminal.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <sched.h>
#include <sstream>
#include <string>
#include <sys/prctl.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace sprag
{
  namespace
  {
    bool is_on_path(const std::string &program)
    {
      const char *path = std::getenv("PATH");
      std::istringstream folders(path != nullptr ? path : "");
      for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((folder + "/" + program).c_str(), X_OK) == 0)
          return true;
      return false;
    }

    /// mpirun ends where it cannot keep its sessions there, but takes /tmp where nothing is named.
    void forget_unwritable_folder(const char *const variable)
    {
      const char *const folder = std::getenv(variable);
      if (folder == nullptr)
        return;
      std::string trial = std::string(folder) + "/sprag-XXXXXX";
      if (::mkdtemp(trial.data()) == nullptr)
        ::unsetenv(variable);
      else
        ::rmdir(trial.c_str());
    }

    void set_environment()
    {
      forget_unwritable_folder("TMPDIR");
      // Kept where they are set already.
      for (const char *name : { "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS" })
        ::setenv(name, "1", 0);
      for (const auto &[descriptor, variable] :
           { std::pair{ STDERR_FILENO, terminal_variable }, std::pair{ STDOUT_FILENO, output_terminal_variable } })
        if (is_terminal(descriptor))
          ::setenv(variable, std::to_string(terminal_width(descriptor)).c_str(), 1);
      if (::geteuid() == 0)
        for (const char *name : { "OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM" })
          ::setenv(name, "1", 0);
    }
  } // namespace

  unsigned int available_cores()
  {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? static_cast<unsigned int>(CPU_COUNT(&cores)) : 1;
  }

  bool under_mpi()
  {
    for (const char *name : { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK" })
      if (std::getenv(name) != nullptr)
        return true;
    return false;
  }

  void set_up_mpi_for_one()
  {
    for (const auto &[name, value] : { std::pair{ "OMPI_MCA_ess_singleton_isolated", "1" }, std::pair{ "OMPI_MCA_pml", "ob1" },
                                       std::pair{ "OMPI_MCA_btl", "self" }, std::pair{ "OMPI_MCA_orte_create_session_dirs", "0" },
                                       std::pair{ "HWLOC_SYNTHETIC", "core:1 pu:1" } })
      ::setenv(name, value, 0);
  }

  bool works_on_all_cores(const unsigned int processes)
  {
    return processes >= 2 && !under_mpi() && is_on_path("mpirun");
  }

  void become_mpirun(char **arguments, const unsigned int processes)
  {
    // A group of its own: a terminal's Ctrl-C reaches the parent alone. Its end is that of the ranks.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0)
      ::dup2(nothing, STDIN_FILENO);
    set_environment();
    const std::string number          = std::to_string(processes);
    const std::string program         = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<const char *> command = { "mpirun",          "-q",           "-n", number.c_str(), "--bind-to", "none",
                                          "--oversubscribe", program.c_str() };
    for (char **argument = arguments + 1; *argument != nullptr; ++argument)
      command.push_back(*argument);
    command.push_back(nullptr);
    ::execvp("mpirun", const_cast<char *const *>(command.data()));
  }
} // namespace sprag
