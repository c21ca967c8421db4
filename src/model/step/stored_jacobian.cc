// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/stored_jacobian.h"

#include "model/step/state_archive.h"

namespace sprag
{
  using namespace dealii;

  SPRAG_SERIALISE(StoredJacobian, dofs, matrix)

  bool JacobianFactors::use(std::shared_ptr<const StoredJacobian> jacobian, const InterfaceCompliance &compliance,
                            const StepWeights &weights)
  {
    if (factors && stored == jacobian && dt == weights.dt && alpha_f == weights.alpha_f)
      return true;
    factors.reset();
    stored  = std::move(jacobian);
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
} // namespace sprag
