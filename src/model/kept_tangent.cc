// SPDX-License-Identifier: GPL-3.0-only
#include "model/kept_tangent.h"

#include "model/state_archive.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  void visit(Archive &archive, std::shared_ptr<const KeptTangent> &kept)
  {
    bool there = kept != nullptr;
    archive(there);
    KeptTangent tangent;
    if (there && !archive.reads())
      tangent = *kept;
    archive(tangent.ports, tangent.matrix);
    if (archive.reads())
      kept = there ? std::make_shared<const KeptTangent>(std::move(tangent)) : nullptr;
  }

  bool KeptFactors::use(std::shared_ptr<const KeptTangent> kept, const PortCompliance &compliance, const StepWeights &weights)
  {
    constexpr std::size_t most = 3; // of the accepted step, and of those tried before and after it was halved
    const auto found           = std::find_if(known.begin(), known.end(),
                                              [&](const Factors &factors) {
                                      return factors.of == kept && factors.dt == weights.dt && factors.alpha_f == weights.alpha_f;
                                    });
    if (found != known.end())
    {
      std::rotate(found, found + 1, known.end());
      return true;
    }
    try
    {
      auto factors =
          kept->ports.empty() ? nullptr : std::make_unique<const ReducedFactors>(compliance, kept->ports, kept->matrix);
      if (known.size() >= most)
        known.erase(known.begin());
      known.push_back({ std::move(kept), weights.dt, weights.alpha_f, std::move(factors) });
      return true;
    }
    catch (const ExceptionBase &)
    {
      return false;
    }
  }

  const std::vector<unsigned int> &KeptFactors::ports() const
  {
    return known.back().of->ports;
  }

  Vector<double> KeptFactors::solve(const Vector<double> &difference) const
  {
    constexpr double left = 1e-2; // of the difference: corrections that follow are small anyway
    Vector<double> result(difference.size());
    if (!ports().empty())
      known.back().factors->add_solution(difference, left, result);
    return result;
  }

  double KeptFactors::movement_by(const Vector<double> &forces) const
  {
    return ports().empty() ? 0. : known.back().factors->movement_by(forces);
  }
} // namespace sprag
