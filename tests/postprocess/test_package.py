# SPDX-License-Identifier: GPL-3.0-only
"""The Python package runs scenes, reads results and tells errors."""

import contextlib
import gc
import importlib.util
import io
import json
import math
import operator
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from pictures import SOURCE, FolderTest
import sprag
from sprag.dampers import RankedDamper, find_strength, tell_ranking
from sprag.parameters import document
from sprag.program import program

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
COARSE = {"Mesh/Face size": 2, "Analysis/Step": 4}
USER = """import sprag
scene = sprag.Scene("a.prm")
scene.lever.depth = 12
scene.lever.depth.number.real
sprag.run(scene, {"Drive/Stroke": 40}).table["Q"].unit.title()
sprag.run(7)
"""  # the number may be None, and 7 is no scene


def is_accepted(rule, value):
    """Tells if a value keeps a rule of the schema, by those of its words that sprag writes."""
    if "anyOf" in rule:
        return any(is_accepted(each, value) for each in rule["anyOf"])
    if "const" in rule or "enum" in rule:
        return value in rule.get("enum", [rule.get("const")])
    kinds = {"integer": int, "number": (int, float), "string": str}
    if not any(isinstance(value, kinds[kind]) for kind in ([rule["type"]] if isinstance(rule["type"], str) else rule["type"])):
        return False
    limits = {"minimum": operator.ge, "exclusiveMinimum": operator.gt, "maximum": operator.le, "exclusiveMaximum": operator.lt}
    return all(keeps(value, rule[word]) for word, keeps in limits.items() if word in rule)


class PackageTest(FolderTest):
    def test_a_run_with_changes(self):
        result = sprag.run(SCENES / "closed-form-a.prm", {"Drive/Stroke": 40})
        x, Q = result.table["x"], result.table["Q"]
        self.assertEqual((x.max(), x.unit, Q.unit, result.summary["slope_forward"].unit), (40, "mm", "N", "N/mm"))
        self.assertIn("x-force", Q.description)
        # The slope at x = 0 is that of the column there.
        self.assertAlmostEqual(Q[1] / x[1] / result.summary["slope_forward"], 1, delta=0.02)
        self.assertEqual(type(Q * x), np.ndarray)
        self.assertEqual(Q[3:5].unit, "N")
        self.assertRegex(repr(result), r"^<quasi-static in .*: completed, \d+ rows; peak_P_forward, .*>$")

    def test_a_scene(self):
        scene = sprag.Scene(SCENES / "closed-form-a.prm")
        depth, law = scene.lever.depth, scene.analysis.type
        self.assertEqual((depth.number, depth.unit, depth.range), (20, "mm", "a number > 0"))
        self.assertIn("without the friction layer", depth.meaning)
        scene.drive.stroke = 40
        self.assertEqual(scene.drive.stroke.number, 40)
        self.assertIn("set Stroke = 40", str(scene))
        self.assertEqual(sprag.run(scene).table["x"].max(), 40)
        self.assertEqual(sprag.sweep(scene, {"Friction/Factor": [0.9, 1]}).parameter("Drive", "Stroke"), "40")
        with self.assertRaisesRegex(AttributeError, "no strok; there are .*stroke"):
            scene.drive.strok = 40
        for mistake in ("scene.levr", "scene.stroke = 40", "scene.lever = 12"):
            with self.assertRaises(AttributeError):
                exec(mistake)
        sections = scene.schema()["properties"]
        self.assertEqual(sections["Lever"]["properties"]["Depth"]["exclusiveMinimum"], 0)
        self.assertEqual(sections["Analysis"]["properties"]["Type"]["enum"], law.range.removeprefix("one of ").split(" | "))
        self.assertEqual(sections["Analysis"]["properties"]["Dimension"]["enum"], ["auto", 2, 3])
        scene.lever.depth = -1
        with self.assertRaisesRegex(sprag.Refused, "Lever/Depth = -1: must be a number > 0"):
            sprag.run(scene)

    def test_shipped_scenes_keep_the_schema(self):
        rules = json.loads(self.convert("schema"))["properties"]
        self.assertEqual(rules["Lever"]["properties"]["Depth"].items() & {"unit": "mm", "default": 20}.items(), {("unit", "mm"), ("default", 20)})
        for scene in sorted(SCENES.glob("*.prm")):
            for section, entries in document(sprag.Scene(scene).parameters).items():
                for name, value in entries.items():
                    self.assertTrue(is_accepted(rules[section]["properties"][name], value), f"{scene.name}: {section}/{name} = {value}")
        for name, wrong in (("Levers", 2.5), ("Levers", 0), ("Mass", "heavy"), ("Damper", "spring"), ("Output step", "none")):
            self.assertFalse(is_accepted(rules["Isolation"]["properties"][name], wrong), name)

    def test_a_scene_goes_through_json(self):
        scene, written = SCENES / "design-machine.prm", self.folder / "scene.json"
        written.write_text(self.convert("json", scene), encoding="utf-8")
        again = self.folder / "scene.prm"
        again.write_text(self.convert("prm", written), encoding="utf-8")
        first, second = ({name: each._replace(is_set=True) for name, each in sprag.Scene(path).parameters.items()} for path in (scene, again))
        self.assertEqual(first, second)

    def test_what_a_material_sets_is_not_written(self):
        text = str(sprag.Scene(SCENES / "own-device.prm"))
        self.assertIn("set Made of = steel", text)
        self.assertNotIn("Young's modulus", text)

    def test_dampers_are_ranked(self):
        mass, stiffness, frequency, amplitude = 0.05, 1.1, 200, 0.05
        speed, omega = 4 * math.pi * frequency * amplitude, math.sqrt(stiffness / mass)
        kick = {"motion": "shock", "frequency": frequency, "amplitude": amplitude}
        changes = {**{f"Isolation/Base {name}": value for name, value in kick.items()}, "Isolation/Duration": 3}
        dampers, (without, lever) = sprag.rank_dampers(SCENES / "isolation-ground-a.prm", changes, jobs=1)
        best = {each.damper: each for each in dampers}
        self.assertEqual([each.transmissibility for each in dampers], sorted(each.transmissibility for each in dampers))
        # A kick leaves the least acceleration where the damping ratio is 1/2: its square integrates to omega V^2 (1 + 4 zeta^2)/(4 zeta).
        self.assertAlmostEqual(best["viscous"].strength / (mass * omega), 1, delta=0.05)
        base = amplitude**2 * (2 * math.pi * frequency) ** 4 / (4 * frequency)
        self.assertAlmostEqual(best["viscous"].transmissibility / math.sqrt(omega * speed**2 / base), 1, delta=0.01)
        self.assertAlmostEqual(without.displacement / (speed / omega), 1, delta=0.01)
        self.assertLess(best["lever"].transmissibility, lever.transmissibility)
        said = sprag.tell_ranking(dampers, [without, lever])
        self.assertIn(f"The lever lets through {best['lever'].transmissibility:.3g}, {dampers[0].damper} ", said)
        # m V^2/2 goes into the spring and friction on the way to the farthest point.
        within = {each.damper: each for each in sprag.rank_dampers(SCENES / "isolation-ground-a.prm", changes, displacement=20, jobs=1)[0]}
        energy = mass * speed**2 / 2 - stiffness * 20**2 / 2
        self.assertAlmostEqual(within["constant friction"].strength / (energy / 20), 1, delta=0.03)
        self.assertAlmostEqual(within["linear friction"].strength / (2 * energy / 20**2), 1, delta=0.03)
        for each in within.values():
            self.assertAlmostEqual(each.displacement / 20, 1, delta=0.01, msg=each.damper)
        with self.assertRaisesRegex(ValueError, "Base motion must not be none"):
            sprag.rank_dampers(SCENES / "isolation-free-a.prm")

    def test_dampers_stronger_than_the_first_tries(self):
        steady_until = np.inf

        def moves_by_strength(strengths):
            return 1 / strengths + strengths / 1e6, 1 / strengths, strengths < steady_until

        strength, _, displacement, is_steady = find_strength(moves_by_strength, 1.0, 0.01)
        self.assertAlmostEqual(strength, 100, delta=5)
        self.assertLessEqual(displacement, 0.01)
        self.assertTrue(is_steady)
        self.assertAlmostEqual(find_strength(moves_by_strength, 100.0, None)[0], 1000, delta=50)
        self.assertIsNone(find_strength(moves_by_strength, 1.0, 1e-6))
        # Strengths that are not steady count where no other is.
        steady_until = 500
        self.assertLess(find_strength(moves_by_strength, 100.0, None)[0], 500)
        steady_until = 0
        self.assertFalse(find_strength(moves_by_strength, 100.0, None)[3])
        ranked = [RankedDamper("viscous", 1.0, "N s/mm", 0.9, 5.0)]
        self.assertIn("lever: none of the strengths tried serves", tell_ranking(ranked, []))

    def test_parameter_gui_opens_the_xml(self):
        # Its reader takes sections of parameters with these five elements, and numbers by their patterns.
        scene, parts = SCENES / "design-machine.prm", ["value", "default_value", "documentation", "pattern", "pattern_description"]
        root = ElementTree.fromstring(self.call(scene, "--print-parameters=xml"))
        self.assertEqual(root.tag, "ParameterHandler")
        found = {}
        for section in root:
            for parameter in section:
                self.assertEqual([part.tag for part in parameter], parts)
                value, _, _, _, pattern = (part.text or "" for part in parameter)
                for kind, read in (("[Integer", int), ("[Double", float)):
                    if pattern.startswith(kind):
                        read(value)
                found["/".join(re.sub("_(..)", lambda code: chr(int(code[1], 16)), each.tag) for each in (section, parameter))] = value
        # The scene leaves the tolerance open, and the program chooses it.
        values = {name: parameter.text for name, parameter in sprag.Scene(scene).parameters.items()}
        self.assertEqual(found, {**values, "Time/Tolerance": "auto"})
        wrong = subprocess.run([program(), scene, "--set", "Isolation/Levers=1e1", "--print-parameters=xml"], capture_output=True, text=True, check=False)
        self.assertEqual((wrong.returncode, wrong.stdout), (2, ""))
        self.assertIn("Levers", wrong.stderr)

    def call(self, *words):
        return subprocess.run([program(), *words], capture_output=True, text=True, check=True).stdout

    def convert(self, *words):
        package = {**os.environ, "PYTHONPATH": str(Path(sprag.__path__[0]).parent)}
        return subprocess.run([sys.executable, "-m", "sprag", *words], capture_output=True, text=True, check=True, env=package).stdout

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_types(self):
        user = self.folder / "user.py"
        user.write_text(USER, encoding="utf-8")
        command = ["mypy", "--check-untyped-defs", "--cache-dir", self.folder / "cache"]
        package = {**os.environ, "MYPYPATH": str(Path(sprag.__path__[0]).parent)}
        for checked, faults in ((sprag.__path__[0], 0), (user, 2)):
            done = subprocess.run([*command, checked], capture_output=True, text=True, check=False, env=package)
            self.assertEqual(done.stdout.count("error:"), faults, done.stdout)

    def test_a_temporary_folder_goes_with_its_result(self):
        result = sprag.run(SCENES / "closed-form-a.prm")
        folder = result.folder
        self.assertTrue(folder.is_dir())
        del result
        gc.collect()
        self.assertFalse(folder.exists())

    def test_face_and_fields(self):
        result = sprag.run(SCENES / "model-a.prm", COARSE, output=self.folder / "a")
        for way, sign in (("forward", 1), ("backward", -1)):
            face = result.face(40, way)
            row = np.abs(result.table["time"] - face.time).argmin()
            self.assertLess(abs(face.x - 40), 4)
            self.assertEqual(result.ways[row], sign)
            # The pressure carries P over the width of the lever.
            force = np.sum(face.pressure * result.friction_face.weight)
            self.assertAlmostEqual(force, result.table["normal_resultant"][row], delta=1e-3 * force)
            self.assertEqual(np.sign(face.traction.sum()), sign)
        self.assertEqual((face.pressure.unit, face.xi.unit), ("MPa", "mm"))
        fields = result.fields(len(result.frames) - 1)
        self.assertEqual(len(fields["nodes"]), len(fields["von_mises_stress"]))
        self.assertEqual((fields["nodes"].unit, fields["von_mises_stress"].unit), ("mm", "MPa"))
        with self.assertRaisesRegex(sprag.NotAResult, "no number 99"):
            result.fields(99)
        self.assertGreater(result.face(result.table["x"].max(), "backward").x, 60)
        with self.assertRaisesRegex(sprag.NotAResult, "x from 0 to .* mm, not 300"):
            result.face(300)
        with self.assertRaisesRegex(ValueError, "no way back; there are forward, backward"):
            result.face(30, "back")

    def test_a_sweep(self):
        result = sprag.sweep(SCENES / "closed-form-a.prm", {"Geometry/Interface offset": [20, 30], "Friction/Factor": [0.9, 1]})
        self.assertEqual(len(result.table["run"]), 4)
        one = sprag.run(SCENES / "closed-form-a.prm", {"Geometry/Interface offset": 30, "Friction/Factor": 0.9})
        chosen = (result.table["geometry_interface_offset"] == 30) & (result.table["friction_factor"] == 0.9)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            slopes = sprag.sweep(SCENES / "model-a.prm", {"Friction/Factor": [0.9, 1]}, {"Study/Type": "slope"}, progress=True)
        self.assertEqual(len(slopes.table["run"]), 2)
        self.assertRegex(printed.getvalue(), "study: 2 runs")
        self.assertAlmostEqual(result.table["loop_area"][chosen][0], one.summary["loop_area"], delta=1e-9 * one.summary["loop_area"])

    def test_errors_of_the_program(self):
        with self.assertRaises(sprag.Refused) as caught:
            sprag.run(SCENES / "closed-form-a.prm", {"Drive/Stroek": 40})
        self.assertIn("Stroke", str(caught.exception))
        # The stroke goes beyond the pivot: the analysis itself refuses or fails, and says why.
        with self.assertRaisesRegex(sprag.RunFailed, "Drive/Stroke"):
            sprag.run(SCENES / "closed-form-a.prm", {"Drive/Stroke": 1000})
        with self.assertRaisesRegex(sprag.NotAResult, "no result.h5"):
            sprag.read(self.folder)

    def test_no_face(self):
        result = sprag.run(SCENES / "closed-form-a.prm")
        with self.assertRaisesRegex(sprag.NotAResult, "no friction face"):
            result.face(10)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_pandas(self):
        result = sprag.run(SCENES / "closed-form-a.prm", output=self.folder / "a")
        frame = result.to_pandas()
        self.assertEqual((len(frame), frame.attrs["units"]["Q"], frame["x"].max()), (len(result.table["x"]), "N", 65))
