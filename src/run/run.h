#pragma once

#include "results/warning.h"
#include "scene/scene.h"

#include <string>

namespace sprag
{
  struct InMemory;
  class RunLog;

  struct RunOptions
  {
    std::string folder; ///< for results; made if it does not exist
    bool quiet             = false;
    bool is_first          = true;    ///< of several processes that run the scene together: it prints
    InMemory *in_memory    = nullptr; ///< for a run that writes no files, in place of a folder; else null
    unsigned int processes = 1;       ///< that run the scene together
    bool verbose           = false;   ///< prints all of a summary
    RunLog *log            = nullptr; ///< begins in the folder once that is made; null: none
    std::string chosen     = {};      ///< settings that follow from the scene's Accuracy, "Section/Name = VALUE; ..."
  };

  /// Throws AnalysisError where there are warnings and Analysis/Warnings = error; the message quotes the first of them.
  void check_warnings(const Scene &scene, const Warnings &warnings);

  /// Carries out the analysis of a scene that follows_formulas() and has no leaf spring. It throws what run() throws.
  void run_by_formulas(const Scene &scene, const RunOptions &options);

  /// Checks that the scene's mesh can serve, which read_scene() cannot, and throws InputError if not. Returns the warnings
  /// that follow from the scene alone.
  Warnings validate(const Scene &scene);

  /// Prints what of a scene follows from its Accuracy and what the run on `processes` processes with results in `folder` will
  /// cost.
  void print_expectations(const Scene &scene, unsigned int processes, const std::string &folder);

  /// Carries out the scene's analysis with its model and writes results into the folder. Throws InputError, before anything is
  /// written, for meshes and folders that cannot serve; AnalysisError when the analysis fails or deviates from the closed form by
  /// more than the scene admits, after every finished step was written, or has warnings with Analysis/Warnings = error. At the
  /// end the warnings are printed on the standard output, counted in its last line, unless quiet.
  void run(const Scene &scene, const RunOptions &options);
} // namespace sprag
