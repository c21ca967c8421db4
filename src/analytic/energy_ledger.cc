// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/energy_ledger.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    double dissipated(const StepWork &work)
    {
      return work.friction + work.damping + work.algorithmic;
    }

    /// Name of the term that changed most.
    std::string largest_term(const StoredEnergy &before, const StoredEnergy &after, const StepWork &work)
    {
      const std::pair<double, const char *> terms[] = { { after.kinetic - before.kinetic, "kinetic energy" },
                                                        { after.spring - before.spring, "energy of the rotational spring" },
                                                        { after.elastic - before.elastic, "elastic energy" },
                                                        { after.support - before.support, "energy of the support" },
                                                        { after.contact - before.contact, "energy of the contact" },
                                                        { work.drive, "work of the drive" },
                                                        { work.friction, "friction" },
                                                        { work.damping, "damping" },
                                                        { work.algorithmic, "algorithmic dissipation" } };
      return std::max_element(std::begin(terms), std::end(terms),
                              [](const auto &a, const auto &b) { return std::abs(a.first) < std::abs(b.first); })
          ->second;
    }
  } // namespace

  SPRAG_SERIALISE(LedgerReport, residual, largest_work, time, term)

  SPRAG_SERIALISE(EnergyLedger, start, now, sum, largest_change, found)

  double EnergyLedger::residual() const
  {
    return sum.drive - (now.total() - start.total()) - dissipated(sum);
  }

  void EnergyLedger::add(const double time, const StoredEnergy &stored, const StepWork &work)
  {
    const double before       = residual();
    const std::string largest = largest_term(now, stored, work);
    now                       = stored;
    sum += work;

    found.residual = std::max(found.residual, std::abs(residual()));
    found.largest_work =
        std::max({ found.largest_work, std::abs(sum.drive), sum.friction, std::abs(now.total() - start.total()) });
    if (const double change = std::abs(residual() - before); change > largest_change)
    {
      largest_change = change;
      found.time     = time;
      found.term     = largest;
    }
  }

  void EnergyLedger::fill(Row &row) const
  {
    row[Column::kinetic_energy]   = now.kinetic;
    row[Column::spring_energy]    = now.spring;
    row[Column::elastic_energy]   = now.elastic;
    row[Column::layer_energy]     = now.layer;
    row[Column::support_energy]   = now.support;
    row[Column::contact_energy]   = now.contact;
    row[Column::drive_work]       = sum.drive;
    row[Column::friction_work]    = sum.friction;
    row[Column::damping_work]     = sum.damping;
    row[Column::algorithmic_work] = sum.algorithmic;
    row[Column::energy_residual]  = residual();
    row[Column::creep]            = sum.creep;
  }
} // namespace sprag
