# SPDX-License-Identifier: GPL-3.0-only
"""The page params/own-device.md, followed as it is written: its files saved, its commands run one after the other, its findings
found. With SPRAG_LITERALLY=1 commands call ./run of the sources, which installs and builds; else the program and the pictures by
themselves."""

import os
import re
import shlex
import subprocess

import h5py
import numpy as np

from folders import FolderTest
from runs import SOURCE, SPRAG, TIMEOUT

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

    def result(self, run, name, group="summary"):
        with h5py.File(self.folder / "own" / run / "result.h5") as file:
            value = file[f"{group}/{name}"]
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

    def check_edges(self):
        """Values and tapers between which the growth rate of the worst slide changes its sign."""
        ranges = "Stability/Ranges=Contact/Damping {} 0.1; Friction/Factor 0.8 1.2"
        tapered = (self.folder / "own/tapered.geo").read_text(encoding="utf-8")
        (self.folder / "own/thinner.geo").write_text(tapered.replace("e + 8", "e + 6").replace("125, e + 6", "125, e + 4"), encoding="utf-8")
        cases = [
            ("Rotational spring/Stiffness=4.5e4", 5, 0.01, -1),
            ("Rotational spring/Stiffness=5.5e4", 5, 0.01, 1),
            *((f"Geometry/Interface offset={e}", 5, 0.01, sign) for e, sign in ((15.5, -1), (16.5, 1), (23.5, 1), (24.5, -1))),
            ("Mesh/File=tapered.geo", 2.5, 0.01, -1),
            ("Mesh/File=thinner.geo", 2.5, 0.02, 1),
        ]
        for setting, depth, damping, sign in cases:
            with self.subTest(setting):
                settings = ("Analysis/Type=stability", "Analysis/Model=condensed", "Stability/Critical=none", "Stability/Roles=off")
                words = [word for each in (*settings, setting, f"Lever/Depth={depth}", ranges.format(damping)) for word in ("--set", each)]
                self.call(shlex.join(["./run", "own/press.prm", *words, "--output", "own/edge", "--overwrite"]))
                self.assertGreater(sign * self.result("edge", "growth_rate"), 0)
        self.assertEqual(self.result("edge", "verdict"), "flutter")

    def test_leads_where_it_says(self):
        self.follow()
        self.assertIn("no warnings", self.printed["--validate"])
        self.assertTrue((self.folder / "own/press.png").is_file())
        self.assertAlmostEqual(self.result("rigid", "slope_forward"), 0.25, delta=0.005)
        self.assertAlmostEqual(self.result("rigid", "slope_backward"), -0.20, delta=0.005)
        self.assertIn("a rigid lever locks at mu = 5.6", self.printed["own/rigid"])
        for way, slope, tapered in (("forward", 0.227, 0.25), ("backward", -0.179, -0.20)):
            for force in "PQ":
                self.assertAlmostEqual(self.result("strokes", f"deviation_{force}_{way}"), 0.06, delta=0.025)
            self.assertAlmostEqual(self.result("strokes", "slope_" + way), slope, delta=0.0006)
            self.assertAlmostEqual(self.result("tapered", "slope_" + way), tapered, delta=0.005)
        self.assertAlmostEqual(self.result("strokes", "P", "accuracy"), 0.0005, delta=0.0001)
        self.assertEqual(self.result("slide", "verdict"), "flutter")
        self.assertRegex(self.printed["own/slide"], r"Lever/Depth from 2 to 12 mm: flutter, stable from 4\.2[456]")
        self.assertTrue(0.01 < self.result("slide", "critical_lever_depth_1_error") < 0.1)
        for limit, number in (("own", 3.25), ("likely", 3.71)):
            self.assertAlmostEqual(self.result("slide", f"critical_lever_depth_1_{limit}"), number, delta=0.02)
        self.assertRegex(self.printed["own/slide"], r"backward +growth at most \S+ 1/s, unstable at x = 2[01]\.\d+ to 40 mm")
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
        self.assertIn("Friction/Factor from 0.5 to 2: stable, flutter from 1.52", self.printed["own/slide-thick"])
        self.assertEqual(self.result("slide-tapered", "verdict"), "stable")
        self.assertAlmostEqual(self.result("slide-tapered", "growth_rate"), -20, delta=0.6)
        self.check_edges()
        self.assertLess(self.result("tapered", "largest_lever_stress"), 20)
        for number, entry in ((2070.87, "stiffness"), (1.55785, "exponent")):
            self.assertAlmostEqual(self.result("law", entry) / number, 1, delta=1e-3)
        for turn in (1, 2, 3):
            self.assertEqual(self.result("record", f"reversal_{turn}_verdict"), "decays")
        self.assertTrue(list((self.folder / "own/compared").glob("*.png")))
        self.assertTrue((self.folder / "own/tapered-tables/table.csv").is_file())
        self.assertAlmostEqual(self.result("tapered", "largest_pressure"), 0.44, delta=0.01)
