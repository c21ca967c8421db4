# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of isolation systems: motion over time, loops of the damper, transmissibility of several dampers, spectra of the floor and
the table beside the criteria of precision machinery."""

import numpy as np

from style import COLOURS, LINES, MILLIMETRE, ONE_COLUMN, TWO_COLUMNS, look, panel_letter, plt, show_legend
from study import plain_logarithms, varied_parameters

FREQUENCY = "Isolation/Base frequency"
DAMPER = "Isolation/Damper"
# Root mean square of velocity in one-third octaves from 8 Hz on [mm/s], rising as 8 Hz / f below it (Gordon 1991; IEST-RP-CC012).
CRITERIA = {"VC-A": 50.8e-3, "VC-B": 25.4e-3, "VC-C": 12.7e-3, "VC-D": 6.35e-3, "VC-E": 3.18e-3}
BENT = ("VC-A", "VC-B")  # the others are level down to 1 Hz


def is_transmissibility_study(result):
    """A study of isolation systems over the frequency of the base."""
    if "isolation_base_frequency" not in result.table or "transmissibility_fundamental" not in result.table:
        return False
    return any(parameter.name == FREQUENCY for parameter in varied_parameters(result))


def isolation_pictures(result):
    pictures = {"motion": motion(result), "loop": loop(result)}
    if result.parameter("Isolation", "Base motion") in ("random", "record"):
        pictures["spectra"] = spectra(result)
    return pictures


def motion(result):
    """z and the base's displacement, and both accelerations over time."""
    figure, (ways, accelerations) = plt.subplots(2, 1, sharex=True, figsize=(TWO_COLUMNS, 100 * MILLIMETRE))
    time = result.table["time"]
    moves = bool(np.abs(result.table["base_acceleration"]).any())
    ways.plot(time, result.table["z"], label="table over base, $z$", **look(0))
    accelerations.plot(time, result.table["table_acceleration"] / 1000, label="table", **look(0))
    if moves:
        ways.plot(time, result.table["x_base"], label="base, $x_b$", zorder=1, **look(1))
        accelerations.plot(time, result.table["base_acceleration"] / 1000, label="base", zorder=1, **look(1))
    offset = result.summary.get("residual_offset", np.nan)
    if result.summary.get("rests_at_end") == 1:
        ways.axhline(offset, color="black", linewidth=0.6, linestyle=":", label=f"stays at {offset:.3g} mm")
    ways.set_ylabel("displacement [mm]")
    accelerations.set_ylabel("acceleration [m/s$^2$]")
    accelerations.set_xlabel("$t$ [s]")
    for axes, letter in zip((ways, accelerations), "ab"):
        axes.set_xlim(time[0], time[-1])
        panel_letter(axes, letter)
        show_legend(axes, loc="lower right", bbox_to_anchor=(1, 1), ncol=3, borderaxespad=0.2)
    return figure


def loop(result):
    """The damper's force over z; of a harmonic base the last periods strong."""
    figure, axes = plt.subplots(figsize=(ONE_COLUMN, 70 * MILLIMETRE))
    z, force, time = (result.table[name] for name in ("z", "damper_force", "time"))
    strong = np.ones(len(time), dtype=bool)
    periods = result.summary.get("periods_to_repeat", 0)
    if periods > 0 and result.summary.get("steady_state") == 1:
        strong = time >= time[-1] - periods / float(result.parameter("Isolation", "Base frequency")) - 1e-9
        axes.plot(z, force, color="0.75", linewidth=0.5, label="on the way there")
    axes.plot(z[strong], force[strong], label="steady state" if not strong.all() else None, **look(0))
    axes.axhline(0, color="black", linewidth=0.5)
    axes.axvline(0, color="black", linewidth=0.5)
    axes.set_xlabel("$z$ [mm]")
    axes.set_ylabel("force of the damper [N]")
    show_legend(axes)
    return figure


# Transmissibility


def transmissibility(result):
    """Peak and first harmonic of the table's acceleration over the base's [dB], and |z|, over the frequency in terms of the table's
    own on its spring alone: a line a damper."""
    varied = varied_parameters(result)
    frequency = next(parameter for parameter in varied if parameter.name == FREQUENCY)
    others = [parameter for parameter in varied if parameter is not frequency]
    settings = np.array([", ".join(p.said(p.texts[row]) for p in others) for row in range(len(frequency.numbers))])
    value = lambda name: result.table.get(f"isolation_{name.lower()}", float(result.parameter("Isolation", name)))
    own = np.sqrt(value("Stiffness") / value("Mass")) / (2 * np.pi) + 0 * frequency.numbers
    ratios = frequency.numbers / own
    figure, panels = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 82 * MILLIMETRE))
    contents = (
        ("transmissibility_peak", "largest acceleration over the base's [dB]"),
        ("transmissibility_fundamental", "first harmonic over the base's [dB]"),
        ("relative_amplitude", "largest $|z|$ [mm]"),
    )
    for axes, (name, said), letter in zip(panels, contents, "abc"):
        for index, setting in enumerate(dict.fromkeys(settings)):
            rows = np.flatnonzero(settings == setting)
            rows = rows[np.argsort(ratios[rows], kind="stable")]
            values = np.asarray(result.table[name][rows])
            shown = values if axes is panels[2] else 20 * np.log10(np.where(values > 0, values, np.nan))
            draw_settled(axes, ratios[rows], shown, result.table["steady_state"][rows] == 1, index)
        axes.set_xscale("log")
        axes.set_xlim(ratios.min(), ratios.max())
        axes.set_xlabel("$f/f_0$" + (f", $f_0$ = {own[0]:.3g} Hz" if np.ptp(own) == 0 else ""))
        axes.set_ylabel(said)
        plain_logarithms(axes.xaxis)
        panel_letter(axes, letter)
    panels[2].set_yscale("log")
    low, high = panels[2].get_ylim()
    panels[2].set_ylim(max(low, 1e-4 * high), high)
    for axes in panels[:2]:
        axes.axhline(0, color="black", linewidth=0.5)
    handles = [plt.Line2D([], [], color=COLOURS[i % len(COLOURS)], linestyle=LINES[i % len(LINES)]) for i in range(len(set(settings)))]
    names = list(dict.fromkeys(settings))
    if (result.table["steady_state"] == 0).any():
        handles.append(plt.Line2D([], [], color="black", linestyle="", marker="x", markersize=3))
        names.append("does not become steady")
    figure.suptitle("\n" * ((len(names) - 1) // 4) or " ", fontsize=7)  # keeps room
    figure.legend(handles, names, loc="upper center", ncol=4)
    return figure


def draw_settled(axes, x, y, settled, index):
    """A line; crosses where the run never became steady."""
    axes.plot(x, y, **look(index))
    axes.plot(x[~settled], y[~settled], linestyle="", marker="x", markersize=2, color=COLOURS[index % len(COLOURS)])


# Spectra


def third_octaves(time, acceleration):
    """Centres [Hz] and root mean square velocity [mm/s] of one-third octaves that the record resolves."""
    step = np.median(np.diff(time))
    even = np.arange(time[0], time[-1], step)
    values = np.interp(even, *without_repetition(time, acceleration))
    window = np.hanning(len(even))
    density = np.abs(np.fft.rfft((values - values.mean()) * window)) ** 2 * 2 * step / np.sum(window**2)
    frequency = np.fft.rfftfreq(len(even), step)
    centres = 10 ** (np.arange(-10, 31) / 10)
    found = []
    for centre in centres:
        band = (frequency >= centre * 10**-0.05) & (frequency < centre * 10**0.05)
        square = np.sum(density[band] / (2 * np.pi * frequency[band]) ** 2) * frequency[1]
        found.append(np.sqrt(square) if band.sum() >= 3 else np.nan)
    kept = np.isfinite(found) & (centres < 0.4 / step)
    return centres[kept], np.array(found)[kept]


def without_repetition(time, values):
    """One value an instant: turns have two rows."""
    kept = np.append(np.diff(time) > 0, True)
    return time[kept], values[kept]


def rows_that_shake(base_acceleration):
    """The rows up to the last in which the floor is accelerated: behind the end of a record it is not."""
    shaking = np.flatnonzero(base_acceleration)
    return slice(shaking[-1] + 1 if len(shaking) else None)


def spectra(result):
    """Velocity of floor and table in one-third octaves beside the VC curves, while the floor shakes."""
    figure, axes = plt.subplots(figsize=(ONE_COLUMN, 80 * MILLIMETRE))
    rows, drawn = rows_that_shake(result.table["base_acceleration"]), []
    for index, (name, said) in enumerate((("base_acceleration", "floor"), ("table_acceleration", "table"))):
        centres, velocity = third_octaves(result.table["time"][rows], result.table[name][rows])
        drawn.append(velocity)
        axes.loglog(centres, 1000 * velocity, label=said, drawstyle="steps-mid", **look(index))
    begin, end = frequency_band(result, centres)
    for name, limit in CRITERIA.items():
        frequency = np.array([begin, min(max(8, begin), end), end])
        level = 1000 * limit * (np.maximum(1, 8 / frequency) if name in BENT else np.ones(3))
        axes.plot(frequency, level, color="0.5", linewidth=0.6)
        axes.annotate(name, (end, level[-1]), xytext=(2, 0), textcoords="offset points", fontsize=6, va="center", annotation_clip=False)
    shown = 1000 * np.array(drawn)[:, (centres >= begin) & (centres <= end)]
    axes.set_ylim(0.5 * np.clip(np.nanmin(shown), 0.3, 3), 2 * max(np.nanmax(shown), 60))
    axes.set_xlim(begin, end)
    axes.set_xlabel("centre of the one-third octave [Hz]")
    axes.set_ylabel(r"velocity, rms [$\mu$m/s]")
    plain_logarithms(axes.xaxis)
    axes.legend()
    return figure


def frequency_band(result, centres):
    """Returns the lowest and the highest frequency of the floor's motion."""
    if result.parameter("Isolation", "Base motion") == "random":
        return (float(result.parameter("Isolation", f"{end} frequency")) for end in ("Lowest", "Highest"))
    return centres[0], centres[-1]
