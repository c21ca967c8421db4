// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/first_rank.h"
#include "fe/solid/refinement.h"

#include <memory>

namespace sprag
{
  /// How factors are kept.
  struct FactorStorage
  {
    bool single = false; ///< in single precision, half of the memory and of the time, whose solutions are refined
    std::string folder;  ///< for files with them; empty: in memory
  };

  /// Factors of the stiffness of a body or of a part of it, by which all ranks solve together.
  class BodyFactors
  {
  public:
    /// The first rank calls the others to `task` for each solve. What the source refers to must outlive this, and so must
    /// `number_in_part`, see assemble_stiffness(), and the calls.
    BodyFactors(const StiffnessSource &source, const std::vector<int> &number_in_part, SharedTask task, const BodyCalls &calls);

    /// Factorises, with connectors of the whole body, which the first rank gives. To be called by all ranks. Throws
    /// AnalysisError.
    void factorise(const std::vector<Connector> &connectors, const FactorStorage &storage);

    /// Prepares solves by some loads that move the body as the softest of its motions do, see Refinement. Returns false where
    /// factors of single precision do not serve. To be called by the first rank, as solve().
    bool prepare(const SparseColumns &loads);

    /// Solves with some columns, one after another, in place. Throws AnalysisError.
    void solve(std::vector<double> &columns) const;

    /// Returns the solutions for sparse columns, one after another, likewise.
    std::vector<double> solve(const SparseColumns &columns) const;

    /// Takes part in a solve of the first rank.
    void take_part() const;

    /// Gives the factors back. To be called by all ranks.
    void release();

    /// Number of displacements in a column.
    unsigned int size() const
    {
      return n;
    }

  private:
    std::vector<double> solve_some(const SparseColumns &columns) const;

    const StiffnessSource source;
    const std::vector<int> &number_in_part;
    const SharedTask task;
    const BodyCalls &call_others;
    unsigned int n = 0;
    std::unique_ptr<SharedFactors<float>> rough;    ///< either these
    std::unique_ptr<SharedFactors<double>> precise; ///< or those
    std::unique_ptr<Refinement> refinement;         ///< of rough ones, of the first rank
  };
} // namespace sprag
