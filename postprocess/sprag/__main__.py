# SPDX-License-Identifier: GPL-3.0-only
"""Converts scenes, prints the schema of their JSON, and ranks dampers.

  python3 -m sprag schema           # the JSON schema of all parameters
  python3 -m sprag json FILE.prm    # what a scene sets apart from defaults
  python3 -m sprag prm FILE.json    # the scene of such a file
  python3 -m sprag dampers FILE.prm [--displacement MM]
                                    # dampers of its isolated table, each as strong as lets the least through, or
                                    # as keeps the table within that displacement
"""

import argparse
import json
import sys
from pathlib import Path

from .dampers import rank_dampers, tell_ranking
from .parameters import document, parse, parse_document, scene_text, schema, set_apart
from .program import RunFailed, Scene, program, read_output


def answer(form, path, displacement):
    """Returns the text that is printed. Throws RunFailed, OSError, ValueError."""
    if form == "dampers":
        return tell_ranking(*rank_dampers(path, displacement=displacement))
    if form == "prm":
        return scene_text(parse_document(json.loads(Path(path).read_text(encoding="utf-8"))))
    found = schema(parse(read_output([program(), "--print-parameters"]))) if form == "schema" else document(set_apart(Scene(path).parameters))
    return json.dumps(found, indent=2, ensure_ascii=False)


def main():
    parser = argparse.ArgumentParser(prog="python3 -m sprag", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("form", choices=("schema", "json", "prm", "dampers"))
    parser.add_argument("file", nargs="?", help="FILE.prm or FILE.json")
    parser.add_argument("--displacement", type=float, metavar="MM", help="largest of the table over its base")
    options = parser.parse_args()
    if (options.file is None) != (options.form == "schema"):
        parser.error("schema takes no file, the others need one")
    try:
        print(answer(options.form, options.file, options.displacement))
    except (RunFailed, OSError, ValueError) as error:
        parser.exit(2, f"{error}\n")


if __name__ == "__main__":
    sys.exit(main())
