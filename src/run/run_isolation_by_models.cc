#include "analysis/isolation/lever_table.h"
#include "levers/dynamics.h"
#include "run/analyses.h"
#include "run/in_memory.h"
#include "run/isolation_report.h"
#include "run/transient_settings.h"

namespace sprag
{
  void run_isolation_by_models(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    require_folder(options);
    const auto maker   = dynamics_maker(options);
    const auto outward = maker->make(scene);
    const auto inward  = maker->make(scene);
    record_isolation(
        scene, options, maker->timer(), warnings,
        [&](IsolationFindings &found, const RecordTable &record) -> std::vector<Entry>
        {
          LeverTable table(scene, outward.model(), inward.model(), transient_settings(scene, {}));
          run_isolation(scene, table, found, record);
          return { { "steps", static_cast<double>(table.number_of_steps()), "1", "accepted" },
                   { "iterations_a_step", table.iterations_a_step(), "1", "of Newton's method for the end of the table's way" } };
        });
  }
} // namespace sprag
