#include "base/interrupt.h"

#include <csignal>

namespace sprag
{
  namespace
  {
    volatile std::sig_atomic_t asked = 0;

    extern "C" void ask(const int signal)
    {
      asked = 1;
      std::signal(signal, SIG_DFL);
    }
  } // namespace

  void catch_interrupts()
  {
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
    std::signal(SIGUSR1, ask);
  }

  bool interrupted()
  {
    return asked != 0;
  }
} // namespace sprag
