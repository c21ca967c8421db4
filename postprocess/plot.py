#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws result folders of sprag: forces, contact, fields, sensors, reversals, energies, sweeps, calibrations, comparisons."""

import gc
import os
import subprocess
import sys
from functools import partial
from pathlib import Path

SECOND = None  # the process that draws the second half of a drive's pictures
if __name__ == "__main__":
    gc.disable()  # it would take 6 % of the time, for next to no memory
    # A second process loads and draws beside this one. A fork would copy every page of memory that both write to.
    if "--on-word" in sys.argv and "--second" not in sys.argv:
        SECOND = subprocess.Popen([sys.executable, *sys.argv, "--second"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

from arguments import DPI, add_folders, add_output, make_parser, names_picture, save, script
from calibration import calibration
from comparison import check_steps, comparisons
from contact import contact
from design import design_pictures
from fields import fields
from forces import forces_over_time, forces_over_x
from frames import written_frames
from identification import identification
from isolation import is_transmissibility_study, isolation_pictures, transmissibility
from map import stability_map
from pair import draw_pair, has_pair
from sprag.results import NotAResult, read_result
from report import write_report
from sensors import has_sensors, sensor_forces
from slope import contact_law, slope_sweep
from sprag_slip import sprag_slip_pictures
from study import study_pictures
from style import plt, use_print_style
from surface import is_solid, surface
from transient import energy, has_reversal, is_transient, reversal
from vibration import vibration_pictures


# Types of analysis that are drawn as far as they have come.
IN_STEPS = ("quasi-static", "transient", "isolation", "sprag slip")
# A later run in the same folder may have none of these pictures.
OF_ONE_RUN = ("forces-over-time", "forces-over-x", "contact", "reversal", "energy", "sensors", "pair", "fields")
HALVES = (0, 1)


def draw(results, halves=HALVES):
    """{picture name: figure} for one or several results. Pictures of a drive come in two halves, the others with the first."""
    if 0 not in halves and (len(results) > 1 or results[0].type not in ("quasi-static", "transient")):
        return {}
    if len(results) > 1:
        return comparisons(results)
    (result,) = results
    if result.type not in IN_STEPS and not result.finished:
        raise NotAResult(f"{result.folder}: this analysis has nothing to draw before it is finished")
    match result.type:
        case "map":
            return {"map": stability_map(result)}
        case "study":
            more = {"transmissibility": transmissibility(result)} if is_transmissibility_study(result) else {}
            return {**study_pictures(result), **more}
        case "design":
            return design_pictures(result)
        case "identification":
            return {"identification": identification(result)}
        case "calibration":
            return {"calibration": calibration(result)}
        case "contact law":
            return {"contact-law": contact_law(result)}
        case "modal" | "stability":
            return vibration_pictures(result)
        case "slope":
            return {"slope": slope_sweep(result)}
    check_steps(results)
    match result.type:
        case "sprag slip":
            return sprag_slip_pictures(result)
        case "isolation":
            return isolation_pictures(result)
    return draw_drive(result, halves)


def draw_drive(result, halves):
    """The pictures of a run that moves the cylinder, those of the given halves."""
    pictures = {"forces-over-x": partial(forces_over_x, [result])}
    if is_transient(result):
        pictures["forces-over-time"] = partial(forces_over_time, [result])
    if is_solid(result):
        pictures["contact"] = partial(surface, result)
    elif result.friction_face is not None:
        pictures["contact"] = partial(contact, result)
    if is_transient(result) and has_reversal(result):
        pictures["reversal"] = partial(reversal, result)
    if is_transient(result) and result.has("energy_residual"):
        pictures["energy"] = partial(energy, result)
    if has_sensors(result):
        pictures["sensors"] = partial(sensor_forces, result)
    if has_pair(result):
        pictures["pair"] = partial(draw_pair, result)
    if written_frames(result):
        pictures["fields"] = partial(draw_fields, result)
    drawn = {name: make() for place, (name, make) in enumerate(pictures.items()) if (2 * place >= len(pictures)) in halves}
    return {name: figure for name, figure in drawn.items() if figure is not None}


def draw_fields(result):
    """Draws the fields at the largest P. A frame that cannot be read, as while it is written, does not stop the other pictures."""
    try:
        return fields(result)
    except NotAResult as error:
        print(f"plot.py: no picture of the fields: {error}", file=sys.stderr)
        return None


def save_all(pictures, folder, endings=("png",), dpi=DPI):
    """Writes every figure in every format, under its name."""
    for name, figure in pictures.items():
        save(figure, [folder / f"{name}.{ending}" for ending in endings], dpi)
        plt.close(figure)


def remove_earlier(pictures, folder, endings):
    """Pictures of the run before, which would pass for this one's."""
    for name in set(OF_ONE_RUN) - set(pictures):
        for ending in endings:
            (folder / f"{name}.{ending}").unlink(missing_ok=True)


def read_arguments(arguments):
    parser = make_parser(__doc__)
    add_folders(parser)
    add_output(parser, "PICTURE_DIR", "the only result folder, or the current one")
    parser.add_argument("--report", action="store_true", help="write report.html too, with all pictures in it")
    parser.add_argument("--on-word", action="store_true", help="wait for a line on standard input, and do nothing without one")
    parser.add_argument("--second", action="store_true", help="draw only the second half of the pictures of a drive, and no report")
    options = parser.parse_args(arguments)
    if names_picture(options.output):
        parser.error("-o names a folder, as there are several pictures; comparison.py draws one of several results")
    if options.output is None:
        options.output = options.folders[0] if len(options.folders) == 1 else Path(".")
    return options


@script
def main(arguments=None):
    options = read_arguments(arguments)
    use_print_style()
    if options.on_word and not sys.stdin.readline():
        return
    endings = options.format or ("png",)
    if options.report and "png" not in endings:
        endings = (*endings, "png")
    if SECOND:
        print("draw", file=SECOND.stdin, flush=True)
    results = [read_result(folder) for folder in options.folders]
    pictures = draw(results, (1,) if options.second else (0,) if SECOND else HALVES)
    save_all(pictures, options.output, endings)
    if options.second:
        return
    names = list(pictures)
    if SECOND:
        lines = SECOND.communicate()[0]
        print(lines, end="")
        if SECOND.returncode != 0:
            raise NotAResult("pictures are missing: the message stands above")
        names += dict.fromkeys(Path(line).stem for line in lines.splitlines())
    if options.folders == [options.output]:
        remove_earlier(names, options.output, endings)
    if options.report:
        write_report(results, {name: options.output / f"{name}.png" for name in names}, options.output / "report.html")


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # to free every object would take 0.15 s
