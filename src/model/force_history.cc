#include "model/force_history.h"

#include "model/state_archive.h"

#include <algorithm>
#include <array>

namespace sprag
{
  namespace
  {
    constexpr std::size_t most = 3; // a cubic follows the noise of points that come and go

    using Values = std::array<double, most>;

    /// Of that through the first n values at different places, by Lagrange.
    double value_of_polynomial(const Values &at, const Values &values, const std::size_t n, const double place)
    {
      double result = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        double share = values[i];
        for (std::size_t j = 0; j < n; ++j)
          if (j != i)
            share *= (place - at[j]) / (at[i] - at[j]);
        result += share;
      }
      return result;
    }
  } // namespace

  void ForceHistory::begin(const PortLoads &forces)
  {
    time   = 0.;
    places = { { forces, time } };
  }

  void ForceHistory::accept(const PortLoads &forces, const double duration)
  {
    accept_at(forces, time + 0.5 * duration);
    time += duration;
  }

  void ForceHistory::guess(const double duration, PortLoads &result) const
  {
    result = guess_at(time + 0.5 * duration);
  }

  void ForceHistory::accept_at(const PortLoads &forces, const double place, const bool goes_on)
  {
    if (!goes_on)
      places.clear();
    if (places.size() == most)
      places.pop_back();
    places.insert(places.begin(), { forces, place });
  }

  PortLoads ForceHistory::guess_at(const double place) const
  {
    PortLoads result = places.front().forces;
    for (unsigned int i = 0; i < result.ports.size(); ++i)
    {
      Values values, at;
      std::size_t n = 0;
      for (const auto &[forces, of_place] : places)
      {
        const auto port = std::lower_bound(forces.ports.begin(), forces.ports.end(), result.ports[i]);
        if (port == forces.ports.end() || *port != result.ports[i])
          break;
        values[n] = forces.values[static_cast<unsigned int>(port - forces.ports.begin())];
        at[n++]   = of_place;
      }
      result.values[i] = value_of_polynomial(at, values, n, place);
    }
    return result;
  }

  void visit(Archive &archive, ForcesAtPlace &forces)
  {
    archive(forces.forces, forces.place);
  }

  void visit(Archive &archive, ForceHistory &history)
  {
    archive(history.places, history.time);
  }
} // namespace sprag
