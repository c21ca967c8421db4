#!/usr/bin/python3
"""Makes Figs. 6 to 11 of the paper by running the scenes of params/ through sprag."""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import plot
from results import NotAResult, read_result

ROOT = Path(__file__).resolve().parent.parent
DPI = 110  # small enough to stand in a README


class RunFailed(Exception):
    """sprag did not finish a scene; the text says which and what it said."""


class Runner:
    """Runs scenes into folders of their own below a given one."""

    def __init__(self, sprag, folder):
        self.sprag = sprag
        self.folder = folder

    def __call__(self, scene, name=None, changes=None):
        """The result of params/<scene>.prm; changes as {"Section/Name": value}."""
        output = self.folder / (name or scene)
        command = [self.sprag, ROOT / "params" / f"{scene}.prm", "--output", output, "--quiet"]
        for parameter, value in (changes or {}).items():
            command += ["--set", f"{parameter}={value}"]
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        except OSError as error:
            raise RunFailed(f"{self.sprag}: {error.strerror}") from error
        if done.returncode != 0:
            raise RunFailed(f"{scene}.prm: sprag ended with {done.returncode}\n{done.stdout.strip()}")
        return read_result(output)


def friction_over_speed(run):
    """Fig. 6: a harmonic drive sweeps the sliding speed from 0 to 900 mm/s."""
    changes = {"Drive/Profile": "harmonic", "Drive/Speed": 950, "Drive/Cycles": 0.5, "Analysis/Step": 0.01}
    result = run("closed-form-a", "friction", changes=changes)
    speed = np.abs(result.table["v_rel"])
    order = np.argsort(speed)
    figure, axes = plt.subplots(figsize=(plot.ONE_COLUMN, 62 * plot.MILLIMETRE))
    axes.plot(speed[order], result.table["mu"][order], **plot.look(0))
    plot.set_labels(axes, result.units, "v_rel", "mu")
    axes.set_xlim(0, 900)
    axes.set_ylim(0, 1.2)
    return figure


def slopes_of_models(sweeps, coefficient):
    """Fig. 10: both models, marked where the experiment stands."""
    names = ("model A", "model B")
    figure = plot.slopes_over_coefficient(sweeps, names)
    for axes, direction in zip(figure.axes, ("forward", "backward")):
        for index, sweep in enumerate(sweeps):
            slope = slope_at(sweep, coefficient, direction)
            axes.plot(coefficient, slope, plot.MARKERS[index], color=plot.COLOURS[index], markersize=5)
    return figure


def slopes_of_geometries(geometries, sweeps, inclinations, coefficient):
    """Fig. 11: a curve for every e/R, models A and B marked."""
    figure = plot.slopes_over_inclination(geometries)
    for axes, direction in zip(figure.axes, ("forward", "backward")):
        for index, name in enumerate("AB"):
            slope = slope_at(sweeps[index], coefficient, direction)
            position = np.degrees(inclinations[index])
            axes.plot(position, slope, plot.MARKERS[index], color="black", markersize=4, label=f"model {name}", zorder=3)
        axes.legend(title="$e/R$", title_fontsize=7)
    return figure


def slope_at(sweep, coefficient, direction):
    return np.interp(coefficient, sweep.table["mu"], sweep.table[f"dimensionless_{direction}"])


def in_time(run):
    """Reversals of models A and B, sprag-slip, a harmonic drive, the contact law, and one scene at every fidelity."""
    thick = run("reversal-a")
    models = ("closed form", "rigid", "condensed", "finite element")
    ladder = [run("reversal-a", model, changes={"Analysis/Model": model, "Drive/Start": 55}) for model in models]
    ladder.insert(2, run("reversal-a", "beam", changes={"Drive/Start": 55}))
    return {
        "reversal-a": plot.reversal(thick),
        "energy-a": plot.energy(thick),
        "sprag-slip-a": plot.reversal(run("sprag-slip-a")),
        "reversal-b": plot.reversal(run("reversal-b")),
        "harmonic-a": plot.forces_over_x([run("harmonic-a")]),
        "contact-law-a": plot.contact_law(run("contact-law-a")),
        "ladder-a": plot.comparison(ladder),
    }


def figures(run):
    """{picture name: figure}, all of them."""
    model_a, model_b = run("model-a"), run("model-b")
    geometries = run("fig11")
    coefficient = float(geometries.parameter("Friction", "Coefficient"))
    sweeps = [run("fig10"), run("closed-form-b", "fig10-b", changes={"Analysis/Type": "slope"})]
    inclinations = [run(scene).table["theta"][0] for scene in ("closed-form-a", "closed-form-b")]
    return {
        "fig-06": friction_over_speed(run),
        "fig-07": plot.forces_over_time([model_a]),
        "fig-08": plot.forces_over_x([model_a]),
        "fig-09": plot.forces_over_x([model_b]),
        "fig-10": slopes_of_models(sweeps, coefficient),
        "fig-11": slopes_of_geometries(geometries, sweeps, inclinations, coefficient),
        "contact": plot.contact(model_a),
        **in_time(run),
    }


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sprag", type=Path, default=ROOT / "build" / "sprag", help="the program (build/sprag)")
    parser.add_argument("--output", type=Path, default=ROOT / "postprocess" / "pictures", help="postprocess/pictures")
    options = parser.parse_args(arguments)
    plot.use_print_style()
    try:
        with tempfile.TemporaryDirectory(prefix="sprag-figures-") as folder:
            plot.save(figures(Runner(options.sprag.resolve(), Path(folder))), options.output, dpi=DPI)
    except (RunFailed, NotAResult, OSError) as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
