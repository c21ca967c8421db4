// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/stored_jacobian.h"

#include "model/step/state_archive.h"

namespace sprag
{
  using namespace dealii;

  void serialise(Archive &archive, std::shared_ptr<const StoredJacobian> &kept)
  {
    bool is_stored = kept != nullptr;
    archive(is_stored);
    StoredJacobian tangent;
    if (is_stored && !archive.reads())
      tangent = *kept;
    archive(tangent.dofs, tangent.matrix);
    if (archive.reads())
      kept = is_stored ? std::make_shared<const StoredJacobian>(std::move(tangent)) : nullptr;
  }

  bool JacobianFactors::use(std::shared_ptr<const StoredJacobian> kept, const InterfaceCompliance &compliance,
                            const StepWeights &weights)
  {
    if (factors && stored == kept && dt == weights.dt && alpha_f == weights.alpha_f)
      return true;
    factors.reset();
    stored  = std::move(kept);
    dt      = weights.dt;
    alpha_f = weights.alpha_f;
    try
    {
      factors.emplace(compliance, stored->dofs, stored->matrix);
      return true;
    }
    catch (const ExceptionBase &)
    {
      return false;
    }
  }

  const StoredJacobian &JacobianFactors::tangent() const
  {
    return *stored;
  }

  Vector<double> JacobianFactors::reaction(const Vector<double> &displacements) const
  {
    return factors->reaction(stored->matrix, displacements);
  }
} // namespace sprag
