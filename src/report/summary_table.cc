// SPDX-License-Identifier: GPL-3.0-only
#include "report/summary_table.h"

#include "input/sections.h"
#include "results/page_tables.h"

#include <cstdlib>

namespace sprag
{
  namespace
  {
    void describe(const std::string &kind, const std::string &type, std::vector<Entry> &entries)
    {
      for (auto &entry : entries)
      {
        const auto row = page_row(kind, type, entry.name);
        if (kind == "entry" && (!row || !entry.description.empty() || row->printed.rfind('!', 0) == 0))
          entry.attributes.emplace_back("headline", "yes");
        if (row)
        {
          entry.unit        = entry.unit.empty() ? row->unit : entry.unit;
          entry.description = row->meaning + (entry.description.empty() ? "" : "; " + entry.description);
        }
      }
    }
  } // namespace

  std::optional<SummaryRow> summary_row(const AnalysisType type, const std::string &entry)
  {
    const auto found = page_row("entry", to_word(type), entry);
    if (!found)
      return {};
    SummaryRow row{ found->unit, std::atoi(found->word.c_str()), {}, {} };
    auto printed = found->printed;
    for (; !printed.empty() && (printed.front() == '!' || printed.front() == '?'); printed.erase(0, 1))
      (printed.front() == '!' ? row.is_main : row.is_hidden_if_idle) = true;
    if (const auto colon = printed.find(": "); colon != std::string::npos)
    {
      row.label = printed.substr(0, colon);
      row.text  = printed.substr(colon + 2);
    }
    return row;
  }

  void describe_summary(const AnalysisType type, std::vector<Entry> &entries)
  {
    describe("entry", to_word(type), entries);
  }

  void describe_facts(std::vector<Entry> &entries)
  {
    describe("fact", "", entries);
  }
} // namespace sprag
