# SPDX-License-Identifier: GPL-3.0-only
"""Which names of results the pages of postprocess have."""

import re
from fnmatch import fnmatchcase

from pictures import FOLDER

PAGES = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")}

def written(page):
    """Names in code on a page, `a`, `_b` standing for endings of the first in its cell."""
    found = set()
    for line in page.splitlines():
        names = re.findall(r"`([\w.*]+)`", line.split("|")[1] if line.startswith("|") else line)
        for name in names:
            found.add(name)
            if name.startswith("_"):
                found |= {first + name for first in names} | {first.rsplit("_", n)[0] + name for first in names for n in (1, 2)}
    return found


def columns():
    """Returns the names of the columns of tables."""
    return written(PAGES["results.md"]) | written(PAGES["modes-maps-studies.md"])


def unknown_entries(result):
    """Names in summaries that no name or pattern in code on the pages fits."""
    patterns = [name for page in ("summary.md", "summary-of-analyses.md") for name in re.findall(r"`([\w.*]+)`", PAGES[page])]
    return sorted(name for name in result.summary if not any(fnmatchcase(name, pattern) for pattern in patterns))


def unknown_columns(result):
    patterns = columns()
    return sorted(name for name in result.table if not any(fnmatchcase(name, pattern) for pattern in patterns))
