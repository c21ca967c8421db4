// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // A table on a restoring spring and a damper, whose base moves: Fig. 2 of the paper. z is its displacement relative to the
  // base.

  /// Selects the damper between table and base: the levers of the scene, a mirrored pair for each sign of z (lever); F0 or c |z|
  /// against the motion (constant_friction, linear_friction); viscous, constant and linear friction together (Beucke); a friction
  /// lever pressed by the restoring spring (restoring_lever); viscous; Q over |z| from a file (loop); or none.
  SPRAG_ENUMERATION(DamperType, lever, constant_friction, linear_friction, Beucke, restoring_lever, viscous, loop, none)

  /// Selects the motion of the base: none, a sine, a sine of changing frequency (sweep), one pulse (shock), an acceleration of
  /// given spectrum (random) or one from a file (record).
  SPRAG_ENUMERATION(BaseMotionType, none, harmonic, sweep, shock, random, record)

  /// Selects how the frequency of a sweep changes with time.
  SPRAG_ENUMERATION(SweepForm, linear, logarithmic)

  /// Selects the shock: half a sine of acceleration, or a step of displacement along half a cosine.
  SPRAG_ENUMERATION(ShockForm, half_sine, step)

  /// Selects the spectrum of a random base motion.
  SPRAG_ENUMERATION(BaseSpectrum, kanai_tajimi, table)

  /// Says when a run ends: after its duration, or earlier once periods repeat.
  SPRAG_ENUMERATION(IsolationEnd, duration, steady_state)

  /// Holds a piecewise linear function by its samples.
  struct Samples
  {
    std::vector<double> at; ///< increasing
    std::vector<double> values;
  };

  /// Holds the loop of a damper: Q over |z| [N, mm] on the outward and the return stroke, both from 0 to the same largest |z|.
  struct DamperLoop
  {
    Samples out;
    Samples back;
  };

  /// Holds the section Isolation: table, damper, motion of the base and time integration.
  struct IsolationSettings
  {
    double mass         = 0.05; ///< of the table [t], > 0
    double stiffness    = 1.1;  ///< of the restoring spring [N/mm], > 0
    unsigned int levers = 2;    ///< for each sign of z

    DamperType damper          = DamperType::lever;
    double friction_force      = 5.;   ///< F0 [N], >= 0
    double friction_slope      = 0.18; ///< c [N/mm], >= 0
    double viscous_coefficient = 0.05; ///< [N s/mm], >= 0
    double lever_ratio         = 0.25; ///< of the restoring lever: spring's arm over that of the normal force, >= 0
    double friction_arm_ratio  = 0.;   ///< its arm of friction over that of the normal force, >= 0
    std::string loop_file;

    BaseMotionType base      = BaseMotionType::harmonic;
    double base_amplitude    = 10.; ///< [mm], > 0
    double base_frequency    = 1.;  ///< [Hz], > 0; of a sweep the first
    double final_frequency   = 5.;  ///< of a sweep [Hz], > 0
    SweepForm sweep          = SweepForm::logarithmic;
    ShockForm shock          = ShockForm::half_sine;
    BaseSpectrum spectrum    = BaseSpectrum::kanai_tajimi;
    double rms_acceleration  = 200.;      ///< of a Kanai-Tajimi ground [mm/s^2], > 0
    double ground_frequency  = 2.5;       ///< [Hz], > 0
    double ground_damping    = 0.6;       ///< of critical, > 0
    double lowest_frequency  = 0.2;       ///< of a random motion [Hz], > 0
    double highest_frequency = 20.;       ///< [Hz]
    std::optional<double> spectrum_lines; ///< whole; none: dense enough for the duration
    unsigned int seed = 1;
    std::string base_file;
    std::string unit; ///< of a recorded acceleration; empty: as the file says
    bool corrects_drift = false;

    double initial_displacement = 0.;  ///< z [mm]
    double initial_velocity     = 0.;  ///< z' [mm/s]
    double duration             = 20.; ///< [s], > 0
    IsolationEnd end            = IsolationEnd::duration;
    double periodic_tolerance   = 1e-8;  ///< of a steady state, over the amplitude, > 0
    double tolerance            = 1e-12; ///< of a step, over the amplitude, > 0
    std::optional<double> output_step;   ///< [s], > 0; none: see output_step()

    // read_isolation_tables() fills these from the files.
    DamperLoop loop;
    Samples base_table; ///< acceleration over time [mm/s^2, s], or its spectrum over frequency [(mm/s^2)^2/Hz, Hz]
  };
} // namespace sprag
