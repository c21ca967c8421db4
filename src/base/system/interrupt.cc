// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/interrupt.h"

#include "base/errors.h"

#include <csignal>
#include <initializer_list>

namespace sprag
{
  namespace
  {
    volatile std::sig_atomic_t requested = 0;

    extern "C" void request_end(int)
    {
      requested = 1;
    }

    /// Restores the default handlers, except under an address sanitizer, whose own print more.
    void restore_crash_signals()
    {
#ifndef __SANITIZE_ADDRESS__
      for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
        std::signal(signal, SIG_DFL);
#endif
    }
  } // namespace

  void catch_interrupts()
  {
    for (const int signal : { SIGINT, SIGTERM, SIGUSR1 })
      std::signal(signal, request_end);
    if (std::signal(SIGHUP, request_end) == SIG_IGN)
      std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    restore_crash_signals();
  }

  bool interrupted()
  {
    return requested != 0;
  }

  void end_if_interrupted()
  {
    if (interrupted())
      throw AnalysisError(interruption);
  }

  void forget_signal_handlers()
  {
    for (const int signal : { SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGPIPE })
      std::signal(signal, SIG_DFL);
    restore_crash_signals();
  }
} // namespace sprag
