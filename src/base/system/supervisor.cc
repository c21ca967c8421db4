// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/supervisor.h"

#include <chrono>
#include <csignal>
#include <ctime>
#include <initializer_list>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    sigset_t watched_signals()
    {
      sigset_t signals;
      sigemptyset(&signals);
      for (const int signal : { SIGINT, SIGTERM, SIGCHLD })
        sigaddset(&signals, signal);
      struct sigaction hangup = {};
      if (::sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) // ignored under nohup
        sigaddset(&signals, SIGHUP);
      return signals;
    }

    /// The next of the signals, or 0 after a tenth of a second without one.
    int next_signal(const sigset_t &signals)
    {
      const timespec pause = { 0, 100'000'000 };
      const int signal     = ::sigtimedwait(&signals, nullptr, &pause);
      return signal < 0 || signal == SIGCHLD ? 0 : signal;
    }

    /// Ends a process on request of the user: first by a signal, later by force.
    struct Ending
    {
      const pid_t process;
      const int last_signal;
      const std::chrono::duration<double> timeout;
      unsigned int requests  = 0;
      bool is_forced         = false;
      Clock::time_point sent = {};

      void ask()
      {
        ++requests;
        if (requests == 1)
          send(SIGUSR1);
        else
          force_end();
      }

      void go_on()
      {
        if (requests > 0 && Clock::now() - sent > timeout)
          force_end();
      }

      void force_end()
      {
        send(is_forced ? SIGKILL : last_signal);
        is_forced = true;
      }

      void send(const int signal)
      {
        ::kill(process, signal);
        sent = Clock::now();
      }
    };
  } // namespace

  std::optional<WorkEnd> supervise(const int last_signal, const double timeout)
  {
    const sigset_t signals = watched_signals();
    sigset_t before;
    ::sigprocmask(SIG_BLOCK, &signals, &before);
    const pid_t parent = ::getpid();
    const pid_t child  = ::fork();
    if (child <= 0)
    {
      if (child == 0)
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (child == 0 && ::getppid() != parent)
        ::_exit(1);
      ::sigprocmask(SIG_SETMASK, &before, nullptr);
      return {};
    }
    Ending ending{ child, last_signal, std::chrono::duration<double>(timeout) };
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0)
      if (next_signal(signals) != 0)
        ending.ask();
      else
        ending.go_on();
    return WorkEnd{ WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                    ending.requests > 0 };
  }
} // namespace sprag
