"""Pictures of a vibration analysis: eigenvalues, mode shapes, what feeds the growth and what each ingredient does."""

import numpy as np

from style import COLOURS, MILLIMETRE, TWO_COLUMNS, panel_letter, plt

KINDS = ("stable", "flutter", "divergence")
FEEDS = (
    ("friction_rotation", "friction on rotation"),
    ("friction_bending", "friction on bending"),
    ("friction_support", "friction on support"),
    ("friction_speed", "friction, velocities"),
    ("contact_damping", "contact damping"),
    ("structure_damping", "structure damping"),
)


def vibration_pictures(result):
    modes = result.groups["modes"]
    pictures = {}
    if len(modes["frequency"]) > 0:
        pictures["modes"] = mode_shapes(modes)
    if "growth_rate" in result.summary:
        pictures["stability"] = stability(result)
    return pictures


def mode_shapes(modes, most=6):
    """Deflection of the lever's face over a cycle: eight phases, the first one drawn strongly."""
    chosen = shown_modes(modes, most)
    rows = (len(chosen) + 1) // 2
    figure, panels = plt.subplots(rows, 2, sharex=True, figsize=(TWO_COLUMNS, (12 + 28 * rows) * MILLIMETRE), squeeze=False)
    for axes, mode in zip(panels.flat, chosen):
        draw_shape(axes, modes, mode)
    for axes in panels.flat[len(chosen) :]:
        axes.set_axis_off()
    for axes in panels[-1]:
        axes.set_xlabel(r"lever coordinate $\xi$ [mm]")
    figure.supylabel("deflection / largest, rotation included", fontsize=8)
    return figure


def shown_modes(modes, most):
    """The lowest ones, those that grow among them."""
    growing = list(np.flatnonzero(modes["kind"] > 0))
    lowest = [i for i in range(len(modes["frequency"])) if i not in growing]
    return sorted((growing + lowest)[:most])


def draw_shape(axes, modes, mode):
    xi = modes["xi"]
    order = np.argsort(xi)
    complex_part = lambda name: modes[f"{name}_real"][mode] + 1j * modes[f"{name}_imaginary"][mode]
    shape = complex_part("across") + xi * complex_part("rotation")
    if len(xi) == 1:  # a rigid lever has no shape but its rotation
        xi, order = np.array((0.0, 200.0)), np.array((0, 1))
        shape = xi * complex_part("rotation")
    shape = shape / shape[np.abs(shape).argmax()]
    colour = COLOURS[1] if modes["kind"][mode] > 0 else COLOURS[0]
    axes.axhline(0, color="black", linewidth=0.5)
    for phase in np.arange(8) * np.pi / 4:
        strong = phase == 0
        axes.plot(xi[order], (shape * np.exp(1j * phase)).real[order], color=colour, linewidth=1.4 if strong else 0.5)
    axes.set_ylim(-1.1, 1.1)
    axes.set_title(mode_name(modes, mode), fontsize=8, loc="left")


def mode_name(modes, mode):
    kind = KINDS[int(modes["kind"][mode])]
    growth = modes["growth_rate"][mode]
    rate = f", {growth:+.3g} 1/s" if abs(growth) > 1e-9 * (1 + modes["frequency"][mode]) else ""
    return f"{modes['frequency'][mode]:.4g} Hz{rate}" + (f", {kind}" if kind != "stable" else "")


def stability(result):
    """(a) Eigenvalues, (b) what feeds each mode, (c) the slide with one ingredient left out."""
    figure, panels = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 75 * MILLIMETRE), gridspec_kw={"width_ratios": (1, 1.25, 1)})
    modes = result.groups["modes"]
    draw_eigenvalues(panels[0], modes)
    draw_feeds(panels[1], modes)
    draw_roles(panels[2], result.summary)
    for axes, letter in zip(panels, "abc"):
        panel_letter(axes, letter)
    return figure


def draw_eigenvalues(axes, modes):
    for kind, (name, marker) in enumerate(zip(KINDS, "osD")):
        of_kind = modes["kind"] == kind
        if of_kind.any():
            axes.plot(modes["growth_rate"][of_kind], modes["frequency"][of_kind], marker, color=COLOURS[kind], markersize=4, label=name)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.set_yscale("log")
    axes.set_xlabel(r"growth rate $\mathrm{Re}\,\lambda$ [1/s]")
    axes.set_ylabel(r"frequency $\mathrm{Im}\,\lambda/2\pi$ [Hz]")
    axes.legend(loc="lower left")


def draw_feeds(axes, modes, most=4):
    chosen = shown_modes(modes, most)
    height = 0.8 / len(FEEDS)
    used = [feed for feed in FEEDS if np.abs(modes[f"growth_by_{feed[0]}"][chosen]).max() > 1e-6]
    for index, (name, text) in enumerate(used):
        places = np.arange(len(chosen)) + (index - (len(used) - 1) / 2) * height
        axes.barh(places, modes[f"growth_by_{name}"][chosen], height, color=COLOURS[index], label=text)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.set_yticks(range(len(chosen)), [f"{modes['frequency'][i]:.0f} Hz\n{modes['growth_rate'][i]:+.3g}" for i in chosen])
    axes.set_ylim(-0.6, len(chosen) - 0.4 + 0.28 * len(used))
    axes.set_xlabel("part of the growth rate [1/s]")
    axes.legend(loc="upper left", fontsize=6)
    axes.grid(axis="y", visible=False)


def draw_roles(axes, summary):
    names = [name[: -len("_growth_rate")] for name in summary if name.startswith("without_") and name.endswith("_growth_rate")]
    rates = [summary["growth_rate"]] + [summary[f"{name}_growth_rate"] for name in names]
    verdicts = [summary["verdict"]] + [summary[f"{name}_verdict"] for name in names]
    texts = ["as it is"] + [name.replace("_", " ").replace("friction derivative", "$\\mu'(v)$") for name in names]
    for place, (rate, verdict) in enumerate(zip(rates, verdicts)):
        colour = COLOURS[0] if verdict == "stable" else COLOURS[1]
        if np.isfinite(rate):
            axes.barh(place, rate, 0.6, color=colour)
        else:
            axes.text(0, place, f" {verdict}", va="center", color=colour, fontsize=7)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.set_yticks(range(len(texts)), texts)
    axes.set_ylim(len(texts) - 0.4, -0.6)
    axes.set_xlabel("largest growth rate [1/s]")
    axes.grid(axis="y", visible=False)
