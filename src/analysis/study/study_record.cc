// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_record.h"

#include <array>

namespace sprag
{
  std::string outcome_name(const RunOutcome outcome)
  {
    static const std::array<std::string, 3> names = { { "completed", "failed", "refused" } };
    return names.at(static_cast<std::size_t>(outcome));
  }

  /// Attributes are left out: no study uses those of its runs.
  void serialise(Archive &archive, Entry &entry)
  {
    bool is_text = std::holds_alternative<std::string>(entry.value);
    archive(entry.name, entry.unit, entry.description, is_text);
    if (archive.reads() && is_text)
      entry.value = std::string();
    std::visit([&](auto &value) { archive(value); }, entry.value);
  }

  void serialise(Archive &archive, StudyRecord &record)
  {
    auto &[run, outcome, reason, cpu_time, cpu_spent, work, wall_time, peak_memory, warnings, found] = record;
    archive(run, outcome, reason, cpu_time, cpu_spent, work, wall_time, peak_memory, warnings, found.summary, found.curve);
  }
} // namespace sprag
