// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/child_process.h"

#include "base/errors.h"
#include "base/system/interrupt.h"
#include "base/system/open_file.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    [[noreturn]] void be_child(const std::function<std::string()> &work, const int pipe, const pid_t parent)
    {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (::getppid() != parent)
        ::_exit(1);
      forget_signal_handlers();
      if (const int nothing = ::open("/dev/null", O_RDWR); nothing >= 0)
        for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
          ::dup2(nothing, stream);
      try
      {
        ::_exit(write_all(pipe, work()) ? 0 : 1);
      }
      catch (...)
      {
        ::_exit(1);
      }
    }

    /// Bytes up to the pipe's end; false when the time is over or the run is interrupted first.
    bool read_all(const int pipe, const double seconds, const bool interruptible, std::string &text)
    {
      const auto begin = Clock::now();
      char buffer[65536];
      for (;;)
      {
        pollfd ready{ pipe, POLLIN, 0 };
        if (::poll(&ready, 1, 50) > 0)
        {
          const auto count = ::read(pipe, buffer, sizeof buffer);
          if (count == 0)
            return true;
          if (count > 0)
            text.append(buffer, static_cast<std::size_t>(count));
        }
        const std::chrono::duration<double> passed = Clock::now() - begin;
        if ((interruptible && interrupted()) || (seconds > 0. && passed.count() > seconds))
          return false;
      }
    }

    std::string describe_failure(const int status)
    {
      if (WIFSIGNALED(status))
        return std::string("crashes (") + ::strsignal(WTERMSIG(status)) + ")";
      return WEXITSTATUS(status) == 0 ? "" : "fails";
    }
  } // namespace

  ChildAnswer in_child_process(const std::function<std::string()> &work, const double seconds)
  {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw AnalysisError(std::string("no pipe to a process of its own: ") + std::strerror(errno));
    const bool interruptible = !interrupted(); // or it belongs to the end
    const pid_t parent       = ::getpid();
    const pid_t child        = ::fork();
    if (child == 0)
      be_child(work, ends[1], parent);
    ::close(ends[1]);
    ChildAnswer answer;
    const bool all = child > 0 && read_all(ends[0], seconds, interruptible, answer.text);
    ::close(ends[0]);
    if (child < 0)
      throw AnalysisError("no process can be made: there are too many, or too little memory");
    if (!all)
      ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
    {
    }
    if (!all && interruptible && interrupted())
      throw AnalysisError(interruption);
    answer.failure = all ? describe_failure(status) : "does not come to an end";
    return answer;
  }

  void execute_beside(const std::string &name, char **arguments)
  {
    // Page faults took a tenth to a fifth of a run's time. Large pages, where the system gives them on request, leave few.
    ::setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 0);
    const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename(name);
    ::execv(program.c_str(), arguments);
    throw InputError(program.string() + " cannot be run: " + std::strerror(errno) + ": it must lie beside sprag");
  }

  void limit_growth(const std::size_t bytes)
  {
#ifdef __SANITIZE_ADDRESS__
    static_cast<void>(bytes);
#else
    std::ifstream pages("/proc/self/statm");
    rlim_t size = 0;
    if (!(pages >> size))
      return;
    const rlim_t end = size * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + bytes;
    rlimit limit     = {};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= end)
      return;
    limit.rlim_cur = end;
    ::setrlimit(RLIMIT_AS, &limit);
#endif
  }
} // namespace sprag
