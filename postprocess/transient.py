# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of a transient run: what its first reversal excites, and where the energy goes."""

import numpy as np

from style import COLOURS, LINES, MILLIMETRE, TWO_COLUMNS, envelope, label, legend_on_top, look, panel_letter, plt

QUASI_STATIC = {"color": "black", "linestyle": (0, (4, 4)), "linewidth": 0.8, "zorder": 3}
OPEN = {"color": "0.85", "linewidth": 0, "zorder": 0}
WINDOW = 0.1  # s after a reversal
LEAD = 3e-3  # s shown before it
STORED = ("spring_energy", "elastic_energy", "contact_energy", "support_energy", "kinetic_energy")
DISSIPATED = ("friction_work", "damping_work", "algorithmic_work")


def is_transient(result):
    return result.type == "transient"


def parameter(result, section, name, otherwise):
    """Returns the parameter in the type of `otherwise`, which replaces a missing one."""
    try:
        return type(otherwise)(result.parameter(section, name))
    except (KeyError, ValueError):
        return otherwise


# Reversals


def turning_points(result):
    """Rows where the direction of motion changes."""
    x = result.table["x"]
    moved = np.flatnonzero(np.diff(x))
    direction = np.sign(np.diff(x)[moved])
    return moved[np.flatnonzero(np.diff(direction)) + 1]


def has_reversal(result):
    return len(turning_points(result)) > 0 and result.has("P_quasi_static")


def reversal_time(result):
    return result.table["time"][turning_points(result)[0]]


def reversal_end(result):
    """When the first reversal is over: smooth ones of the triangle take a time of their own."""
    smooth = parameter(result, "Drive", "Profile", "triangle") == "triangle"
    return reversal_time(result) + (parameter(result, "Drive", "Reversal duration", 0.0) / 2 if smooth else 0)


def rows_after(result):
    """The rows that tell what the first reversal excites."""
    time, turns = result.table["time"], turning_points(result)
    begin = reversal_end(result)
    end = begin + WINDOW
    if len(turns) > 1:
        end = min(end, time[turns[1]] - (begin - time[turns[0]]))
    known = np.isfinite(result.table["P"] - result.table["P_quasi_static"])
    return np.flatnonzero((time >= begin) & (time <= end) & known)


def zoom_end(result):
    """Time from the turning point to where little is left of the oscillation."""
    rows = rows_after(result)
    time = result.table["time"][rows] - reversal_time(result)
    if len(rows) == 0:
        return WINDOW
    off = np.abs(result.table["P"] - result.table["P_quasi_static"])[rows]
    last = time[np.flatnonzero(off >= 0.02 * off.max())[-1]]
    return min(max(1.2 * last, 0.02), time[-1])


def reversal(result):
    """P and Q over the whole run and at the first reversal, and the spectrum of P after it."""
    figure, panels = plt.subplots(2, 2, figsize=(TWO_COLUMNS, 120 * MILLIMETRE))
    (whole, normal), (spectrum, along) = panels
    turn = reversal_time(result)
    time = result.table["time"]
    near = (time >= turn - LEAD) & (time <= turn + zoom_end(result))
    everything = np.ones(len(time), dtype=bool)

    draw_forces(whole, result, time, everything, ("P", "Q", "Q_support"))
    draw_forces(normal, result, 1e3 * (time - turn), near, ("P",))
    draw_forces(along, result, 1e3 * (time - turn), near, ("Q", "Q_support"))
    draw_spectrum(spectrum, result)
    whole.set_xlabel(label(result.units, "time"))
    for axes in (normal, along):
        axes.set_xlabel("$t$ from the turning point [ms]")
        axes.set_xlim(-1e3 * LEAD, 1e3 * zoom_end(result))
    for axes, letter in zip((whole, normal, spectrum, along), "abcd"):
        panel_letter(axes, letter)
    handles, names = whole.get_legend_handles_labels()
    legend_on_top(figure, handles, names)
    return figure


def draw_forces(axes, result, time, rows, columns):
    """Forces with, dashed, what they were without inertia, and shaded where the contact is open."""
    table = result.table
    names = {"P": "$P$", "Q": "$Q$ at the contact", "Q_support": "$Q$ at the support"}
    for index, (column, name) in enumerate(names.items()):
        if column in columns and (column != "Q_support" or support_differs(result)):
            line = LINES[3] if column == "Q_support" else "-"
            axes.plot(time[rows], table[column][rows], label=name, color=COLOURS[index], linestyle=line, linewidth=0.9)
    for column in columns:
        if result.has(f"{column}_quasi_static"):
            axes.plot(time[rows], table[f"{column}_quasi_static"][rows], **QUASI_STATIC)
    axes.plot([], [], label="without inertia", **QUASI_STATIC)
    is_open = rows & (table["P"] == 0)
    if is_open.any():
        axes.fill_between(time[rows], 0, 1, where=is_open[rows], transform=axes.get_xaxis_transform(), **OPEN)
        axes.fill_between([], [], label="contact open", **OPEN)
    axes.axhline(0, color="black", linewidth=0.5)
    axes.set_ylabel(f"force [{result.units['P']}]" if len(columns) > 2 else label(result.units, columns[0]))


def support_differs(result):
    if not result.has("Q_support"):
        return False
    difference = np.abs(result.table["Q_support"] - result.table["Q"])
    return np.nanmax(difference) > 1e-6 * np.nanmax(np.abs(result.table["Q"]))


def draw_spectrum(axes, result):
    frequencies, amplitudes = spectrum_after(result)
    axes.set_xlabel("frequency [Hz]")
    axes.set_ylabel(f"amplitude of $P$ [{result.units['P']}]")
    if len(frequencies) == 0:
        axes.annotate("too short for a spectrum", (0.5, 0.5), xycoords="axes fraction", ha="center", va="center")
        axes.set(xticks=[], yticks=[])
        return
    dominant = dominant_frequency(result, frequencies, amplitudes)
    end = np.clip(6 * dominant, 1000, frequencies[-1]) if np.isfinite(dominant) else min(2000, frequencies[-1])
    shown = (frequencies > 0) & (frequencies <= end)
    axes.semilogy(frequencies[shown], amplitudes[shown], linewidth=0.9, color=COLOURS[0])
    highest = amplitudes[shown].max()
    axes.set_ylim(1e-4 * highest, 3 * highest)
    axes.set_xlim(0, end)
    if np.isfinite(dominant):
        axes.axvline(dominant, color=COLOURS[1], linewidth=0.9, linestyle=(0, (6, 1.5)), zorder=1)
        axes.annotate(
            f"{dominant:.4g} Hz", (dominant, 0.95), xycoords=axes.get_xaxis_transform(), xytext=(4, 0),
            textcoords="offset points", va="top", color=COLOURS[1],
        )  # fmt: skip


def spectrum_after(result):
    """Frequencies and amplitudes of P - P_quasi_static after the first reversal; both empty where too little is known."""
    rows = rows_after(result)
    if len(rows) < 8:
        return np.empty(0), np.empty(0)
    time = result.table["time"][rows]
    usual = np.median(np.diff(time))
    step = max(min(1e-5, usual), (time[-1] - time[0]) / 2**17)
    even = np.arange(time[0], time[-1], step)
    values = np.interp(even, time, (result.table["P"] - result.table["P_quasi_static"])[rows])
    values -= np.polyval(np.polyfit(even - even[0], values, 1), even - even[0])
    window = np.hanning(len(even))
    padded = 4 * 2 ** int(np.ceil(np.log2(len(even))))
    frequencies = np.fft.rfftfreq(padded, step)
    amplitudes = 2 * np.abs(np.fft.rfft(window * values, padded)) / window.sum()
    resolved = frequencies < 0.5 / usual
    return frequencies[resolved], amplitudes[resolved]


def dominant_frequency(result, frequencies, amplitudes):
    """Returns the frequency in the summary, or without one, as in an unfinished run, the spectrum's peak."""
    if "reversal_1_frequency" in result.summary:
        return float(result.summary["reversal_1_frequency"])
    searched = np.flatnonzero(frequencies > 2 / WINDOW)
    peak = searched[np.argmax(amplitudes[searched])]
    loud = amplitudes[peak] > 1e-3 * np.nanmax(result.table["P"][rows_after(result)])
    return frequencies[peak] if loud else np.nan


# Energies


def energy(result):
    """The drive's work and what became of it; every part by itself; what the ledger leaves open."""
    figure, panels = plt.subplots(2, 2, sharex=True, figsize=(TWO_COLUMNS, 120 * MILLIMETRE))
    (ledger, stored), (residual, works) = panels
    draw_ledger(ledger, result)
    draw_parts(stored, result, STORED, "stored, envelope")
    draw_parts(works, result, DISSIPATED, "dissipated")
    draw_residual(residual, result)
    for axes, letter in zip((ledger, stored, residual, works), "abcd"):
        panel_letter(axes, letter)
    for axes in panels[1]:
        axes.set_xlabel(label(result.units, "time"))
    figure.align_ylabels()
    return figure


def total(result, columns):
    return sum(np.nan_to_num(result.table[column]) for column in columns if column in result.table)


def draw_ledger(axes, result):
    """Stored and dissipated on top of one another: together the drive's work."""
    time, stored = result.table["time"], total(result, STORED)
    parts = {
        "friction": total(result, ("friction_work",)),
        "damping": total(result, ("damping_work", "algorithmic_work")),
        "stored": stored - stored[0],
    }
    axes.stackplot(time, list(parts.values()), labels=list(parts), colors=("#9EC9E2", "#F0B48A", "#8FD0BC"), linewidth=0)
    axes.plot(time, result.table["drive_work"], color="black", label="drive")
    axes.set_ylabel(f"work or energy [{result.units['drive_work']}]")
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper left")


def draw_parts(axes, result, columns, what):
    """On a logarithmic axis; what is nil throughout is left out."""
    peaks = []
    for index, column in enumerate(columns):
        if result.has(column) and np.nanmax(np.abs(result.table[column])) > 0:
            peaks.append(draw_envelope(axes, result, np.abs(result.table[column]), index, column.rsplit("_", 1)[0]))
    axes.set_ylabel(f"{what} [{result.units['drive_work']}]")
    if peaks:
        bottom, top = max(1e-3 * min(peaks), 1e-8 * max(peaks)), 2 * max(peaks)
        axes.set_ylim(bottom, top * (top / bottom) ** 0.25)  # room for the legend
        axes.legend(loc="upper center", ncol=3, handlelength=2.2, columnspacing=1)


def draw_envelope(axes, result, size, index, name=None):
    """Returns the peak."""
    time = result.table["time"]
    axes.semilogy(
        *envelope(time, np.where(size > 0, size, np.nan), time[0], time[-1], 200), label=name, **{**look(index), "linewidth": 1}
    )  # fmt: skip
    return np.nanmax(size)


def draw_residual(axes, result):
    works = [column for column in ("drive_work", *DISSIPATED) if result.has(column)]
    largest = max((np.nanmax(np.abs(result.table[column])) for column in works), default=0)
    highest = draw_envelope(axes, result, np.abs(result.table["energy_residual"]) / (largest or 1), 0)
    admitted = parameter(result, "Analysis", "Maximum energy residual", 0.0)
    if admitted > 0:
        axes.axhline(admitted, color=COLOURS[1], linestyle=(0, (6, 1.5)), linewidth=0.9)
        axes.annotate("admitted", (0.02, admitted), xycoords=axes.get_yaxis_transform(), xytext=(0, 2),
                      textcoords="offset points", color=COLOURS[1], fontsize=7)  # fmt: skip
    highest = max(admitted, highest)
    if highest > 0:
        axes.set_ylim(1e-16, 10 * highest)
    axes.set_ylabel("residual / largest work")
