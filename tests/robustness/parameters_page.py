# SPDX-License-Identifier: GPL-3.0-only
"""The page params/parameters.md has names, defaults, units and values of the program's declarations: --write writes them, without
arguments they are compared. Meanings are those of the page that the program was built with. Run with /usr/bin/python3; environment:
SPRAG, the program, and SPRAG_SOURCE, the sources."""

import sys
from itertools import groupby
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / "support"), str(Path(__file__).resolve().parents[2] / "postprocess")]
from runs import SOURCE, sprag  # noqa: E402
from sprag.parameters import parse  # noqa: E402

PAGE = SOURCE / "params" / "parameters.md"
INTRODUCTION = """# Every parameter

`sprag --print-parameters` prints the same as a scene, `sprag --help Lever` a section and `sprag --help Lever/Depth` one of them.
The program takes meanings from here; `tests/robustness/parameters_page.py --write` makes the other columns of its declarations.
"""


def row(name, parameter):
    default = parameter.text if parameter.default is None else parameter.default
    choices = parameter.range.removeprefix("one of ").replace(" | ", ", ")
    cells = [f"`{name}`", default, "" if parameter.unit == "1" else parameter.unit, choices, parameter.meaning.removesuffix(".")]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def page():
    declared = parse(sprag("--print-parameters").stdout)
    lines = [INTRODUCTION]
    for section, names in groupby(declared, key=lambda full: full.split("/")[0]):
        lines += [f"## {section}", "", "| parameter | default | unit | values | meaning |", "|---|---|---|---|---|"]
        lines += [*(row(full.split("/")[1], declared[full]) for full in names), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


if sys.argv[1:] == ["--write"]:
    PAGE.write_text(page(), encoding="utf-8")
elif PAGE.read_text(encoding="utf-8") != page():
    sys.exit(f"{PAGE} is not that of the program: call {sys.argv[0]} --write")
