#pragma once

#include "fe/compressed_rows.h"
#include "fe/effective_system.h"
#include "fe/lever_ports.h"
#include "model/linearisation.h"
#include "model/vibration.h"

#include <functional>

namespace sprag
{
  /// Products and solutions of a sparse structure, in vectors of all its coordinates.
  struct SparseOperator
  {
    using Product     = std::function<void(const dealii::Vector<double> &, dealii::Vector<double> &)>;
    unsigned int size = 0;
    Product mass;
    Product damping;
    Product stiffness;
    Product solve; ///< with the stiffness
    const LeverPorts &ports;
  };

  /// At least the `number` solutions exp(lambda t) of smallest |lambda|, under linear forces on the ports, by increasing
  /// |lambda|: the Krylov-Schur method of SLEPc for the inverse of the linearised problem, (q, q') -> (-K^-1 (C q + M q'), q),
  /// the forces included in K, C and M. Throws AnalysisError if they are not found, or an inverse
  /// iteration still changes one by 1e-4 of |lambda| over the lowest.
  std::vector<StructureMode> sparse_vibrations(const SparseOperator &structure, const PortPerturbation &forces,
                                               unsigned int number);
} // namespace sprag
