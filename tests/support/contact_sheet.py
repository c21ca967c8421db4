#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs every scene of params/, makes all the pictures that ./run makes, checks their layout and lays them out on one sheet.

Scenes that take minutes are run with coarser grids and meshes, and with fewer values of a study. A result that is there already
is drawn as it is. Exit status 1 where a scene fails or a picture's layout is wrong.
"""

import argparse
import math
import os
import subprocess
import sys
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from layout import problems
from pictures import SOURCE  # puts the scripts on the path

import plot  # noqa: E402
from sprag.results import NotAResult, read_result  # noqa: E402
from style import TWO_COLUMNS, plt, use_print_style  # noqa: E402

# Changes that shorten a scene; its pictures keep their kinds of curves.
MAP = {"Map/First points": 17, "Map/Second points": 17, "Map/Bisections": 2}
MESHED_MAP = {**MAP, "Map/First points": 9, "Map/Second points": 9, "Mesh/Face size": 1}
SIZES = "Mesh/Face size = 0.5, 0.707, 1, 1.41, 2"
FINEST = "Mesh/Face size = 0.25"
LAGRANGIAN = f"Contact/Enforcement = augmented Lagrangian; {FINEST}"
SHORTER = {
    **{f"map-{name}": MAP for name in ("friction-depth-a", "friction-position-a", "offset-inclination", "stiffness-depth-a")},
    **{f"map-position-depth-{model}": MESHED_MAP for model in "ab"},
    **{f"study-{model}": {"Study/Vary": f"Mesh/Degree = 1, 2; {SIZES}", "Study/Reference": LAGRANGIAN} for model in "ab"},
    "study-pressure-a": {
        "Study/Vary": f"Contact/Enforcement = penalty, augmented Lagrangian; Mesh/Degree = 1, 2; {SIZES}",
        "Study/Reference": LAGRANGIAN,
    },
    "study-growth-a": {
        "Study/Vary": f"Mesh/Degree = 1, 2; Condensed/Modes = 3, 20; {SIZES}",
        "Study/Reference": FINEST,
    },
    "study-reversal-a": {
        "Study/Vary": "Condensed/Modes = 5, 20; Time/Tolerance = 1e-2, 3e-2; Mesh/Face size = 1, 2",
        "Study/Reference": "Mesh/Face size = 0.5; Time/Tolerance = 3e-3",
    },
    "onset-a": {"Sprag slip/Continuation": 4},
    "onset-b": {"Sprag slip/Continuation": 4},
    "stiff-a": {"Mesh/Face size": 0.25},
    "stiff-b": {"Mesh/Face size": 0.25},
}

WIDTH, CAPTION, GAP, COLUMNS = 560, 22, 10, 6  # pixels; a picture as wide as the page takes a column
DPI = 200


def run(sprag, scene, folder):
    """Unless there is a result already; raises NotAResult with what sprag said."""
    if (folder / "result.h5").exists():
        return
    changes = [word for name, value in SHORTER.get(scene.stem, {}).items() for word in ("--set", f"{name}={value}")]
    done = subprocess.run(
        [sprag, scene, "--output", folder, "--quiet", *changes], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL
    )
    if done.returncode != 0:
        raise NotAResult(f"{scene.name}: sprag ended with {done.returncode}\n{done.stderr.strip()}")


def draw(folder):
    """Writes the pictures of a result beside it: [(path, what is wrong)]."""
    drawn = []
    for name, figure in plot.draw([read_result(folder)]).items():
        path = folder / f"{name}.png"
        wrong = problems(figure)
        figure.savefig(path, dpi=DPI)
        plt.close(figure)
        drawn.append((path, wrong))
    return drawn


def make_sheet(pictures):
    """One image of all in columns, all in one scale; captions of those with a wrong layout are red."""
    font = ImageFont.truetype(str(Path(plt.matplotlib.get_data_path()) / "fonts/ttf/DejaVuSans.ttf"), 14)
    filled = [0] * COLUMNS
    places = []
    for path, wrong in pictures:
        image = tile(path, wrong, font)
        column = filled.index(min(filled))
        places.append((image, (column * WIDTH, filled[column])))
        filled[column] += image.height
    sheet = Image.new("RGB", (WIDTH * min(COLUMNS, len(places)), max(filled)), "white")
    for image, place in places:
        sheet.paste(image, place)
    return sheet


def tile(path, wrong, font):
    picture = Image.open(path).convert("RGB")
    shrunk = (WIDTH - GAP) / (TWO_COLUMNS * DPI)
    picture = picture.resize((math.floor(picture.width * shrunk), math.floor(picture.height * shrunk)), Image.LANCZOS)
    image = Image.new("RGB", (WIDTH, picture.height + CAPTION + GAP), "white")
    image.paste(picture, (GAP // 2, CAPTION))
    words = f"{path.parent.name}: {path.stem}" + (f", {len(wrong)} wrong" if wrong else "")
    ImageDraw.Draw(image).text((GAP // 2, 2), words, fill="red" if wrong else "black", font=font)
    return image


def read_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sprag", type=Path, default=os.environ.get("SPRAG", SOURCE / "build" / "sprag"), help="build/sprag")
    parser.add_argument("--results", type=Path, default=SOURCE / "output" / "sheet", metavar="DIR", help="output/sheet")
    parser.add_argument("--only", nargs="+", metavar="SCENE", help="of params/, without .prm (all)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="the sheet; default: sheet.png among the results")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = read_arguments(arguments)
    use_print_style()
    scenes = [path for path in sorted((SOURCE / "params").glob("*.prm")) if not options.only or path.stem in options.only]
    options.results.mkdir(parents=True, exist_ok=True)
    pictures, failed = [], False
    for scene in scenes:
        folder = options.results / scene.stem
        try:
            run(options.sprag, scene, folder)
            pictures += draw(folder)
        except NotAResult as error:
            print(error, file=sys.stderr)
            failed = True
    for path, wrong in pictures:
        for text in wrong:
            print(f"{path.parent.name}/{path.stem}: {text}")
    if not pictures:
        print("no pictures", file=sys.stderr)
        return 1
    sheet = options.output or options.results / "sheet.png"
    make_sheet(pictures).save(sheet)
    print(f"{sheet}: {len(pictures)} pictures, {sum(bool(wrong) for _, wrong in pictures)} with something wrong")
    return int(failed or any(wrong for _, wrong in pictures))


if __name__ == "__main__":
    sys.exit(main())
