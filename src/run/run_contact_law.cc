// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/contact_law.h"
#include "program/result_writer.h"
#include "results/page_tables.h"
#include "run/run.h"

#include <cmath>
#include <iomanip>
#include <iostream>

namespace sprag
{
  namespace
  {
    std::vector<Entry> contact_law_entries(const FittedContact &law)
    {
      return { { "stiffness", law.fit.stiffness },         { "exponent", law.fit.exponent },
               { "largest_error", law.fit.largest_error }, { "rms_error", law.fit.rms_error },
               { "penalty_error", law.penalty_error() },   { "largest_P", law.points.back().P } };
    }
  } // namespace

  void run_contact_law(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto law = indent(scene);
    ResultWriter writer(scene, options, page_columns("contact law", "P approach bending local P_fitted"));
    for (const auto &point : law.points)
      writer.append(std::vector<double>{ point.P, point.approach, point.bending, point.local(),
                                         law.fit.stiffness * std::pow(point.local(), law.fit.exponent) });
    writer.finish("completed", { contact_law_entries(law) }, warnings);
    if (options.quiet)
      return;
    std::cout << std::setprecision(6)
              << "\nLines for the parameter file:\n\nsubsection Contact\n  set Stiffness = " << law.fit.stiffness
              << "\n  set Exponent  = " << law.fit.exponent << "\nend\n";
  }
} // namespace sprag
