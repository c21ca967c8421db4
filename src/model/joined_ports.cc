#include "model/joined_ports.h"

#include <algorithm>

namespace sprag
{
  using dealii::Vector;

  Vector<double> ports_of_lever(const PortLayout &layout, const unsigned int lever, const Vector<double> &of_all)
  {
    if (of_all.size() == 0)
      return {};
    const unsigned int n = layout.of_a_lever();
    Vector<double> result(n + (layout.sprung ? 1 : 0));
    std::copy_n(of_all.begin() + layout.first(lever), n, result.begin());
    if (layout.sprung)
      result[n] = of_all[layout.support()];
    return result;
  }

  unsigned int joined_port(const PortLayout &layout, const unsigned int lever, const unsigned int port)
  {
    return port < layout.of_a_lever() ? layout.first(lever) + port : layout.support();
  }

  PortForces joined_forces(const PortLayout &layout, const std::vector<const PortForces *> &of_levers)
  {
    if (of_levers.size() == 1)
      return *of_levers.front();
    PortForces result;
    for (unsigned int lever = 0; lever < of_levers.size(); ++lever)
      for (const unsigned int port : of_levers[lever]->ports)
        result.ports.push_back(joined_port(layout, lever, port));
    std::sort(result.ports.begin(), result.ports.end());
    result.ports.erase(std::unique(result.ports.begin(), result.ports.end()), result.ports.end());
    const auto n = static_cast<unsigned int>(result.ports.size());
    result.values.reinit(n);
    result.tangent.reinit(n, n);
    for (unsigned int lever = 0; lever < of_levers.size(); ++lever)
    {
      const auto &of_lever = *of_levers[lever];
      std::vector<unsigned int> places;
      for (const unsigned int port : of_lever.ports)
        places.push_back(place_of(joined_port(layout, lever, port), result.ports));
      for (unsigned int a = 0; a < places.size(); ++a)
      {
        result.values[places[a]] += of_lever.values[a];
        for (unsigned int b = 0; b < places.size(); ++b)
          result.tangent(places[a], places[b]) += of_lever.tangent(a, b);
      }
    }
    return result;
  }
} // namespace sprag
