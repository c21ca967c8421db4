#include "model/mirrored_modes.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    const double half_root = std::sqrt(0.5);

    /// Takes over modes of one of the two motions; `side`: sign of the second lever in it.
    class Collector
    {
    public:
      explicit Collector(ModalData &of_pair)
          : pair(of_pair)
      {
      }

      void add(const ModalData &lever, const double side)
      {
        std::vector<unsigned int> taken;
        for (unsigned int i = 0; i < lever.stiffness.size(); ++i)
          if (i != lever.support || side > 0.)
            taken.push_back(i);
        for (unsigned int i = 0; i < taken.size(); ++i)
        {
          const unsigned int to = begin + i;
          pair.stiffness.push_back(lever.stiffness[taken[i]]);
          if (taken[i] == lever.support)
            pair.support = to;
          for (unsigned int j = 0; j < taken.size(); ++j)
            pair.damping(to, begin + j) = lever.damping(taken[i], taken[j]);
          for (unsigned int port = 0; port < lever.ports.of_a_lever(); ++port)
          {
            pair.shapes(pair.ports.first(0) + port, to) = half_root * lever.shapes(port, taken[i]);
            pair.shapes(pair.ports.first(1) + port, to) = side * half_root * lever.shapes(port, taken[i]);
          }
          if (pair.ports.sprung)
            pair.shapes(pair.ports.support(), to) = half_root * lever.shapes(lever.ports.support(), taken[i]);
        }
        begin += static_cast<unsigned int>(taken.size());
      }

    private:
      ModalData &pair;
      unsigned int begin = 0;
    };

    FullMatrix<double> face_compliance(const PortLayout &ports, const FullMatrix<double> &mirroring,
                                       const FullMatrix<double> &opposite)
    {
      if (mirroring.m() == 0)
        return FullMatrix<double>();
      const auto n = static_cast<unsigned int>(mirroring.m());
      FullMatrix<double> result(ports.rotation(1) + 1, ports.rotation(1) + 1);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double within  = 0.5 * (mirroring(i, j) + opposite(i, j));
          const double between = 0.5 * (mirroring(i, j) - opposite(i, j));
          for (unsigned int lever = 0; lever < 2; ++lever)
          {
            result(ports.first(lever) + i, ports.first(lever) + j)     = within;
            result(ports.first(lever) + i, ports.first(1 - lever) + j) = between;
          }
        }
      return result;
    }
  } // namespace

  ModalData mirrored_modes(const ModalData &mirroring, const ModalData &opposite)
  {
    ModalData pair;
    pair.ports            = mirroring.ports;
    pair.ports.levers     = 2;
    pair.relaxation       = mirroring.relaxation;
    pair.spring_stiffness = mirroring.spring_stiffness;
    const auto n =
        static_cast<unsigned int>(mirroring.stiffness.size() + opposite.stiffness.size()) - (pair.ports.sprung ? 1 : 0);
    pair.shapes.reinit(pair.ports.size(), n);
    pair.damping.reinit(n, n);
    Collector collector(pair);
    collector.add(mirroring, 1.);
    collector.add(opposite, -1.);
    pair.face_compliance = face_compliance(pair.ports, mirroring.face_compliance, opposite.face_compliance);
    return pair;
  }

  std::array<Motion, 2> mirrored_motions(const PortLayout &ports, const Motion &of_pair)
  {
    const auto &q              = of_pair.coordinates.position;
    const unsigned int n       = (q.size() - (ports.sprung ? 1 : 0)) / 2;
    const unsigned int n_faces = of_pair.face_force.size() == 0 ? 0 : ports.rotation() + 1;
    std::array<Motion, 2> result;
    for (unsigned int part = 0; part < 2; ++part)
    {
      const unsigned int begin = part == 0 ? 0 : q.size() - n;
      const double side        = part == 0 ? 1. : -1.;
      auto &motion             = result[part];
      motion.drive             = of_pair.drive;
      motion.coordinates.position.reinit(n);
      std::copy_n(q.begin() + begin, n, motion.coordinates.position.begin());
      motion.face_force.reinit(n_faces);
      for (unsigned int i = 0; i < n_faces; ++i)
        motion.face_force[i] =
            half_root * (of_pair.face_force[ports.first(0) + i] + side * of_pair.face_force[ports.first(1) + i]);
    }
    return result;
  }
} // namespace sprag
