# SPDX-License-Identifier: GPL-3.0-only
"""Each warning is provoked by a command line, printed, stored and counted; the table of warnings in params/warnings.md is that of the
program. Run with /usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the sources."""

import re
import sys
import unittest
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, RunTest, counted, run_scene  # noqa: E402

FORWARD = ("Drive/Cycles=0.5", "Output/Fields=none", "Analysis/Step=2")
BEAM = ("Analysis/Model=beam", "Stability/Critical=none", "Stability/Roles=off")
RISING = ("Friction/Law=Stribeck", "Friction/Static coefficient=0.4", "Friction/Kinetic coefficient=0.4", "Friction/Viscous coefficient=0.004")
FALLING = ("Friction/Law=Stribeck", "Friction/Stribeck speed=10", "Drive/Speed=10")
COARSE = ("Drive/Cycles=0.5", "Output/Fields=none", "Analysis/Step=13")
OTHER_DEVICE = ("Geometry/Cylinder radius=50", "Geometry/Pivot distance=180")

# The provoked warnings: scene, options, warnings in the order of the program.
PROVOKED = {
    "leaf of 5 mm": ("leaf-a", (*COARSE, "Leaf spring/Thickness=5"), ["large_strain", "pressure_beyond_strength", "long_steps"]),
    "leaf of 8 mm": ("leaf-a", ("Analysis/Model=closed form", "Leaf spring/Thickness=8"), ["leaf_beyond_yield", "pressure_beyond_strength"]),
    "own mesh": ("model-a", (*COARSE, "Mesh/File=../meshes/lever.geo"), ["coarse_contact", "long_steps"]),
    "crushed cork under a beam": ("reversal-a", ("Friction layer/Strength=0.1",), ["pressure_beyond_strength"]),
    "near locking": ("closed-form-a", ("Friction/Law=Coulomb", "Friction/Coefficient=2.62"), ["near_locking", "pressure_beyond_strength"]),
    "pulled sensor": ("plate-a", ("Mesh/Face size=4", "Analysis/Step=2", "Output/Fields=none"), ["coarse_contact", "sensor_in_tension"]),
    "ranges that a beam does not have": ("stability-a", ("Analysis/Model=beam", "Stability/Ranges=Contact/Penalty 100 1000; Friction/Factor 0.8 1.2", "Stability/Critical=Mesh/Face size 0.5 1", "Stability/Roles=off"), ["without_effect"]),
    "map of beams without modal damping": ("map-friction-depth-a", ("Lever/Modal damping=0", "Map/First points=2", "Map/Second points=2", "Map/Coarsest=1", "Map/Bisections=0"), ["beyond_the_beam"]),
    "layer under a beam": ("stability-a", (*BEAM, "Friction layer/Young's modulus=40"), ["foreign_contact_law"]),
    "falling friction of a beam": ("stability-a", (*BEAM, *FALLING), []),
    "friction that rises close to locking": ("stability-a", (*BEAM, *RISING, "Lever/Depth=8", "Stability/Position=60", "Stability/Direction=backward", "Drive/Speed=640"), ["locks", "large_deflection", "large_strain", "pressure_beyond_strength", "path_dependent_slide"]),
    "friction that falls at once": ("stability-a", (*BEAM, *FALLING, "Friction/Memory length=1e-3"), ["runaway_slip"]),
    "friction that falls at once, in time": ("stribeck-a", ("Support/Type=rigid", "Drive/Start=53", "Friction/Memory length=1e-4"), ["runaway_slip"]),
    "slides of a harmonic drive": ("stability-a", (*BEAM, "Drive/Profile=harmonic", "Stability/Position=auto"), ["largest_speed_alone"]),
    "table beyond the stroke": ("design-machine", ("Design/Judges=none", "Drive/Stroke=8", "Design/Demands=friction ratio = 0.5 +- 0.005; relative amplitude <= 100; jamming margin >= 0.5"), ["table_beyond_stroke"]),
    "target of a drive that does not turn": ("reversal-a", ("Analysis/Model=rigid", "Drive/Start=64", "Drive/Cycles=0.5", "Accuracy/Target=0.01"), ["target_missed"]),
}

# Numbers, places and names of the run in the texts of a warning.
NUMBERS = {
    "defaults_of_model_a": 2, "foreign_contact_law": 5, "judged_another_lever": 2, "mu_of_one_speed": 6, "table_beyond_stroke": 2, "absent_part": 1, "near_locking": 6, "leaf_beyond_yield": 7, "locks": 4, "beyond_the_beam": 3, "plane_stress_of_layer": 5, "contact_between_points": 5,
    "implausible_values": 1, "unused_columns": 1, "shaking_drive": 3, "drifting_record": 2, "sensor_in_tension": 2, "runaway_slip": 3, "path_dependent_slide": 3, "largest_speed_alone": 1, "without_effect": 1,
    "speed_beyond_table": 3, "overlap_of_layer": 4, "soft_penalty": 4, "coarse_contact": 3, "stiff_penalty": 6, "soft_tangential_penalty": 5, "large_deflection": 4,
    "far_from_closed_form": 2, "large_strain": 4, "pressure_beyond_strength": 5, "long_steps": 3, "target_missed": 2, "hidden_vibration": 7, "no_steady_state": 2, "runs_with_warnings": 3,
    "element_passing": 4, "indistinct_unknowns": 1, "model_does_not_follow": 1, "not_converged": 1,
}  # fmt: skip

# The same for rows of a study of model A, which needs one start for all.
ROWS = {
    "penalty of 1e-3": (("Contact/Penalty=1e-3",), ["overlap_of_layer", "soft_penalty", "soft_tangential_penalty", "far_from_closed_form"]),
    "lever of 1 mm": (("Lever/Depth=1",), ["coarse_contact", "large_deflection", "far_from_closed_form"]),
    "incompressible in plane stress": (("Friction layer/Poisson's ratio=0.49", "Friction layer/Plane=stress"), ["plane_stress_of_layer"]),
    "coarse contact": (("Mesh/Face size=2",), ["coarse_contact"]),
    "other device": (OTHER_DEVICE, ["defaults_of_model_a", "coarse_contact"]),
    "stiff penalty": (("Mesh/Faces in contact=0", "Contact/Penalty=1e4"), ["stiff_penalty"]),
    "e almost R": (("Geometry/Interface offset=55.999999",), ["contact_between_points", "soft_penalty", "coarse_contact", "far_from_closed_form"]),
    "one step": (("Analysis/Step=65",), ["long_steps"]),
    "none": ((), []),
}
# Values of model A for rows that do not change them.
MODEL_A = {
    "Contact/Penalty": "auto", "Lever/Depth": "20", "Friction layer/Poisson's ratio": "0", "Friction layer/Plane": "strain", "Mesh/Face size": "auto", "Geometry/Cylinder radius": "56",
    "Geometry/Pivot distance": "185.5", "Mesh/Faces in contact": "auto", "Geometry/Interface offset": "45.6", "Analysis/Step": "2",
}  # fmt: skip

IN_TIME = ("Analysis/Model=condensed",)
PENALTY = ("Contact/Enforcement=penalty", "Contact/Penalty=200")
NEO_HOOKEAN = ("Lever/Material=neo-Hookean", "Analysis/Plane=strain")
IDENTIFIED = "mu, k, e, th0"
# {warning: (a scene that may meet it, what it advises there)}, each naming all parameters of the remedy.
ADVISED = {
    "defaults_of_model_a": ("model-a", OTHER_DEVICE, [("Analysis/Type=contact law",), ("Lever/Inertia=as built",)]),
    "foreign_contact_law": ("stability-a", BEAM, [("Analysis/Type=contact law",), ("Contact/Stiffness=2e4", "Contact/Exponent=1.4"), ("Analysis/Model=condensed",)]),
    "judged_another_lever": ("isolation-a", (), [("Analysis/Type=isolation",)]),
    "mu_of_one_speed": ("design-machine", (), [("Drive/Speed=20",), ("Design/Tolerances=Friction/Factor = 0.7 ... 1",)]),
    "table_beyond_stroke": ("design-machine", (), [("Drive/Stroke=12",)]),
    "near_locking": ("closed-form-a", PROVOKED["near locking"][1], [("Drive/Stroke=50",), ("Friction/Factor=0.8",)]),
    "leaf_beyond_yield": ("leaf-a", ("Leaf spring/Thickness=8",), [("Analysis/Type=calibration",)]),
    "locks": ("model-a", ("Friction/Law=Coulomb", "Friction/Coefficient=2.64"), [("Geometry/Interface offset=40",), ("Drive/Stroke=50",)]),
    "beyond_the_beam": ("stability-a", BEAM, [("Lever/Modal damping=0.01",), ("Analysis/Model=condensed",)]),
    "plane_stress_of_layer": ("model-a", ROWS["incompressible in plane stress"][0], [("Friction layer/Plane=strain",)]),
    "contact_between_points": ("model-a", ROWS["e almost R"][0], [("Mesh/Face size=0.2",), ("Geometry/Interface offset=50",), ("Drive/Stroke=80",), ("Analysis/Model=closed form",)]),
    "shaking_drive": ("reversal-a", ("Drive/Profile=table", "Drive/Table=identification-a.csv", "Drive/Start=0"), [("Drive/Smoothing=0.01",)]),
    "drifting_record": ("isolation-a", (), [("Isolation/Drift correction=on",)]),
    "path_dependent_slide": ("stability-a", (*BEAM, *RISING), [("Analysis/Type=transient",), ("Drive/Speed=50",)]),
    "runaway_slip": ("stability-a", (*BEAM, *FALLING), [("Friction/Memory length=0.1",)]),
    "largest_speed_alone": ("stability-a", (*BEAM, "Stability/Position=auto"), [("Drive/Profile=triangle", "Stability/Ranges=Drive/Speed 50 112")]),
    "overlap_of_layer": ("model-a", PENALTY, [("Contact/Penalty=auto",), ("Contact/Penalty=2000",)]),
    "soft_penalty": ("model-a", PENALTY, [("Contact/Penalty=auto",), ("Contact/Penalty=2000",)]),
    "coarse_contact": ("reversal-a", (*IN_TIME, "Mesh/Degree=1"), [("Mesh/Face size=0.3",), ("Mesh/Degree=2",)]),
    "stiff_penalty": ("model-a", PENALTY, [("Contact/Penalty=auto",), ("Mesh/Degree=2", "Mesh/Face size=0.3")]),
    "soft_tangential_penalty": ("model-a", (), [("Contact/Tangential penalty=auto",), ("Contact/Tangential penalty=1e4",)]),
    "large_deflection": ("model-a", ROWS["lever of 1 mm"][0], [NEO_HOOKEAN]),
    "far_from_closed_form": ("model-a", (), [("Mesh/File=../meshes/lever.geo",)]),
    "large_strain": ("model-a", (), [NEO_HOOKEAN]),
    "pressure_beyond_strength": ("reversal-a", (), [("Friction layer/Strength=2",)]),
    "long_steps": ("model-a", ROWS["one step"][0], [("Analysis/Step=16",), ("Mesh/Face size=0.3",)]),
    "hidden_vibration": ("reversal-a", (), [(), ("Time/Step=1e-5",)]),
    "no_steady_state": ("isolation-ground-a", (), [("Isolation/Duration=20",)]),
    "element_passing": ("reversal-a", (*IN_TIME, "Mesh/Degree=1"), [("Mesh/Degree=2",), ("Mesh/Face size=0.3",), ("Contact/Penalty=auto",)]),
    "indistinct_unknowns": ("identification-a", (), [(f"Identification/Unknowns={IDENTIFIED}",)]),
    "model_does_not_follow": ("identification-a", (), [("Geometry/Cylinder radius=57", f"Identification/Unknowns={IDENTIFIED}")]),
    "long_vibration": ("identification-a", (), [("Identification/Reversal window=6",)]),
}  # fmt: skip
# Advice of told errors, in src/estimate and of limit cycles: scene, what it has, advice.
IMPROVED = (
    ("model-a", ("Mesh/Face size=1",), [("Mesh/Face size=0.5",), ("Mesh/Degree=2",), ("Analysis/Step=0.7",)]),
    ("model-a", PENALTY, [("Contact/Penalty=400",), ("Contact/Enforcement=augmented Lagrangian",)]),
    ("model-a", ("Contact/Tangential penalty=1000",), [("Contact/Tangential penalty=2000",), ("Contact/Tangential penalty=auto",)]),
    ("model-a", ("Mesh/File=../meshes/lever.geo",), [()]),
    ("reversal-a", (*IN_TIME, "Contact/Penalty=200"), [("Contact/Penalty=400",), ("Condensed/Modes=40",), ("Mesh/Face size=0.25",), ("Time/Tolerance=1e-3",), ("Time/Step=1e-5",)]),
    ("stability-a", IN_TIME, [("Condensed/Modes=40",), ("Mesh/Face size=0.25",), ("Mesh/Degree=2",)]),
    ("sprag-slip-a", (), [("Sprag slip/Steps per period=400",)]),
)  # fmt: skip


class WarnedRunsTest(RunTest):
    def stored(self, output=None):
        with h5py.File((output or self.output) / "result.h5", "r") as file:
            group = file["warnings"]
            return {name: (data.asstr()[()], data.attrs["effect"], data.attrs["remedy"]) for name, data in group.items()}

    def test_each_is_printed_stored_and_counted(self):
        for case, (scene, options, names) in PROVOKED.items():
            with self.subTest(case=case):
                output = self.output / case.replace(" ", "-")
                done = run_scene(scene, options, "--output", output)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(re.findall(r"^Warning: (\w+)$", done.stdout, re.MULTILINE), names)
                self.assertEqual(done.stdout.splitlines()[-1], "completed, " + counted(names))
                stored = self.stored(output)
                self.assertEqual(sorted(stored), sorted(names))
                words = " ".join(done.stdout.split())
                for texts in stored.values():
                    for text in texts:
                        self.assertIn(text, words)
                        self.assertRegex(text, r"^[A-Z].*\.$")

    def test_each_is_told_of_a_row(self):
        changes = [dict(option.split("=") for option in options) for options, _ in ROWS.values()]
        vary = "; ".join(f"{name} = {', '.join(row.get(name, usual) for row in changes)}" for name, usual in MODEL_A.items())
        done = run_scene("model-a", (*FORWARD, "Analysis/Type=study", "Study/Combine=list", f"Study/Vary={vary}"), "--output", self.output, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with h5py.File(self.output / "result.h5", "r") as file:
            found = file["runs/warnings"].asstr()[:]
        self.assertEqual(dict(zip(ROWS, found)), {case: ", ".join(names) for case, (_, names) in ROWS.items()})

    def test_error_fails_the_run_after_everything_is_written(self):
        scene, options, names = PROVOKED["near locking"]
        done = run_scene(scene, (*options, "Analysis/Warnings=error"), "--output", self.output)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.splitlines()[-1], "completed, " + counted(names))
        self.assertRegex(done.stderr.splitlines()[-1], r"^sprag: Analysis/Warnings = error: 2 warnings: near_locking, pressure_beyond_strength. The first says: \w")
        self.assertEqual(list(self.stored()), names)
        with h5py.File(self.output / "result.h5", "r") as file:
            self.assertEqual(file["summary/status"].asstr()[()], "completed")
        self.assertEqual(run_scene("closed-form-a", ("Analysis/Warnings=error",), "--output", self.output, "--overwrite").returncode, 0)

    def test_quiet_prints_none_and_stores_them(self):
        scene, options, names = PROVOKED["near locking"]
        done = run_scene(scene, options, "--output", self.output, "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(list(self.stored()), names)

    def test_validate_prints_those_of_the_scene(self):
        for scene, options, name in (("closed-form-a", PROVOKED["near locking"][1], "near_locking"), ("model-a", OTHER_DEVICE, "defaults_of_model_a")):
            done = run_scene(scene, options, "--validate")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(done.stdout.endswith(f"{scene}.prm: valid, {counted([name])}\n"), done.stdout)
            self.assertEqual(run_scene(scene, (*options, "Analysis/Warnings=error"), "--validate").returncode, 1)
        self.assertFalse(self.output.exists())

    def test_a_failed_run_tells_them_too(self):
        options = ("Friction layer/Strength=0.01", "Analysis/Maximum deviation=1e-9", "Mesh/Face size=2", *COARSE)
        done = run_scene("model-a", options, "--output", self.output)
        self.assertEqual(done.returncode, 1)
        self.assertIn("Maximum deviation", done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], "failed, 3 warnings: coarse_contact, pressure_beyond_strength, long_steps")

    def test_the_table_is_that_of_the_program(self):
        text = (SOURCE / "params/warnings.md").read_text(encoding="utf-8")
        table = re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE)
        self.assertEqual(len(table), len(set(table)))
        program = set()
        for path in (SOURCE / "src").rglob("*.cc"):
            program |= set(re.findall(r'make_warning\(\s*"(\w+)"', path.read_text(encoding="utf-8")))
        self.assertEqual(set(table), program)
        # Rows whose texts hold numbers of the run: as many as the program gives them.
        rows = {name: line.split("|", 3)[3].count("*") for name, line in re.findall(r"^(?=\| `(\w+)` \|)(.*)$", text, re.MULTILINE)}
        self.assertEqual({name: count for name, count in rows.items() if count}, NUMBERS)
        self.assertLessEqual({name for *_, names in (*PROVOKED.values(), *ROWS.values()) for name in names}, program)

    def expect_valid(self, scene, has, changes):
        with self.subTest(scene=scene, changes=changes):
            done = run_scene(scene, (*has, *changes), "--validate")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_advice_of_each_is_a_scene(self):
        text = (SOURCE / "params/warnings.md").read_text(encoding="utf-8")
        for name, remedy in re.findall(r"^\| `(\w+)` \|.*\|([^|]*)\|$", text, re.MULTILINE):
            scene, has, advice = ADVISED.get(name, ("", (), []))
            named = set(re.findall(r"`([A-Z][\w ]*/[A-Z][\w ]*?)(?: =[^`]*)?`", remedy))
            self.assertEqual(named - {change.partition("=")[0] for changes in advice for change in changes}, set(), name)
            for changes in advice:
                self.expect_valid(scene, has, changes)

    def test_advice_of_errors_is_a_scene(self):
        paths = (*(SOURCE / "src/estimate").glob("*accuracy.cc"), SOURCE / "src/estimate/coarser_scene.cc", SOURCE / "src/analysis/limit_cycle/limit_cycle.cc")
        texts = [text for path in paths for text in re.findall(r'"[^"\n]*\b(?:Try|Give)\b[^"\n]*"', path.read_text(encoding="utf-8"))]
        named = {name for text in texts for name in re.findall(r"[A-Z][a-z]+(?: [a-z]+)?/[A-Z][a-z]+(?: (?:size|penalty|per period))?", text)}
        tried = {change.partition("=")[0] for _, has, advice in IMPROVED for changes in (has, *advice) for change in changes}
        self.assertGreater(len(named), 8)
        self.assertEqual(named - tried, set())
        for scene, has, advice in IMPROVED:
            for changes in advice:
                self.expect_valid(scene, has, changes)


if __name__ == "__main__":
    unittest.main()
