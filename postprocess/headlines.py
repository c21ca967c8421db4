# SPDX-License-Identifier: GPL-3.0-only
"""The numbers of a summary that say most, of each type of analysis: the first ones are drawn, ten stand in a report."""

import numpy as np

OF_DRIVE = ("slope_forward", "slope_backward", "largest_lever_stress", "largest_layer_stress")
HEADLINES = {
    "quasi-static": ("peak_P_forward", "peak_P_backward", "loop_area", "peak_Q_forward", "peak_Q_backward", "largest_pressure", *OF_DRIVE),
    "transient": (
        "peak_P_forward",
        "peak_P_backward",
        "loop_area",
        "reversal_1_frequency",
        "reversal_1_growth_rate",
        "reversal_1_open_share",
        "peak_Q_forward",
        "peak_Q_backward",
        "reversal_1_overshoot_P",
        "largest_lever_stress",
    ),
    "modal": tuple(f"frequency_{number}" for number in range(1, 11)),
    "stability": (
        "growth_rate",
        "frequency",
        "P",
        "margin",
        "critical_lever_depth_1",
        "critical_friction_factor_1",
        "critical_stability_position_1",
        "Q",
        "mu",
        "x",
    ),
    "sprag slip": (
        "measured_growth_rate",
        "measured_frequency",
        "cycle_amplitude_P",
        "cycle_open_share",
        "cycle_frequency",
        "cycle_stick_share",
        "coexistence_from",
        "coexistence_to",
        "P",
        "x",
    ),
    "contact law": ("stiffness", "exponent", "rms_error", "largest_error", "largest_P", "penalty_error"),
    "calibration": (
        "stiffness",
        "moment_of_inertia",
        "P_deviation",
        "Q_deviation",
        "bending_stiffness",
        "contact_stiffness",
        "contact_exponent",
        "free_frequency_1",
        "contact_frequency_1",
        "contact_frequency_1_deviation",
    ),
    "slope": ("critical_inclination",),
    "isolation": (
        "transmissibility_peak",
        "transmissibility_rms",
        "largest_displacement",
        "residual_offset",
        "stops",
        "dissipated_energy",
        "largest_acceleration",
        "rms_acceleration",
        "natural_frequency",
        "relative_amplitude",
    ),
    "map": ("unstable_forward", "unstable_backward", "jammed_forward", "jammed_backward", "not_judged_forward", "not_judged_backward"),
    "identification": ("mu", "k", "e", "th0", "l", "h", "noise_P", "noise_Q"),
    "design": (
        "geometry_cylinder_radius",
        "geometry_interface_offset",
        "geometry_pivot_distance",
        "rotational_spring_stiffness",
        "lever_length",
        "lever_depth",
        "damping_slope",
        "slope_ratio",
        "largest_force",
        "growth_rate",
    ),
    "study": ("runs", "completed", "failed", "refused"),
}


def headlines(result):
    """{entry: number} of a summary, those that are known."""
    names = HEADLINES.get(result.type, ())
    return {name: result.summary[name] for name in names if is_number(result.summary.get(name))}


def is_number(value):
    return isinstance(value, float) and bool(np.isfinite(value))
