# SPDX-License-Identifier: GPL-3.0-only
"""Converts scenes, and prints the schema of their JSON.

  python3 -m sprag schema           # the JSON schema of all parameters
  python3 -m sprag json FILE.prm    # what a scene sets apart from defaults
  python3 -m sprag prm FILE.json    # the scene of such a file
"""

import argparse
import json
import sys
from pathlib import Path

from .parameters import document, parse, parse_document, scene_text, schema, set_apart
from .program import RunFailed, Scene, program, read_output


def convert(form, path):
    """Returns the text that is printed. Throws RunFailed, OSError, ValueError."""
    if form == "prm":
        return scene_text(parse_document(json.loads(Path(path).read_text(encoding="utf-8"))))
    found = schema(parse(read_output([program(), "--print-parameters"]))) if form == "schema" else document(set_apart(Scene(path).parameters))
    return json.dumps(found, indent=2, ensure_ascii=False)


def main():
    parser = argparse.ArgumentParser(prog="python3 -m sprag", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("form", choices=("schema", "json", "prm"))
    parser.add_argument("file", nargs="?", help="FILE.prm or FILE.json")
    options = parser.parse_args()
    if (options.file is None) != (options.form == "schema"):
        parser.error("json and prm take a file, schema none")
    try:
        print(convert(options.form, options.file))
    except (RunFailed, OSError, ValueError) as error:
        parser.exit(2, f"{error}\n")


if __name__ == "__main__":
    sys.exit(main())
