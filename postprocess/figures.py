#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Makes the pictures of postprocess/pictures, Figs. 6 to 11 of the paper among them, by running the scenes of params/."""

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

import oscillator
import plot
from apparatus import make_device
from arguments import add_output, add_program, make_parser
from comparison import comparison
from contact import contact
from device import drawing
from fields import fields
from forces import forces_over_time, forces_over_x
from sprag.program import ROOT, RunFailed, run_scene
from sprag.results import NotAResult, read_result
from slope import contact_law, slopes_over_coefficient, slopes_over_inclination
from style import COLOURS, MARKERS, MILLIMETRE, ONE_COLUMN, look, plt, set_labels, use_print_style
from transient import energy, reversal

PICTURES = ROOT / "postprocess" / "pictures"


class Runner:
    """Runs scenes into folders of their own below a given one, each once."""

    def __init__(self, sprag, folder):
        self.sprag = sprag
        self.folder = folder

    def __call__(self, scene, name=None, changes=None):
        """The result of params/<scene>.prm; changes as {"Section/Name": value}, under another name then."""
        output = self.folder / (name or scene)
        if not output.exists():
            print(f"{output.name} ...", file=sys.stderr)
            run_scene(self.sprag, ROOT / "params" / f"{scene}.prm", output, changes or {})
        return read_result(output)


def friction_over_speed(run):
    """Fig. 6: a harmonic drive sweeps the sliding speed from 0 to 900 mm/s."""
    changes = {"Drive/Profile": "harmonic", "Drive/Speed": 950, "Drive/Cycles": 0.5, "Analysis/Step": 0.01}
    result = run("closed-form-a", "friction", changes=changes)
    speed = np.abs(result.table["v_rel"])
    order = np.argsort(speed)
    figure, axes = plt.subplots(figsize=(ONE_COLUMN, 62 * MILLIMETRE))
    axes.plot(speed[order], result.table["mu"][order], **look(0))
    set_labels(axes, result.units, "v_rel", "mu")
    axes.set_xlim(0, 900)
    axes.set_ylim(0, 1.2)
    return figure


def sweep_models(run):
    return [run("fig10"), run("closed-form-b", "fig10-b", changes={"Analysis/Type": "slope"})]


def draw_model_slopes(run):
    """Fig. 10: both models, marked where the experiment stands."""
    sweeps = sweep_models(run)
    coefficient = experiment_coefficient(run)
    names = ("model A", "model B")
    figure = slopes_over_coefficient(sweeps, names)
    for axes, direction in zip(figure.axes, ("forward", "backward")):
        for index, sweep in enumerate(sweeps):
            slope = slope_at(sweep, coefficient, direction)
            axes.plot(coefficient, slope, MARKERS[index], color=COLOURS[index], markersize=5)
    return figure


def draw_geometry_slopes(run):
    """Fig. 11: a curve for every e/R, models A and B marked."""
    sweeps = sweep_models(run)
    coefficient = experiment_coefficient(run)
    inclinations = [run(scene).table["theta"][0] for scene in ("closed-form-a", "closed-form-b")]
    figure = slopes_over_inclination(run("fig11"))
    for axes, direction in zip(figure.axes, ("forward", "backward")):
        for index, name in enumerate("AB"):
            slope = slope_at(sweeps[index], coefficient, direction)
            position = np.degrees(inclinations[index])
            axes.plot(position, slope, MARKERS[index], color="black", markersize=4, label=f"model {name}", zorder=3)
        axes.legend(title="$e/R$", title_fontsize=7)
    return figure


def experiment_coefficient(run):
    return float(run("fig11").parameter("Friction", "Coefficient"))


def slope_at(sweep, coefficient, direction):
    return np.interp(coefficient, sweep.table["mu"], sweep.table[f"dimensionless_{direction}"])


def ladder(run):
    """One scene at every fidelity."""
    models = ("closed form", "rigid", "beam", "condensed", "finite element")
    start = {"Drive/Start": 55}
    return comparison([run("reversal-a", model, changes={"Analysis/Model": model, **start}) for model in models])


def depths(run):
    """Reversals of levers of many depths."""
    return comparison([run("reversal-a", f"depth {depth}", changes={"Lever/Depth": depth}) for depth in (6, 8, 12, 14, 16, 20, 25)])


def device(scene, run):
    return drawing(make_device(ROOT / "params" / f"{scene}.prm", run.sprag, None))


def drawn(scene, picture):
    """One of the pictures that plot.py draws of a scene."""
    return lambda run: plot.draw([run(scene)])[picture]


MAPS = (
    "map-position-depth-a",
    "map-position-depth-b",
    "map-damping-depth-a",
    "map-damping-depth-b",
    "map-friction-depth-a",
    "map-friction-position-a",
    "map-stiffness-depth-a",
    "map-offset-inclination",
)

STUDIES = ("study-a", "study-b", "study-pressure-a", "study-reversal-a", "study-growth-a")

# Name -> what draws the picture once it is given a Runner.
FIGURES = {
    "fig-06": friction_over_speed,
    "fig-07": lambda run: forces_over_time([run("model-a")]),
    "fig-08": lambda run: forces_over_x([run("model-a")]),
    "fig-09": lambda run: forces_over_x([run("model-b")]),
    "fig-10": draw_model_slopes,
    "fig-11": draw_geometry_slopes,
    "contact": lambda run: contact(run("model-a")),
    "fields-a": lambda run: fields(run("model-a")),
    # The device and the apparatus.
    "device": lambda run: device("model-a", run),
    "device-b": lambda run: device("model-b", run),
    "device-apparatus": lambda run: device("apparatus-a", run),
    "comparison-depth-a": depths,
    "apparatus-a": lambda run: fields(run("apparatus-a")),
    "cylinder-a": lambda run: fields(run("cylinder-a")),
    "plate-a": drawn("plate-a", "sensors"),
    "plate-reversal-a": drawn("plate-reversal-a", "sensors"),
    "pair-a": drawn("pair-a", "pair"),
    "leaf-a": lambda run: forces_over_x([run("leaf-a")]),
    "leaf-b": lambda run: forces_over_x([run("leaf-b")]),
    "calibration-a": drawn("calibration-a", "calibration"),
    "calibration-b": drawn("calibration-b", "calibration"),
    "identification-a": drawn("identification-a", "identification"),
    # Other laws, methods and limits.
    **{name: drawn(name, "forces-over-x") for name in ("coulomb-a", "neo-hookean-a", "augmented-lagrangian-a")},
    **{name: drawn(name, "forces-over-x") for name in ("stiff-a", "stiff-b")},
    # Three dimensions.
    "solid-tilted-a": drawn("solid-tilted-a", "contact"),
    "solid-plate-a": drawn("solid-plate-a", "sensors"),
    "solid-modal-a": drawn("solid-modal-a", "modes"),
    "solid-pair-a": lambda run: fields(run("solid-pair-a"), way="backward"),
    "solid-fields-a": lambda run: fields(run("solid-tilted-a"), way="backward"),
    # In time.
    "support-a": lambda run: reversal(run("support-a")),
    "stribeck-a": lambda run: forces_over_time([run("stribeck-a")]),
    "stribeck-orbit-a": lambda run: oscillator.orbits(run("stribeck-a", "stribeck-a, linear contact", oscillator.CHANGES)),
    "reversal-a": lambda run: reversal(run("reversal-a")),
    "energy-a": lambda run: energy(run("reversal-a")),
    "sprag-slip-a": lambda run: reversal(run("sprag-slip-a")),
    "reversal-b": lambda run: reversal(run("reversal-b")),
    "harmonic-a": lambda run: forces_over_x([run("harmonic-a")]),
    "contact-law-a": lambda run: contact_law(run("contact-law-a")),
    "ladder-a": ladder,
    # Slides held at one x.
    "modes-a": drawn("modal-a", "modes"),
    "pair-reversal-a": drawn("pair-reversal-a", "pair"),
    "pair-modal-a": drawn("pair-modal-a", "modes"),
    "pair-stability-a": drawn("pair-stability-a", "modes"),
    "stability-a": drawn("stability-a", "stability"),
    "stability-b": drawn("stability-b", "stability"),
    **{f"onset-a-{picture}": drawn("onset-a", picture) for picture in ("growth", "cycle", "continuation")},
    **{f"onset-b-{picture}": drawn("onset-b", picture) for picture in ("cycle", "continuation")},
    **{name: drawn(name, "map") for name in MAPS},
    # These pictures show the cost of accuracy.
    **{name: drawn(name, "trade") for name in STUDIES},
    "convergence-a": drawn("study-pressure-a", "convergence"),
    "study-transmissibility-a": drawn("study-transmissibility-a", "transmissibility"),
    "study-offset-a": drawn("study-offset-a", "study"),
    "isolation-sprag-slip-a": drawn("isolation-sprag-slip-a", "motion"),
    "isolation-a-loop": drawn("isolation-a", "loop"),
    "isolation-free-a": drawn("isolation-free-a", "motion"),
    "isolation-ground-a": drawn("isolation-ground-a", "spectra"),
    "design-front-machine": drawn("design-front-machine", "front"),
}


def shrink(path):
    """Packs a PNG as small as it goes without loss: these are kept for good."""
    with Image.open(path) as image:
        image.convert("RGB").save(path, optimize=True, dpi=image.info["dpi"])


def read_arguments(arguments):
    parser = make_parser(__doc__)
    add_program(parser)
    add_output(parser, "PICTURE_DIR", "postprocess/pictures")
    parser.add_argument("--only", nargs="+", metavar="NAME", default=list(FIGURES), help="these pictures and the runs they need")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.only if name not in FIGURES]
    if unknown:
        parser.error(f"no picture {', '.join(unknown)}; there are {', '.join(FIGURES)}")
    return options


def main(arguments=None):
    options = read_arguments(arguments)
    use_print_style()
    try:
        with tempfile.TemporaryDirectory(prefix="sprag-figures-") as folder:
            runner = Runner(options.sprag.resolve(), Path(folder))
            for name in options.only:
                target, endings = options.output or PICTURES, options.format or ("png",)
                plot.save_all({name: FIGURES[name](runner)}, target, endings)
                if "png" in endings:
                    shrink(target / f"{name}.png")
    except (RunFailed, NotAResult, OSError) as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
