// SPDX-License-Identifier: GPL-3.0-only
#include "report/console_summary.h"

#include "base/ranges.h"
#include "base/text.h"
#include "input/sections.h"
#include "report/summary_lines.h"
#include "results/page_tables.h"
#include "scene/analysis_settings.h"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <map>
#include <ostream>

namespace sprag
{
  namespace
  {
    std::string to_text(const std::vector<ErrorPart> &parts)
    {
      const auto text = [](const ErrorPart &part) { return part.name + ' ' + percent(part.value); };
      return boost::algorithm::join(mapped(parts, text), ", ");
    }

    std::string left_out_text(const ErrorEstimate &estimate)
    {
      return estimate.left_out.empty() ? "" : " The model leaves out: " + to_text(estimate.left_out) + '.';
    }

    constexpr int most_numbered = 12; ///< lines of reversals

    /// Returns the text behind the label of a line; empty where nothing is known.
    std::string to_text(const SummaryRow &row, const Entry &entry, const Entry *before)
    {
      if (const auto *const word = std::get_if<std::string>(&entry.value))
        return word->empty() ? "" : boost::replace_all_copy(row.text, "#", *word);
      const double value = std::get<double>(entry.value);
      const bool is_idle = value == 0. || (before != nullptr && before->value == entry.value);
      if (!std::isfinite(value) || (row.is_hidden_if_idle && is_idle))
        return {};
      const auto share = formatted("%.3g", 100. * std::abs(value)) + " %";
      return boost::replace_all_copy(boost::replace_all_copy(row.text, "#%", share), "#", with_unit(value, row.unit));
    }

    void print_errors(std::ostream &stream, const std::vector<ErrorEstimate> &errors)
    {
      std::string estimated;
      std::map<std::string, std::string> unknown; // quantities by the reason why they have no estimate
      const ErrorEstimate *worst = nullptr;
      for (const auto &error : errors)
      {
        auto &text = error.parts.empty() ? unknown[error.unknown] : estimated;
        text += (text.empty() ? "" : ", ") + error.quantity + (error.parts.empty() ? "" : ' ' + percent(total_error(error)));
        if (!error.parts.empty() && (worst == nullptr || total_error(error) > total_error(*worst)))
          worst = &error;
      }
      if (worst != nullptr)
        summary_line(stream, "errors, estimated", estimated);
      for (const auto &[reason, quantities] : unknown)
        summary_line(stream, "not estimated", quantities + ": " + reason);
      if (worst != nullptr)
        summary_line(stream, "to improve the worst", largest_part(*worst).remedy);
    }
  } // namespace

  std::vector<Entry> accuracy_entries(const std::vector<ErrorEstimate> &estimates)
  {
    std::vector<Entry> entries;
    for (const auto &estimate : estimates)
    {
      Entry whole{ estimate.quantity, total_error(estimate), "1",
                   estimate.parts.empty() ? "estimated error" : "estimated error relative to " + estimate.relative_to };
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
      stream << "  " << std::left << std::setw(22) << estimate.quantity << std::right;
      if (estimate.parts.empty())
        stream << estimate.unknown << '\n';
      else
        stream << std::setw(9) << percent(total_error(estimate)) << " of " << estimate.relative_to << ": "
               << to_text(estimate.parts) << ". " << largest_part(estimate).remedy << left_out_text(estimate) << '\n';
    }
  }

  Warnings target_warnings(const AccuracySettings &accuracy, const std::vector<ErrorEstimate> &estimates)
  {
    std::string missed, remedy;
    for (const auto &estimate : estimates)
    {
      const bool is_requested = contains(accuracy.quantities, estimate.quantity);
      const bool is_unknown   = estimate.parts.empty();
      if (!(accuracy.target > 0.) || !is_requested || !(is_unknown || total_error(estimate) > accuracy.target))
        continue;
      missed +=
          (missed.empty() ? "" : ", ") + estimate.quantity + ' ' + (is_unknown ? "unknown" : percent(total_error(estimate)));
      if (remedy.empty())
        remedy = is_unknown ? estimate.unknown : largest_part(estimate).remedy;
    }
    if (missed.empty())
      return {};
    auto warning   = make_warning("target_missed", { missed, percent(accuracy.target) });
    warning.remedy = remedy;
    return { warning };
  }

  Group answer_lines(const AnalysisType type, const std::vector<Entry> &summary, const std::vector<AnswerLine> &first)
  {
    auto labels = mapped(first, &AnswerLine::label), texts = mapped(first, &AnswerLine::text);
    int left_out        = 0;
    const Entry *before = nullptr;
    for (const auto &entry : summary)
    {
      const auto row  = summary_row(type, entry.name);
      const auto text = row && !row->label.empty() ? to_text(*row, entry, before) : "";
      before          = &entry;
      if (text.empty())
        continue;
      left_out = std::max(left_out, row->number - most_numbered);
      if (row->number > most_numbered)
        continue;
      const auto line = std::find(labels.begin(), labels.end(), row->label);
      if (line == labels.end())
      {
        labels.push_back(row->label);
        texts.push_back(text);
      }
      else
        texts[line - labels.begin()] += text.front() == '+' ? ' ' + text.substr(1) : ", " + text;
    }
    if (left_out > 0)
    {
      labels.emplace_back();
      texts.push_back("and " + std::to_string(left_out) + " more in /summary");
    }
    return { "answer", {}, { { "line", "labels of the lines that a run prints", labels }, { "text", "what they say", texts } } };
  }

  void print_console_summary(std::ostream &stream, const Group &answer, const std::vector<ErrorEstimate> &errors,
                             const double cpu_seconds, const double wall_seconds)
  {
    const auto &labels = answer.texts.front().values, &texts = answer.texts.back().values;
    for (std::size_t line = 0; line < labels.size(); ++line)
      summary_line(stream, labels[line], texts[line]);
    print_errors(stream, errors);
    const auto seconds = [](const double value) { return formatted(value < 99.5 ? "%.2g" : "%.0f", value) + " s of "; };
    summary_line(stream, "cost", seconds(cpu_seconds) + "CPU time, " + seconds(wall_seconds) + "wall time");
  }

  std::optional<SummaryRow> summary_row(const AnalysisType type, const std::string &entry)
  {
    const auto found = page_row("entry", to_word(type), entry);
    if (!found)
      return {};
    SummaryRow row{ found->cells.at("unit"), std::atoi(found->word.c_str()), {}, {} };
    auto printed = found->cells.at("printed");
    for (; !printed.empty() && (printed.front() == '!' || printed.front() == '?'); printed.erase(0, 1))
      (printed.front() == '!' ? row.is_main : row.is_hidden_if_idle) = true;
    if (const auto colon = printed.find(": "); colon != std::string::npos)
    {
      row.label = printed.substr(0, colon);
      row.text  = printed.substr(colon + 2);
    }
    return row;
  }

  void describe_entries(const std::string &kind, const std::string &type, std::vector<Entry> &entries)
  {
    for (auto &entry : entries)
    {
      const auto row = page_row(kind, type, entry.name);
      if (kind == "entry" && (!row || !entry.description.empty() || row->cells.at("printed").rfind('!', 0) == 0))
        entry.attributes.emplace_back("headline", "yes");
      if (row)
      {
        entry.unit        = entry.unit.empty() ? row->cells.at("unit") : entry.unit;
        entry.description = row->cells.at("meaning") + (entry.description.empty() ? "" : "; " + entry.description);
      }
    }
  }
} // namespace sprag
