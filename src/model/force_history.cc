#include "model/force_history.h"

#include "model/state_archive.h"

#include <utility>

namespace sprag
{
  void ForceHistory::begin(const PortLoads &forces)
  {
    last            = forces;
    before          = {};
    duration_before = last_duration = 0.;
  }

  void ForceHistory::accept(const PortLoads &forces, const double duration)
  {
    std::swap(before, last);
    last            = forces;
    duration_before = last_duration;
    last_duration   = duration;
  }

  void ForceHistory::guess(const double duration, PortLoads &result) const
  {
    result = last;
    if (last_duration == 0.)
      return;
    const double ratio = (duration + last_duration) / (last_duration + duration_before);
    unsigned int j     = 0;
    for (unsigned int i = 0; i < last.ports.size(); ++i)
    {
      while (j < before.ports.size() && before.ports[j] < last.ports[i])
        ++j;
      if (j < before.ports.size() && before.ports[j] == last.ports[i])
        result.values[i] += ratio * (last.values[i] - before.values[j]);
    }
  }

  void visit(Archive &archive, ForceHistory &history)
  {
    archive(history.before, history.last, history.duration_before, history.last_duration);
  }
} // namespace sprag
