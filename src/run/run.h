// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/run_by_formulas.h"
#include "program/run_options.h"
#include <exception>
#include <string>

namespace sprag
{
  struct Scene;

  /// Throws InputError where an analysis gains nothing from as many processes of MPI: one that shares nothing, or a body in three
  /// dimensions that is too small for them.
  void require_useful_processes(const Scene &scene, unsigned int processes);

  /// Checks that the scene's mesh can serve, which read_scene() cannot, and throws InputError if not. Returns the warnings
  /// that follow from the scene alone.
  Warnings validate(const Scene &scene);

  /// Prints what of a scene follows from its Accuracy and what the run on `processes` processes with results in `folder` will
  /// cost.
  void print_expectations(const Scene &scene, unsigned int processes, const std::string &folder);

  /// Prints all parameters, whose values stand in a text in .prm form, as dealii::ParameterHandler does in XML, which its
  /// parameter_gui edits. A bound counts as admissible there. Throws InputError for integers that it does not read, as 1e1.
  void print_xml(const std::string &text);

  /// Carries out the scene's analysis with its model and writes results into the folder. Throws InputError, before anything is
  /// written, for meshes and folders that cannot serve; AnalysisError when the analysis fails or deviates from the closed form by
  /// more than the scene admits, after every finished step was written, or has warnings with Analysis/Warnings = error. At the
  /// end the warnings are printed on the standard output, counted in its last line, unless quiet.
  void run(const Scene &scene, const RunOptions &options);

  // run() calls one of these functions for each Analysis/Type. Each writes and prints its findings, adds the warnings that
  // follow from them and throws what run() throws. Results finished before an AnalysisError are written.

  /// Does what the Analysis/Type of a prepared scene says.
  void carry_out(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Follows the drive without inertia by finite elements, in three dimensions with the help of the other ranks, see
  /// help_first_rank().
  void run_quasi_static_scene(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Follows the table of an isolation system with levers of a model in time.
  void run_isolation_by_models(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Follows the drive in time with a model. Throws AnalysisError too where the energy ledger leaves more open than
  /// Analysis/Maximum energy residual.
  void run_transient_scene(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Fits the contact law of the reduced models to an indentation by finite elements.
  void run_contact_law(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Finds the vibrations of the slide at one x, undamped (modal) or checked (stability).
  void run_vibrations(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Checks the scene's slides both ways over a grid of two parameters and finds the boundaries between kinds. All ranks of MPI
  /// call it, and it throws on all of them. Until the map is complete its cells are in `map.journal`, from which the same scene
  /// goes on when started again; result.h5 is written at the end.
  void run_map(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Finds the lever that meets the scene's demands and is best by its aim, asks the check models, and writes the lever's scene.
  /// Throws AnalysisError too where no lever meets all demands, by the closed form or a check model.
  void run_design(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Runs the scene's Study/Type at other values of its parameters. All ranks of MPI call it, and it throws on all of them. Until
  /// the study is complete its runs are in `study.journal`, as those of a map; a run that fails or is refused is a row as any.
  void run_study(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Compares the growth of a perturbation with its eigenvalue, follows it to the vibration it leads to, and finds where a stable
  /// slide and a vibration live side by side. Throws AnalysisError too where there is no slide to perturb and where the energy
  /// ledger leaves more open than Analysis/Maximum energy residual.
  void run_sprag_slip(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Finds what the scene asks for from its measured stroke and writes the scene with it. Throws AnalysisError too where nothing
  /// can be found.
  void run_identification(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Makes parts that have the target k and J and finds the constants of the reduced models for them.
  void run_calibration(const Scene &scene, const RunOptions &options, Warnings &warnings);

  /// Returns a library's message in one line, without what it says about its sources.
  std::string error_message(const std::exception &error);
} // namespace sprag
