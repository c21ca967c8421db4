// SPDX-License-Identifier: GPL-3.0-only
#include "report/accuracy_report.h"

#include "report/percent.h"
#include "scene/analysis_settings.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace sprag
{
  namespace
  {
    std::string text_of(const std::vector<ErrorPart> &parts)
    {
      std::string text;
      for (const auto &part : parts)
        text += (text.empty() ? "" : ", ") + part.name + ' ' + percent(part.value);
      return text;
    }

    std::string left_out_text(const ErrorEstimate &estimate)
    {
      return estimate.left_out.empty() ? "" : " The model leaves out: " + text_of(estimate.left_out) + '.';
    }
  } // namespace

  std::vector<Entry> accuracy_entries(const std::vector<ErrorEstimate> &estimates)
  {
    std::vector<Entry> entries;
    for (const auto &estimate : estimates)
    {
      Entry whole{ estimate.quantity, total_error(estimate), "1", "estimated error relative to " + estimate.relative_to };
      if (estimate.parts.empty())
        whole.attributes = { { "unknown", estimate.unknown } };
      else
        whole.attributes = { { "largest_part", largest_part(estimate).name }, { "remedy", largest_part(estimate).remedy } };
      entries.push_back(whole);
      for (const auto &part : estimate.parts)
        entries.push_back({ estimate.quantity + '_' + part.name, part.value, "1",
                            "part of the error of " + estimate.quantity + ": " + part.remedy });
      for (const auto &part : estimate.left_out)
        entries.push_back({ estimate.quantity + '_' + part.name, part.value, "1",
                            "left out of " + estimate.quantity + " by the model, not in its error: " + part.remedy });
    }
    return entries;
  }

  void print_accuracy(std::ostream &stream, const std::vector<ErrorEstimate> &estimates)
  {
    if (!estimates.empty())
      stream << "Accuracy, estimated:\n";
    for (const auto &estimate : estimates)
    {
      stream << "  " << std::left << std::setw(18) << estimate.quantity << std::right;
      if (estimate.parts.empty())
        stream << estimate.unknown << '\n';
      else
        stream << std::setw(9) << percent(total_error(estimate)) << " of " << estimate.relative_to << ": "
               << text_of(estimate.parts) << ". " << largest_part(estimate).remedy << left_out_text(estimate) << '\n';
    }
  }

  Warnings target_warnings(const AccuracySettings &asked, const std::vector<ErrorEstimate> &estimates)
  {
    std::string missed, remedy;
    for (const auto &estimate : estimates)
    {
      const bool is_asked =
          std::find(asked.quantities.begin(), asked.quantities.end(), estimate.quantity) != asked.quantities.end();
      if (!(asked.target > 0.) || !is_asked || estimate.parts.empty() || !(total_error(estimate) > asked.target))
        continue;
      missed += (missed.empty() ? "" : ", ") + estimate.quantity + ' ' + percent(total_error(estimate));
      remedy = remedy.empty() ? largest_part(estimate).remedy : remedy;
    }
    if (missed.empty())
      return {};
    return { { "target_missed", "The run tells errors of " + missed + ", where " + percent(asked.target) + " was asked for.",
               "These quantities are less accurate than asked for.", remedy } };
  }
} // namespace sprag
