#include "base/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace sprag
{
  namespace
  {
    volatile std::sig_atomic_t asked = 0;

    extern "C" void ask(int)
    {
      asked = 1;
    }

    // An address sanitizer has handlers of its own, which tell more.
#ifndef __SANITIZE_ADDRESS__
    constexpr int crashes[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
#endif
  } // namespace

  void catch_interrupts()
  {
    for (const int signal : { SIGINT, SIGTERM, SIGUSR1 })
      std::signal(signal, ask);
    if (std::signal(SIGHUP, ask) == SIG_IGN)
      std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
#ifndef __SANITIZE_ADDRESS__
    for (const int signal : crashes)
      std::signal(signal, SIG_DFL);
#endif
  }

  bool interrupted()
  {
    return asked != 0;
  }

  void forget_signal_handlers()
  {
    for (const int signal : { SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGPIPE })
      std::signal(signal, SIG_DFL);
#ifndef __SANITIZE_ADDRESS__
    for (const int signal : crashes)
      std::signal(signal, SIG_DFL);
#endif
  }
} // namespace sprag
