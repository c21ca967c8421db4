"""The pages of postprocess name what there is: columns and entries of real results, scripts, pictures; run with /usr/bin/python3."""

import os
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import FOLDER, SOURCE, PictureTest  # noqa: E402
import program  # noqa: E402
from results import read_result  # noqa: E402

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
PAGES = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")}
COARSE = {"Mesh/Face size": 2, "Output/Fields": "none"}
RUNS = {
    "pair-a": COARSE,
    "plate-reversal-a": {**COARSE, "Drive/Start": 60},
    "fig11": {},
    "contact-law-a": COARSE,
    "calibration-a": {"Mesh/Face size": 4},
    "modal-a": COARSE,
    "pair-stability-a": {"Stability/Critical": "Friction/Factor 0.9 1.1"},
    "map-friction-depth-a": {"Map/First points": 2, "Map/Second points": 2, "Map/Coarsest": 1, "Map/Bisections": 0},
    "study-growth-a": {"Study/Vary": "Mesh/Face size = 2, 4", "Study/Reference": ""},
}
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


class PagesTest(PictureTest):
    def test_entries_and_columns_of_results(self):
        entries, columns = written(PAGES["summary.md"]), written(PAGES["results.md"]) | written(PAGES["modes-maps-studies.md"])
        entries |= {name.replace("without_damping", "without_damping_...") for name in entries}
        stresses = [f"largest_{name}" for name in ("lever_stress", "layer_stress", "stress_at_hub")]
        entries |= {f"{name}_{what}" for name in stresses for what in ("x", "xi", "eta", "direction", "lever")}
        entries |= {f"deviation_{name}_{way}" for name in ("P", "Q", "theta") for way in ("forward", "backward")}
        entries |= {name.replace("_forward", "_backward") for name in entries}
        entries |= {f"{state}_frequency_N_{what}" for state in ("free", "contact") for what in ("beam", "deviation")}
        entries.add("without_damping_...")
        for scene, changes in RUNS.items():
            program.run_scene(program.program(), SCENES / f"{scene}.prm", self.folder / scene, changes)
            result = read_result(self.folder / scene)
            with self.subTest(scene=scene):
                self.assertEqual(sorted({family(name) for name in result.summary} - entries), [])
                if scene not in ("map-friction-depth-a", "study-growth-a", "calibration-a"):
                    self.assertEqual(sorted(name for name in result.table if name not in columns and not name.startswith("sensor_")), [])

    def test_links_and_pictures_are_there(self):
        for page, text in PAGES.items():
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
                self.assertTrue((FOLDER / target).exists(), f"{page}: {target}")
            for target, anchor in re.findall(r"\]\(([^)#]*)#([^)]+)\)", text):
                headings = re.findall(r"^#+ (.*)$", (FOLDER / (target or page)).read_text(encoding="utf-8"), re.MULTILINE)
                slugs = {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
                self.assertIn(anchor, slugs, page)

    def test_every_script_and_picture_has_its_place(self):
        every = "\n".join(PAGES.values())
        for path in FOLDER.glob("*.py"):
            if os.access(path, os.X_OK):
                self.assertIn(path.name, every)


if __name__ == "__main__":
    unittest.main()
