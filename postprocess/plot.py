#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Draws result folders of sprag: forces, contact, fields, sensors, reversals, energies, sweeps, calibrations, comparisons."""

import sys
from pathlib import Path

from arguments import add_folders, add_output, names_picture, parser_of, save
from calibration import calibration, is_calibration
from comparison import check_steps, comparison
from contact import contact
from design import design_pictures, is_design
from fields import fields
from forces import forces_over_time, forces_over_x
from frames import written_frames
from identification import identification, is_identification
from isolation import is_isolation, is_transmissibility_study, isolation_pictures, transmissibility
from map import is_map, stability_map
from pair import has_pair, pair_of_levers
from results import NotAResult, read_result, script
from sensors import has_sensors, sensor_forces
from slope import contact_law, slope_sweep
from sprag_slip import is_sprag_slip, sprag_slip_pictures
from study import is_study, study_pictures
from style import plt, use_print_style
from surface import is_solid, surface
from transient import energy, has_reversal, is_transient, reversal
from vibration import vibration_pictures


# A later run in the same folder may have none of these pictures.
OF_ONE_RUN = ("forces-over-time", "forces-over-x", "contact", "reversal", "energy", "sensors", "pair", "fields")


def draw(results):
    """{picture name: figure} for one or several results."""
    if len(results) == 1 and is_map(results[0]):
        return {"map": stability_map(results[0])}
    if len(results) == 1 and is_study(results[0]) and is_transmissibility_study(results[0]):
        return {**study_pictures(results[0]), "transmissibility": transmissibility(results[0])}
    if len(results) == 1 and is_study(results[0]):
        return study_pictures(results[0])
    if len(results) == 1 and is_design(results[0]):
        return design_pictures(results[0])
    if len(results) == 1 and is_identification(results[0]):
        return {"identification": identification(results[0])}
    if len(results) == 1 and is_calibration(results[0]):
        return {"calibration": calibration(results[0])}
    if len(results) == 1 and "P_fitted" in results[0].table:
        return {"contact-law": contact_law(results[0])}
    if len(results) == 1 and is_sprag_slip(results[0]):
        check_steps(results)
        return sprag_slip_pictures(results[0])
    if len(results) == 1 and "modes" in results[0].groups:
        return vibration_pictures(results[0])
    if len(results) == 1 and results[0].is_sweep:
        return {"slope": slope_sweep(results[0])}
    if len(results) == 1 and is_isolation(results[0]):
        check_steps(results)
        return isolation_pictures(results[0])
    check_steps(results)
    pictures = {"forces-over-time": forces_over_time(results), "forces-over-x": forces_over_x(results)}
    return {**pictures, **(pictures_of_one(results[0]) if len(results) == 1 else {"comparison": comparison(results)})}


def pictures_of_one(result):
    pictures = {}
    if is_solid(result):
        pictures["contact"] = surface(result)
    elif result.face is not None:
        pictures["contact"] = contact(result)
    if is_transient(result) and has_reversal(result):
        pictures["reversal"] = reversal(result)
    if is_transient(result) and result.has("energy_residual"):
        pictures["energy"] = energy(result)
    if has_sensors(result):
        pictures["sensors"] = sensor_forces(result)
    if has_pair(result):
        pictures["pair"] = pair_of_levers(result)
    return {**pictures, **picture_of_fields(result)}


def picture_of_fields(result):
    """Of the frame of the largest x. One that cannot be read, as while it is written, must not keep the others from being drawn."""
    try:
        return {"fields": fields(result)} if written_frames(result) else {}
    except NotAResult as error:
        print(f"plot.py: no picture of the fields: {error}", file=sys.stderr)
        return {}


def save_all(pictures, folder, endings=("png",), dpi=300):
    """Every figure in every format, under its name."""
    for name, figure in pictures.items():
        save(figure, [folder / f"{name}.{ending}" for ending in endings], dpi)
        plt.close(figure)


def remove_earlier(pictures, folder, endings):
    """Pictures of the run before, which would pass for this one's."""
    for name in set(OF_ONE_RUN) - set(pictures):
        for ending in endings:
            (folder / f"{name}.{ending}").unlink(missing_ok=True)


def read_arguments(arguments):
    parser = parser_of(__doc__)
    add_folders(parser)
    add_output(parser, "PICTURE_DIR", "the only result folder, or the current one")
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
    endings = options.format or ("png",)
    pictures = draw([read_result(folder) for folder in options.folders])
    save_all(pictures, options.output, endings)
    if options.folders == [options.output]:
        remove_earlier(pictures, options.output, endings)


if __name__ == "__main__":
    sys.exit(main())
