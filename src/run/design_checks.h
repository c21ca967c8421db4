// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/design/design_problem.h"
#include "results/warning.h"
#include "run/in_memory.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Result of a check of a proposed lever by a more expensive model.
  struct ModelCheck
  {
    CheckModel check_model = CheckModel::beam;
    unsigned int round     = 1;
    bool in_time           = false;           ///< whether the drive was followed in time
    Proposal lever;                           ///< with what was expected of it
    DesignQuantities found;                   ///< NaN where the check model has none
    std::vector<DesignQuantities> at_corners; ///< `found` at each combination of Design/Tolerances
    DesignQuantities overshoot;               ///< of those that are larger in time: over the value of the slides
    std::string failure;                      ///< why there is no result; empty: there is one
    Warnings warnings;                        ///< of the lever in this model
    std::vector<std::string> changes;         ///< of the design's scene, "Section/Name=value", for what was computed last
    std::vector<std::string> corner;          ///< likewise, the combination of Design/Tolerances that is being computed
    double cpu_seconds = 0.;

    /// Returns the value of a demand's quantity that misses it most, within Design/Tolerances.
    double worst(const Demand &demand) const;

    /// Returns the largest violation of demands on quantities of the check model; minus infinity without such.
    double violation(const std::vector<Demand> &demands) const;

    bool passes(const std::vector<Demand> &demands) const
    {
      return failure.empty() && violation(demands) <= 0.;
    }
  };

  /// Returns the check, by the model of the last one, whose lever misses the demands least; the last one where none has a result.
  const ModelCheck &nearest_check(const std::vector<ModelCheck> &checks, const std::vector<Demand> &demands);

  /// Returns the last check of a lever; null without any.
  const ModelCheck *last_check(const std::vector<ModelCheck> &checks, const Proposal &lever);

  /// Computes levers of a design again by more expensive models. Forces come from steady slides at Design/Positions both ways,
  /// and one near x = 0 for the slopes; in time from the drive followed once. A lever that meets the demands there is checked
  /// over the whole stroke: where a slide grows faster than at these x, levers are looked at from then on.
  class DesignChecks
  {
  public:
    explicit DesignChecks(const Scene &scene)
        : design(scene)
    {
    }

    ModelCheck check(CheckModel by, const Proposal &lever, bool in_time);

    /// Returns the largest growth rate of all slides of a beam of this scene [1/s]; infinite where one of them is not unique or
    /// not found.
    double beam_growth(const Scene &scene);

  private:
    const Scene design;
    InMemory in_memory = run_in_memory();
    std::vector<double> growth_positions; ///< looked at for growth besides Design/Positions [mm]

    Scene make_scene(const ModelCheck &check) const;
    void compute(ModelCheck &check);
    void check_corner(const std::vector<std::string> &corner, ModelCheck &check);
    void check_table(ModelCheck &check) const;
    void check_slides(ModelCheck &check);
    void check_stroke(ModelCheck &check);
    void follow_in_time(ModelCheck &check);
  };
} // namespace sprag
