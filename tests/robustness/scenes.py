# SPDX-License-Identifier: GPL-3.0-only
"""Every scene of params/ is accepted, runs on a coarse mesh, writes its columns and prints few lines, every number with its unit. Run with /usr/bin/python3; environment:
SPRAG, the program, and SPRAG_SOURCE, the sources.

    scenes.py            # runs all but twins: scenes with the analysis and the parts of another, which ReadScene finds faultless
    scenes.py --twins    # runs these"""

import re
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, RunTest, counted, sprag  # noqa: E402

SCENES = sorted((SOURCE / "params").glob("*.prm"))
# These analyses and parts occur in another scene as well.
ALIKE = {
    "accuracy-a", "coulomb-a", "design-front-machine", "isolation-ground-a", "solid-isolation-a", "neo-hookean-a", "onset-a", "pair-modal-a", "plate-a", "plate-reversal-a", "solid-frame-a", "solid-neo-hookean-a",
    "solid-plate-a", "solid-plate-reversal-a", "solid-rib-a", "solid-shaft-a", "solid-stability-a", "solid-tilted-a", "stiff-a", "study-growth-a", "study-offset-a",
    "study-pressure-a", "study-reversal-a",
}  # fmt: skip
TWINS = {
    path
    for path in SCENES
    if path.with_stem(path.stem.removesuffix("-b") + "-a") in SCENES and path.stem.endswith("-b")
    or path.stem.startswith("map-") and path.stem != "map-position-depth-a"
    or path.stem in ALIKE
}
ONLY_TWINS = "--twins" in sys.argv

# Long scenes are shortened, but still show what they are made for.
COARSE = {"Mesh/Face size": "4", "Analysis/Step": "5"}
MAP = {"Map/First points": "3", "Map/Second points": "3", "Map/Coarsest": "1", "Map/Bisections": "1"}
SHORT = {"Sprag slip/Continuation": "1", "Sprag slip/Turn": "64", "Sprag slip/Settling time": "0.02"}
STUDY = {"Study/Vary": "Mesh/Face size = 5, 6, 8; Mesh/Degree = 2", "Study/Reference": "Mesh/Face size = 4"}
SOLID_REVERSAL = {"Mesh/Elements across": "2", "Condensed/Modes": "6", "Drive/Start": "64"}
CHANGES = {
    "apparatus-a": {"Drive/Stroke": "30"},
    "neo-hookean-a": {"Drive/Stroke": "10"},
    "pair-reversal-a": {"Condensed/Modes": "6", "Drive/Start": "63"},
    "onset-a": SHORT,
    "onset-b": {**SHORT, "Sprag slip/Turn": "45"},
    **{name: STUDY for name in ("study-a", "study-b", "study-pressure-a")},
    "study-transmissibility-a": {"Study/Vary": "Isolation/Damper = lever, viscous; Isolation/Base frequency = 1, 2"},
    "study-offset-a": {"Study/Vary": "Isolation/Damper = lever, constant friction; Isolation/Initial displacement = 20, 50"},
    **{name: {"Design/Judges": "beam"} for name in ("design-a", "design-b")},
    "design-machine": {"Design/Demands": "friction ratio = 0.5 +- 0.005; largest pressure <= 0.8", "Design/Judges": "none"},
    "design-front-machine": {"Design/Front points": "3", "Design/Evaluations": "100"},
    **{name: {"Mesh/Elements across": "2", "Condensed/Modes": "6"} for name in ("solid-modal-a", "solid-stability-a")},
    **{name: {"Mesh/Elements across": "2"} for name in ("solid-a", "solid-shaft-a", "solid-tilted-a")},
    "solid-pair-a": {"Mesh/Elements across": "2", "Drive/Stroke": "20"},
    "solid-rib-a": {"Mesh/Face size": "8", "Mesh/Degree": "1"},
    "solid-plate-a": {"Mesh/Face size": "8", "Mesh/Elements across": "2"},
    "solid-frame-a": {"Mesh/Face size": "8", "Mesh/Elements across": "2"},
    "solid-neo-hookean-a": {"Mesh/Face size": "8", "Mesh/Elements across": "2", "Drive/Stroke": "10"},
    "solid-reversal-a": SOLID_REVERSAL,
    "solid-plate-reversal-a": {**SOLID_REVERSAL, "Mesh/Face size": "8"},
    "solid-isolation-a": {"Mesh/Elements across": "2", "Condensed/Modes": "6", "Isolation/Duration": "0.1"},
    "study-growth-a": {**STUDY, "Study/Vary": "Mesh/Face size = 5, 6, 8", "Condensed/Modes": "3"},
    "study-reversal-a": {
        "Study/Vary": "Mesh/Face size = 2, 3; Time/Tolerance = 1e-2",
        "Study/Reference": "Mesh/Face size = 1.5",
        "Drive/Start": "64",
        "Condensed/Modes": "3",
    },
}
GROUPS = {
    "modal": {"modes": {"frequency", "growth_rate", "kind", "xi", "across_real"}},
    "stability": {"modes": {"frequency", "growth_rate", "growth_by_friction_rotation", "energy_bending"}},
    "map": {"map": {"growth_rate_forward", "growth_rate_backward", "kind_backward", "theta_0"}},
    "sprag slip": {
        "growth": {"time", "amplitude", "predicted"},
        "continuation": {"x", "growth_rate", "kind_away", "amplitude_P_back"},
    },
}

# The most lines that scenes of each kind may print before their warnings, with a unit behind each number.
MOST_LINES = {
    "closed-form-a": 10, "fig10": 3, "contact-law-a": 6, "calibration-a": 16, "modal-a": 12, "pair-modal-a": 12, "pair-stability-a": 23, "isolation-a": 12,
    "isolation-free-a": 12, "isolation-ground-a": 12, "onset-a": 15, "map-position-depth-a": 8, "study-offset-a": 10, "reversal-a": 20,
}  # fmt: skip
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# Units, and what is counted.
UNIT = (
    r"(?:N mm/rad|N mm\^2|N/mm\^n|N/mm\^3|N/mm|N mm|N|MPa|t mm\^?2|mm/s\^2|mm/s|mm|Hz|1/s|s|rad|%)(?![\w/^])"
    r"|(?:of|more|runs|completed|failed|refused|steps|turns|stops|periods?|points|processes|values|in the grid|judged|vibrations?)\b"
)
WITH_UNIT = re.compile(rf"{NUMBER}(?:(?: to|,)? +{NUMBER})? (?:{UNIT})")
# Numbers that have none.
PURE = re.compile(
    rf"\b(?:mu =|n =|delta\^|peak|first harmonic|root mean square|transmissibility|tolerance|loss factor|[\w /]+/(?:Degree|Modes|Factor|Damping) (?:=|from)) {NUMBER}(?: \(?(?:{NUMBER} )?to {NUMBER})?"
    rf"|flutter from {NUMBER} \(|order .*|x = 0\b|of degree \d|[a-z],? \d\."
)

# The progress of a run on the standard error.
PROGRESS = re.compile(r"^(?: *\d+ % .*|(?:grid|boundaries|study|map): .*)\n", re.MULTILINE)


def numbers_without_unit(lines):
    """Lines with more numbers without a unit than the heading of their table has columns with one."""
    columns = 0
    for line in lines:
        left = re.findall(rf"(?<![\w/.^]){NUMBER}(?![\w/^])", PURE.sub("", WITH_UNIT.sub("", line)))
        if heading := re.findall(r"\[[^\]]+\]", line):
            columns = len(heading) + line.startswith("  reversal")
        elif not left:
            columns = 0 if re.search(r"\d", line) else columns
        if len(left) > columns:
            yield line

NEVER_NAN = ("time", "x", "v", "theta", "P", "F", "Q", "drive_work", "friction_work", "spring_energy")
NEVER_NAN_MESHED = NEVER_NAN + (
    "normal_resultant",
    "friction_resultant",
    "contact_width",
    "largest_pressure",
    "penetration",
    "indentation",
    "cone_violation",
    "elastic_energy",
)


def program_columns():
    """Names of the columns that every table has, in the order of src/results/columns.h."""
    text = (SOURCE / "src/results/columns.h").read_text(encoding="utf-8")
    return re.search(r"SPRAG_ENUMERATION\(Column,([^)]*)\)", text)[1].replace(",", " ").split()


def parameter(text, section, name):
    found = re.search(rf"^subsection {section}\n(?:(?!end$).*\n)*?\s*#?set {name}\s*=([^#\n]*)", text, re.MULTILINE)
    return found.group(1).strip()


def read_model(file):
    """Analysis/Model as given or as it follows from the accuracy asked for."""
    if "chosen_settings" in file["meta"]:
        return re.search("Analysis/Model = ([^;]*)", file["meta/chosen_settings"].asstr()[()])[1]
    return parameter(file["parameters"].asstr()[()], "Analysis", "Model")


class ScenesTest(RunTest):
    def check_groups(self, file, kind):
        for group, names in GROUPS.get(kind, {}).items():
            self.assertLessEqual(names, set(file[group]))
            for data in file[group].values():
                self.assertIn("unit", data.attrs)
                self.assertTrue(data.attrs["description"])

    def check_study(self, file):
        rows = len(file["table/run"])
        self.assertGreater(rows, 1)
        self.assertEqual(set(file["runs/outcome"].asstr()[:]), {"completed"})
        self.assertTrue((file["table/cpu_time"][:] > 0).all())
        if parameter(file["parameters"].asstr()[()], "Study", "Type") == "isolation":
            self.assertTrue((file["table/energy_residual"][:] < 1e-9).all())
            answer = dict(zip(file["answer/line"].asstr()[:], file["answer/text"].asstr()[:]))
            self.assertIn("least for Isolation/Damper = ", answer["largest_displacement"])
            return
        errors = [name for name in file["table"] if name.startswith("error_")]
        self.assertIn("error_all", errors)
        for name in errors:
            self.assertTrue((file["table"][name][:] > 0).all(), name)
        self.assertEqual(len(file["trade/run_all"]), 4)
        self.assertIn("all within 1 %", file["answer/line"].asstr()[:])

    def check_isolation(self, file):
        table = {name: data[:] for name, data in file["table"].items()}
        self.assertTrue({"time", "x_base", "z", "z_rate", "table_acceleration", "damper_force"} <= set(table))
        for name, values in table.items():
            self.assertTrue(np.isfinite(values).all(), name)
        self.assertTrue((np.diff(table["time"]) >= 0).all())
        text = file["parameters"].asstr()[()]
        mass, stiffness = (float(parameter(text, "Isolation", name)) for name in ("Mass", "Stiffness"))
        balance = mass * table["table_acceleration"] + stiffness * table["z"] + table["damper_force"]
        self.assertLess(np.abs(balance).max(), 1e-10 * stiffness * np.abs(table["z"]).max())
        in_time = read_model(file) != "closed form"
        self.assertTrue(in_time or (np.diff(table["dissipated_energy"]) >= -1e-9).all())
        self.assertLess(file["summary/energy_residual"][()], 1e-6 if in_time else 1e-9)

    def check_run(self, file):
        table = file["table"]
        text = file["parameters"].asstr()[()]
        places = range(1, 1 + len(parameter(text, "Friction plate", "Sensors").split(",")))
        sensors = {"sensor_sum"} | {f"sensor_{place}" for place in places}
        has_plate = parameter(text, "Friction plate", "Type") != "none"
        expected = set(program_columns()) | (sensors if has_plate else set())
        if parameter(text, "Mirrored pair", "Type") == "full":
            expected |= {name for name in table if name.endswith("_2")} | {"swing", "Q_pair", "lateral_force"}
        if parameter(text, "Analysis", "Dimension") == "3":
            expected |= {"F_across", "centre_across", "twisting_moment", "turning_moment", "largest_pressure_zeta"}
            expected |= {f"sensor_{place}_{side}" for place in places for side in ("left", "right") if has_plate}
            if {parameter(text, "Cylinder", f"{slope} stiffness") for slope in ("Tilt", "Skew")} != {"auto"}:
                expected |= {"tilt", "skew"}
            is_linear = parameter(text, "Lever", "Material") == "linear"
            if parameter(text, "Analysis", "Type") == "quasi-static" and is_linear:
                self.assertLess(file["meta/compliance_error"][()], 5e-3)
        self.assertEqual(set(table), expected)
        if has_plate:
            self.assertTrue(np.isfinite(table["sensor_sum"][:]).all())
        meshed = read_model(file) == "finite element"
        for name in NEVER_NAN_MESHED if meshed else NEVER_NAN:
            self.assertTrue(np.isfinite(table[name][:]).all(), name)
        if meshed:
            self.assertTrue((table["iterations"][1:] >= 1).all())
        self.assertEqual(table["time"][0], 0)
        self.assertEqual(table["x"][:].max(), float(parameter(text, "Drive", "Stroke")))
        self.assertAlmostEqual(table["x"][-1], float(parameter(text, "Drive", "Start")), places=9)
        theta = table["theta"][:]
        resultant = table["P"][:] * np.sin(theta) + table["F"][:] * np.cos(theta)
        # A step in time leaves out a last correction by up to 1e-8 of the overlap, here 1e-2 mm at most: over the 100 mm to the
        # pivot theta is off by 1e-12, from which Q is found to be another by 1e-12 of the largest force.
        limit = 1e-11 if parameter(text, "Analysis", "Type") == "transient" else 1e-12
        self.assertLess(np.abs(table["Q"][:] - resultant).max(), limit * np.abs(resultant).max())
        self.assertGreater(table["Q"][:].max(), 0)
        self.assertLess(table["Q"][:].min(), 0)
        self.assertEqual("face" in file, meshed or read_model(file) == "condensed")

    def check(self, file):
        kind = parameter(file["parameters"].asstr()[()], "Analysis", "Type")
        checks = {
            "study": self.check_study,
            "isolation": self.check_isolation,
            "quasi-static": self.check_run,
            "transient": self.check_run,
        }
        checks.get(kind, lambda each: self.check_groups(each, kind))(file)
        written = sorted(Path(file.filename).parent.glob("*.prm"))
        self.assertTrue(written or kind not in ("calibration", "design", "identification"))
        for scene in written:
            self.assertEqual(sprag(scene, "--validate").returncode, 0, scene)

    def check_fields(self, file, output):
        """Checks the files of the fields; modes are a frame each."""
        modes = "modes" in file and read_model(file) == "condensed"
        self.assertEqual((output / "fields.xdmf").is_file(), "face" in file)
        self.assertEqual(len(list(output.glob("mode-*.xdmf"))), len(file["modes/frequency"]) if modes else 0)

    def check_printed(self, scene, text):
        lines = re.split(r"\n\s*(?:Warning:|Lines for|Scenes:)", text)[0].splitlines()
        if scene in MOST_LINES:
            self.assertTrue(0 < len(lines) <= MOST_LINES[scene], text)
            self.assertEqual(list(numbers_without_unit(lines)), [])
        self.assertNotRegex(text, r"\bnan\b|\binf\b")

    def test_all_run(self):
        for scene in sorted(TWINS if ONLY_TWINS else set(SCENES) - TWINS):
            with self.subTest(scene=scene.stem):
                output = self.output / scene.stem
                changes = MAP if scene.stem.startswith("map-") else CHANGES.get(scene.stem, {})
                options = []
                for name, value in {**COARSE, **changes}.items():
                    options += ["--set", f"{name}={value}"]
                done = sprag(scene, *options, "--output", output)
                self.assertEqual((done.returncode, PROGRESS.sub("", done.stderr)), (0, ""))
                self.check_printed(scene.stem, done.stdout)
                with h5py.File(output / "result.h5", "r") as file:
                    for data in file["table"].values():
                        self.assertIn("unit", data.attrs)
                        self.assertTrue(data.attrs["description"])
                    for name, data in file["summary"].items():
                        self.assertTrue(data.attrs.get("description"), name)
                    self.assertEqual(file["summary/status"].asstr()[()], "completed")
                    self.assertIn("cpu_time", file["meta"])
                    names = re.findall(r"^Warning: (\w+)$", done.stdout, re.MULTILINE)
                    self.assertEqual(done.stdout.splitlines()[-1], "completed, " + counted(names))
                    self.assertEqual(sorted(file["warnings"]), sorted(names))
                    self.check(file)
                    self.check_fields(file, output)

    def test_modes_without_fields(self):
        scene = SOURCE / "params" / "modal-a.prm"
        options = ("--set", "Mesh/Face size=4", "--set", "Output/Fields=none", "--output", self.output, "--quiet")
        self.assertEqual(sprag(scene, *options).returncode, 0)
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), ["result.h5", "run.log"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(["ScenesTest.test_all_run"] if ONLY_TWINS else sys.argv[1:])])
