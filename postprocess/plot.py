#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws result folders of sprag: forces, contact, fields, sensors, reversals, energies, sweeps, calibrations, comparisons."""

import gc
import multiprocessing
import sys
from pathlib import Path

if __name__ == "__main__":
    gc.disable()  # it would take 6 % of the time, for next to no memory

from arguments import DPI, add_folders, add_output, make_parser, names_picture, script, write_picture
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


FORK = multiprocessing.get_context("fork")
# Types of analysis that are drawn as far as they have come.
IN_STEPS = ("quasi-static", "transient", "isolation", "sprag slip")
# A later run in the same folder may have none of these pictures.
OF_ONE_RUN = ("forces-over-time", "forces-over-x", "contact", "reversal", "energy", "sensors", "pair", "fields")


def draw(results):
    """{picture name: figure} for one or several results."""
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
    return draw_drive(result)


def draw_drive(result):
    pictures = {"forces-over-x": forces_over_x([result])}
    if is_transient(result):
        pictures["forces-over-time"] = forces_over_time([result])
    if is_solid(result):
        pictures["contact"] = surface(result)
    elif result.friction_face is not None:
        pictures["contact"] = contact(result)
    if is_transient(result) and has_reversal(result):
        pictures["reversal"] = reversal(result)
    if is_transient(result) and result.has("energy_residual"):
        pictures["energy"] = energy(result)
    if has_sensors(result):
        pictures["sensors"] = sensor_forces(result)
    if has_pair(result):
        pictures["pair"] = draw_pair(result)
    return {**pictures, **draw_fields(result)}


def draw_fields(result):
    """Draws the fields at the largest P. A frame that cannot be read, as while it is written, does not stop the other pictures."""
    try:
        return {"fields": fields(result)} if written_frames(result) else {}
    except NotAResult as error:
        print(f"plot.py: no picture of the fields: {error}", file=sys.stderr)
        return {}


def save_all(pictures, folder, endings=("png",), dpi=DPI):
    """Every figure in every format, under its name. All but the last are written by processes of their own, as drawing takes one
    core. Where one fails its figure is written here, which tells why."""
    paths = {name: [folder / f"{name}.{ending}" for ending in endings] for name in pictures}
    sys.stdout.flush()
    writers = {name: FORK.Process(target=write_or_fail, args=(pictures[name], paths[name], dpi)) for name in list(pictures)[:-1]}
    for writer in writers.values():
        writer.start()
    for name in reversed(pictures):
        if name in writers:
            writers[name].join()
        if name not in writers or writers[name].exitcode != 0:
            write_picture(pictures[name], paths[name], dpi)
        plt.close(pictures[name])
    for written in paths.values():
        print(*written, sep="\n")


def write_or_fail(figure, paths, dpi):
    try:
        write_picture(figure, paths, dpi)
    except Exception:
        sys.exit(1)


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
    results = [read_result(folder) for folder in options.folders]
    pictures = draw(results)
    save_all(pictures, options.output, (*endings, "png") if options.report and "png" not in endings else endings)
    if options.folders == [options.output]:
        remove_earlier(pictures, options.output, endings)
    if options.report:
        write_report(results, {name: options.output / f"{name}.png" for name in pictures}, options.output / "report.html")


if __name__ == "__main__":
    sys.exit(main())
