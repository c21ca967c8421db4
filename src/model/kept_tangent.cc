// SPDX-License-Identifier: GPL-3.0-only
#include "model/kept_tangent.h"

#include "model/state_archive.h"

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
    if (factors && of == kept && dt == weights.dt && alpha_f == weights.alpha_f)
      return true;
    factors.reset();
    of      = std::move(kept);
    dt      = weights.dt;
    alpha_f = weights.alpha_f;
    try
    {
      factors.emplace(compliance, of->ports, of->matrix);
      return true;
    }
    catch (const ExceptionBase &)
    {
      return false;
    }
  }

  const KeptTangent &KeptFactors::tangent() const
  {
    return *of;
  }

  Vector<double> KeptFactors::reaction(const Vector<double> &displacements) const
  {
    return factors->reaction(of->matrix, displacements);
  }
} // namespace sprag
