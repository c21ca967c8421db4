# SPDX-License-Identifier: GPL-3.0-only
"""Runs that ask for an accuracy: what the program chooses it runs, and a row of a study is the run by itself."""

import h5py

from runs import SOURCE, RunTest, sets, sprag

# A contact of three faces, of which a mesh twice as coarse tells thirty times the error.
SMALL = ("Geometry/Cylinder radius=20", "Geometry/Interface offset=15", "Lever/Width=10", "Lever/Length=210", "Lever/Depth=20")
THICK_LEAF = ("Leaf spring/Thickness=2.2", "Friction layer/Strength=5")
# Scene, what is asked of it, and a part of what is chosen.
ASKED = (
    ("accuracy-a", ("Accuracy/Target=0.5",), "Analysis/Model = closed form"),
    ("model-b", ("Accuracy/Target=0.05", "Analysis/Model=auto"), "Analysis/Model"),
    ("accuracy-a", ("Accuracy/Target=0.01", "Accuracy/Quantity=P"), "Analysis/Model"),
    ("accuracy-a", ("Accuracy/Target=0", "Accuracy/Budget=0.3"), "Analysis/Model"),
    ("model-a", ("Accuracy/Target=0.05", "Accuracy/Quantity=largest_lever_stress", "Drive/Stroke=30"), "Mesh/Face size"),
    ("model-a", (*SMALL, "Accuracy/Target=0.03", "Accuracy/Quantity=largest_pressure"), "Mesh/Face size"),
    ("pair-a", ("Accuracy/Target=0.02", "Analysis/Model=auto"), "Analysis/Model = finite element"),
    ("reversal-a", ("Accuracy/Target=0.1", "Analysis/Model=auto"), "Analysis/Model = beam"),
    ("reversal-a", ("Accuracy/Target=0.05", "Analysis/Model=auto"), "Analysis/Model = condensed"),
    ("pair-reversal-a", ("Accuracy/Target=0.05", "Analysis/Model=auto"), "Time/Tolerance"),
    ("stability-a", ("Accuracy/Target=0.1", "Analysis/Model=auto"), "Analysis/Model = beam"),
    ("stability-b", ("Accuracy/Target=0.1", "Analysis/Model=auto"), "Analysis/Model = condensed"),
    ("stability-a", ("Accuracy/Target=0.02", "Analysis/Model=condensed", "Stability/Roles=off", "Stability/Critical=none"), "Condensed/Modes = 10"),
    # P does not ring with the leaf's own mode, by which a beam is near; the closed form with its stiffness is not near.
    ("leaf-a", ("Analysis/Type=transient", "Drive/Start=50", "Accuracy/Target=0.02", "Analysis/Model=auto"), "Analysis/Model = condensed"),
    ("leaf-a", (*THICK_LEAF, "Accuracy/Target=0.04", "Analysis/Dimension=auto", "Analysis/Model=auto"), "Analysis/Model = finite element"),
    ("model-a", ("Accuracy/Target=0.1", "Analysis/Dimension=auto"), "Analysis/Dimension = 2"),
)
TILTED = ("Accuracy/Target=0.3", "Accuracy/Quantity=largest_pressure", "Analysis/Dimension=auto", "Cylinder/Tilt=1e-3", "Drive/Stroke=30")


class Accuracy(RunTest):
    def read(self, name):
        return h5py.File(self.folder / name / "result.h5", "r")

    def test_what_is_chosen_runs(self):
        for number, (scene, changes, chosen) in enumerate(ASKED):
            with self.subTest(scene=scene, changes=changes):
                output = self.folder / str(number)
                path = SOURCE / "params" / f"{scene}.prm"
                if number == 0:  # chooses as the run does
                    self.assertEqual(sprag(path, *sets(changes), "--validate").returncode, 0)
                self.succeeded(sprag(path, *sets((*changes, "Analysis/Warnings=error")), "--output", output))  # it warns of no choice of its own
                with self.read(str(number)) as file:
                    self.assertIn(chosen, file["meta/chosen_settings"].asstr()[()])
                listing = (output / "run.log").read_text().partition("with\n")[2].partition("\n\n")[0]
                self.assertLess(len(listing.splitlines()), 30, listing)

    def test_three_dimensions_are_chosen_where_the_plane_is_too_far_off(self):
        done = self.succeeded(sprag(SOURCE / "params/model-a.prm", *sets(TILTED), "--validate"))  # the run itself takes minutes
        self.assertIn("Analysis/Dimension = 3", done.stdout)

    def test_errors_are_off_where_a_scene_says_so(self):
        path, coarse = SOURCE / "params/model-a.prm", ("Mesh/Face size=2", "Analysis/Step=8")
        for errors in ("on", "off"):
            self.succeeded(sprag(path, *sets((*coarse, f"Output/Errors={errors}")), "--output", self.folder / errors))
        with self.read("on") as on, self.read("off") as off:
            self.assertEqual(list(on["table/P"]), list(off["table/P"]))
            self.assertTrue(on["accuracy"])
            self.assertFalse(off.get("accuracy"))
        done = sprag(path, *sets(("Output/Errors=off", "Accuracy/Target=0.01")), "--output", self.output)
        self.assertEqual(done.returncode, 2)
        self.assertIn("Output/Errors", done.stderr)

    def expect_rows_alone(self, scene, changes, name, values, count):
        study = ("Analysis/Type=study", f"Study/Vary={name} = {', '.join(values)}")
        path = SOURCE / "params" / f"{scene}.prm"
        self.succeeded(sprag(path, *sets((*changes, *study)), "--output", self.output))
        with self.read("output") as file:
            steps = list(file["table/steps"][:])
        self.assertNotEqual(steps[0], steps[1])
        value = values[1]
        self.assertEqual(sprag(path, *sets((*changes, f"{name}={value}")), "--output", self.folder / value, "--quiet").returncode, 0)
        with self.read(value) as file:
            self.assertEqual(steps[1], count(file))

    def test_rows_of_a_study_are_runs_by_themselves(self):
        self.expect_rows_alone("model-a", (), "Accuracy/Target", ("0.02", "0.1"), lambda file: file["summary/steps"][()])

    def test_rows_of_a_study_keep_their_defaults(self):
        changes = ("Analysis/Model=beam", "Study/Type=transient", "Drive/Start=60")
        self.expect_rows_alone("reversal-a", changes, "Time/Tolerance", ("2e-2", "auto"), lambda file: file["summary/steps"][()])
