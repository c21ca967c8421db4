// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/works.h"
#include "base/archive.h"
#include "results/columns.h"

#include <string>

namespace sprag
{
  /// The largest gap in the energy ledger of a run.
  struct LedgerReport
  {
    double residual     = 0.; ///< largest |residual| [N mm]
    double largest_work = 0.; ///< largest energy or work of the run [N mm]
    double time         = 0.; ///< end of the step in which the residual changed most [s]
    std::string term;         ///< that changed most in it

    double share() const
    {
      return largest_work > 0. ? residual / largest_work : 0.;
    }
  };

  void serialise(Archive &archive, LedgerReport &report);

  /// Adds up the works of accepted steps:
  ///   residual = work of the drive - change of the stored energies - friction - damping - algorithmic dissipation.
  class EnergyLedger
  {
  public:
    explicit EnergyLedger(const StoredEnergy &at_start = {})
        : start(at_start)
    {
    }

    void add(double time, const StoredEnergy &stored, const StepWork &work);

    /// Fills the columns of energies and works.
    void fill(Row &row) const;

    double residual() const;

    const LedgerReport &report() const
    {
      return found;
    }

  private:
    friend void serialise(Archive &archive, EnergyLedger &ledger);

    StoredEnergy start;
    StoredEnergy now = start;
    StepWork sum;
    double largest_change = 0.;
    LedgerReport found;
  };

  /// Counts the steps of a run in time and holds its energy ledger.
  struct TransientReport
  {
    unsigned int steps = 0;
    LedgerReport ledger;
  };
} // namespace sprag
