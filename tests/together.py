# SPDX-License-Identifier: GPL-3.0-only
"""Writes a source that compiles several tests as one file: first all that they include, then each in a namespace of its own, so that
their local names may be alike.

    tests/together.py ROOT OUTPUT SOURCE ...    # ROOT is a folder in which headers are looked for
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.MULTILINE)


def read_includes(source, root):
    """Lines that include what a source includes; a header beside it is named from the root."""
    for bracket, name in INCLUDE.findall(source.read_text(encoding="utf-8")):
        if bracket == "<":
            yield f"#include <{name}>"
        else:
            beside = source.parent / name
            yield f'#include "{beside.relative_to(root) if beside.exists() else name}"'


def main(root, output, *sources):
    sources = [Path(source) for source in sources]
    lines = [*dict.fromkeys(line for source in sources for line in read_includes(source, root)), ""]
    for source in sources:
        lines += [f"namespace {source.stem}_tests", "{", f'#include "{source.relative_to(root)}"', "}", ""]
    Path(output).write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
