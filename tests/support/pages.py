# SPDX-License-Identifier: GPL-3.0-only
"""Which names of results the pages of postprocess have."""

import re

from pictures import FOLDER

PAGES = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")}
# Endings of names that stand for several.
FAMILIES = (
    (r"^critical_(?!inclination)\w+_(values|spacing)$", r"critical_PARAMETER_\1"),
    (r"^critical_(?!inclination)\w+_\d+$", "critical_PARAMETER_N"),
    (r"^(without_\w+)_(verdict|growth_rate|frequency|motion)$", r"\1_..."),
    (r"^(reversal|free_frequency|contact_frequency|frequency)_\d+", r"\1_N"),
)


def written(page):
    """Names in code on a page, `a`, `_b` standing for endings of the first in its cell."""
    found = set()
    for line in page.splitlines():
        names = re.findall(r"`([\w.]+)`", line.split("|")[1] if line.startswith("|") else line)
        for name in names:
            found.add(name)
            if name.startswith("_"):
                found |= {first + name for first in names} | {first.rsplit("_", n)[0] + name for first in names for n in (1, 2)}
    return found


def family(name):
    for pattern, replacement in FAMILIES:
        name = re.sub(pattern, replacement, name)
    return name


def entries():
    """Of summaries, in families."""
    found = written(PAGES["summary.md"]) | written(PAGES["summary-of-analyses.md"]) | {"without_damping_..."}
    stresses = [f"largest_{name}" for name in ("lever_stress", "layer_stress", "stress_at_hub")]
    found |= {f"{name}_{what}" for name in stresses for what in ("x", "xi", "eta", "direction", "lever")}
    found |= {f"deviation_{name}_{way}" for name in ("P", "Q", "theta") for way in ("forward", "backward")}
    found |= {f"{state}_frequency_N_{what}" for state in ("free", "contact") for what in ("beam", "deviation")}
    return found | {name.replace("_forward", "_backward") for name in found}


def columns():
    """Of tables."""
    return written(PAGES["results.md"]) | written(PAGES["modes-maps-studies.md"])


def unknown_entries(result):
    return sorted({family(name) for name in result.summary} - entries())


def unknown_columns(result):
    return sorted(name for name in result.table if name not in columns() and not name.startswith("sensor_"))
