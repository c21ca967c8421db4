# SPDX-License-Identifier: GPL-3.0-only
"""The page params/own-device.md, followed as it is written: its files saved, its commands run one after the other, its findings
found. Run with /usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the sources. With SPRAG_LITERALLY=1 commands call
./run of the sources, which installs and builds; else the program and the pictures by themselves."""

import os
import re
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from folders import FolderTest  # noqa: E402
from runs import SOURCE, SPRAG, TIMEOUT  # noqa: E402

PAGE = SOURCE / "params" / "own-device.md"
LITERALLY = os.environ.get("SPRAG_LITERALLY") == "1"
COMMANDS = ("./run ", "postprocess/")


def blocks(page):
    """Indented blocks and the text before each."""
    text, block = [], []
    for line in [*page.splitlines(), "end"]:
        if line.startswith("    ") or (block and not line.strip()):
            block.append(line[4:])
            continue
        if block:
            yield " ".join(text[-4:]), "\n".join(block).strip() + "\n"
            block = []
        text.append(line)


class OwnDevice(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("run", "postprocess", ".ci", "params", "meshes"):
            (self.folder / name).symlink_to(SOURCE / name)
        (self.folder / "own").mkdir()
        self.printed = {}

    def call(self, line):
        words = shlex.split(line)
        if words[0] == "./run" and not LITERALLY:
            words[0] = SPRAG
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=3 * TIMEOUT, cwd=self.folder)
        self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout}{done.stderr}")
        self.printed[words[-1]] = done.stdout

    def follow(self):
        for before, block in blocks(PAGE.read_text(encoding="utf-8")):
            if block.startswith(COMMANDS):
                for line in block.splitlines():
                    self.call(line)
            else:
                name = re.findall(r"as `(own/[\w.-]+)`", before)[-1]
                (self.folder / name).write_text(block, encoding="utf-8")

    def result(self, run, name):
        with h5py.File(self.folder / "own" / run / "result.h5") as file:
            value = file["summary/" + name]
            return value.asstr()[()] if value.dtype.kind == "O" else float(value[()])

    def largest_growth(self, depth):
        """Returns that of 400 slides at random over the stroke, both ways, and over the ranges of step 3."""
        rng, n = np.random.default_rng(43), 400
        vary = {
            "Stability/Position": rng.uniform(1, 40, n),
            "Stability/Direction": rng.choice(["forward", "backward"], n),
            "Contact/Damping": np.geomspace(0.01, 0.1, n),
            "Friction/Factor": rng.uniform(0.8, 1.2, n),
        }
        lists = "; ".join(f"{name} = {', '.join(map(str, values))}" for name, values in vary.items())
        study = f"Analysis/Type=study Study/Type=stability Study/Combine=list Stability/Critical=none Analysis/Model=condensed Lever/Depth={depth}"
        options = [word for setting in (*study.split(), f"Study/Vary={lists}") for word in ("--set", setting)]
        self.call(shlex.join(["./run", "own/press.prm", *options, "--output", f"own/slides-{depth}"]))
        with h5py.File(self.folder / "own" / f"slides-{depth}" / "result.h5") as file:
            return file["table/growth_rate"][:].max()

    def test_leads_where_it_says(self):
        self.follow()
        self.assertIn("no warnings", self.printed["--validate"])
        self.assertTrue((self.folder / "own/press.png").is_file())
        self.assertAlmostEqual(self.result("rigid", "slope_forward"), 0.25, delta=0.005)
        self.assertAlmostEqual(self.result("rigid", "slope_backward"), -0.20, delta=0.005)
        for way in ("forward", "backward"):
            self.assertAlmostEqual(self.result("strokes", "deviation_Q_" + way), 0.055, delta=0.014)
        self.assertEqual(self.result("slide", "verdict"), "flutter")
        self.assertRegex(self.printed["own/slide"], r"Lever/Depth from 2 to 12 mm: flutter, stable from 4\.2")
        self.assertLess(self.largest_growth(4.26), 0)
        self.assertGreater(self.largest_growth(3.8), 0)
        slide = "Stability/Position=40 Stability/Direction=forward Contact/Damping=0.01 Friction/Factor=1.2 Stability/Critical=none"
        law = "Contact/Stiffness=2070.87 Contact/Exponent=1.55785 Analysis/Model=beam"
        for number, model in ((-17.5, "Analysis/Model=condensed"), (4.7, law), (-19.9, f"{law} Contact/Tangential~stiffness=1e6")):
            settings = f"Analysis/Type=stability Lever/Depth=5 {slide} {model}".split()
            options = [word for setting in settings for word in ("--set", setting.replace("~", " "))]
            self.call(shlex.join(["./run", "own/press.prm", *options, "--output", f"own/stick{number}"]))
            self.assertAlmostEqual(self.result(f"stick{number}", "growth_rate"), number, delta=0.1)
        self.assertEqual(self.result("slide-thick", "verdict"), "stable")
        self.assertIn("Friction/Factor from 0.5 to 2: stable, flutter from 1.5", self.printed["own/slide-thick"])
        self.assertEqual(self.result("slide-tapered", "verdict"), "stable")
        self.assertLess(self.result("tapered", "largest_lever_stress"), 20)
        for number, entry in ((2070.87, "stiffness"), (1.55785, "exponent")):
            self.assertAlmostEqual(self.result("law", entry) / number, 1, delta=1e-3)
        for turn in (1, 2, 3):
            self.assertEqual(self.result("record", f"reversal_{turn}_verdict"), "decays")
        self.assertTrue(list((self.folder / "own/compared").glob("*.png")))
        self.assertTrue((self.folder / "own/tapered-tables/table.csv").is_file())
        self.assertAlmostEqual(self.result("tapered", "largest_pressure"), 0.44, delta=0.01)


if __name__ == "__main__":
    unittest.main()
