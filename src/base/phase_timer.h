// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <chrono>
#include <ctime>
#include <map>
#include <string>

namespace sprag
{
  /// Measures the wall and CPU time that the process spends in phases of a run.
  class PhaseTimer
  {
  public:
    /// Time of a phase, all its visits together [s].
    struct Phase
    {
      double wall = 0.;
      double cpu  = 0.;
    };

    /// A visit of a phase, from here to the end of the scope. Different phases may contain each other.
    class Scope
    {
    public:
      Scope(PhaseTimer &timer, const std::string &name)
          : phase(timer.all[name])
      {
      }
      ~Scope()
      {
        phase.wall += std::chrono::duration<double>(Clock::now() - wall).count();
        phase.cpu += cpu_seconds() - cpu;
      }
      Scope(const Scope &)            = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      using Clock = std::chrono::steady_clock;

      Phase &phase;
      const Clock::time_point wall = Clock::now();
      const double cpu             = cpu_seconds();
    };

    const std::map<std::string, Phase> &phases() const
    {
      return all;
    }

    /// Returns the CPU time of the process so far [s].
    static double cpu_seconds()
    {
      return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    }

  private:
    std::map<std::string, Phase> all;
  };

  /// Does `work` as a visit of the phase and returns what it returns.
  template <class Work>
  auto timed(PhaseTimer &timer, const std::string &phase, const Work &work)
  {
    const PhaseTimer::Scope scope(timer, phase);
    return work();
  }
} // namespace sprag
