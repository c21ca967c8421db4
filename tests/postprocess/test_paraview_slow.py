# SPDX-License-Identifier: GPL-3.0-only
"""Fields of short runs reopened in ParaView's own Python: where the parts stand, times and ranges of values.

Run with /usr/bin/python3, which starts pvpython on this file once; environment: SPRAG, the program, and SPRAG_SOURCE, the sources.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

SOURCE = Path(os.environ.get("SPRAG_SOURCE", Path(__file__).resolve().parents[2]))
SPRAG = os.environ.get("SPRAG", str(SOURCE / "build" / "sprag"))

RADIUS, OFFSET, DISTANCE, STIFFNESS = 56.0, 45.6, 185.5, 7.4e4  # of model A
WIDTH = 40.0  # of its lever
THETA_0 = np.arcsin((RADIUS - OFFSET) / DISTANCE)
DEFAULTS = ("Mesh/Face size=2", "Analysis/Step=5", "Drive/Stroke=40")
RUNS = {
    "lever": ("Output/Fields=interval", "Output/Field interval=2"),
    "pair": ("Output/Fields=turning points", "Mirrored pair/Type=full", "Rotational spring/Type=leaf", "Leaf spring/Thickness=1.3914"),
    "mode": ("Analysis/Type=stability", "Analysis/Model=condensed", "Condensed/Modes=8", "Condensed/Cache=cache", "Lever/Depth=6",
             "Stability/Position=40", "Stability/Direction=backward", "Stability/Modes=2", "Stability/Roles=off"),
    "solid": ("Analysis/Dimension=3", "Mesh/Faces in contact=0", "Mesh/Elements across=3", "Cylinder/Tilt=1e-3", "Cylinder/Skew=2e-3",
              "Cylinder/Length=30", "Cylinder/Position=4", "Output/Fields=interval"),
    "reversal": ("Analysis/Dimension=3", "Mesh/Faces in contact=0", "Mesh/Elements across=2", "Cylinder/Tilt=1e-3",
                 "Analysis/Type=transient", "Analysis/Model=condensed", "Condensed/Modes=6", "Drive/Start=38"),
    "half": ("Analysis/Dimension=3", "Mesh/Faces in contact=0", "Mesh/Elements across=2", "Drive/Cycles=0.5"),
}  # fmt: skip
LEVER, LAYER, HUB, LEAF = 1, 2, 3, 7
FIRST_READER, SECOND_READER = "XDMFReader", "Xdmf3ReaderT"  # "Xdmf3 Reader S" joins both grids and drops what one lacks


def look(folder):
    """In pvpython: everything ParaView reads of a run, as an archive of numpy."""
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy

    for path in sorted(folder.glob("*.xdmf")):
        for name in (FIRST_READER, SECOND_READER):
            reader = simple.XDMFReader(FileNames=[str(path)]) if name == FIRST_READER else simple.Xdmf3ReaderT(FileName=[str(path)])
            arrays = {"times": np.atleast_1d(reader.TimestepValues)}
            for number, time in enumerate(arrays["times"]):
                simple.UpdatePipeline(float(time), reader)
                data = servermanager.Fetch(reader)
                while data.IsA("vtkCompositeDataSet"):
                    data = data.GetBlock(data.GetNumberOfBlocks() - 1)  # rigid parts come first
                arrays[f"{number} points"] = np.array(vtk_to_numpy(data.GetPoints().GetData()))
                arrays[f"{number} cells"] = np.array(data.GetNumberOfCells())
                for values in (data.GetPointData(), data.GetFieldData()):
                    for index in range(values.GetNumberOfArrays()):
                        arrays[f"{number} {values.GetArrayName(index)}"] = np.array(vtk_to_numpy(values.GetArray(index)))
            np.savez(path.with_name(f"{path.stem}-{name}.npz"), **arrays)
            simple.Delete(reader)


class Seen:
    """An index as a reader shows it."""

    def __init__(self, folder, index, reader=FIRST_READER):
        self.arrays = np.load(folder / f"{index}-{reader}.npz")
        self.times = self.arrays["times"]

    def values_at(self, number, name):
        return self.arrays[f"{number} {name}"]

    def now(self, number):
        """Returns the points that a user finds on opening the file."""
        return self.values_at(number, "points")[:, :2]

    def rest(self, number=0):
        return self.rest_in_space(number)[:, :2]

    def rest_in_space(self, number):
        return self.values_at(number, "points") - self.values_at(number, "displacement [mm]")


def turned(points, pivot, theta, side=1):
    """Returns the points of a rigid lever, known at rest, at the inclination theta."""
    def axes(angle):
        return np.array(((-np.cos(angle), side * np.sin(angle)), (np.sin(angle), side * np.cos(angle))))

    return pivot + (points - pivot) @ axes(THETA_0).T @ axes(theta)


def from_axis(points, middle, axis):
    """Distances along and across a cylinder's axis."""
    along = (points - middle) @ axis
    return along, np.linalg.norm(points - middle - along[:, None] * axis, axis=1)


class ParaViewTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # h5py and ParaView have a library each of HDF5: they must not meet in one process.
        import h5py

        cls.h5py = h5py
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        (cls.folder / "empty.prm").write_text("")
        for name, changes in RUNS.items():
            options = [word for change in DEFAULTS + changes for word in ("--set", change)]
            command = [SPRAG, cls.folder / "empty.prm", *options, "--output", cls.folder / name, "--quiet"]
            subprocess.run(command, check=True, timeout=120)
        if shutil.which("pvpython") is None:
            raise RuntimeError("pvpython is missing; ./test installs it (packages.txt)")
        command = ["pvpython", __file__, "--look", *(cls.folder / name for name in RUNS)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=240)
        if done.returncode != 0 or "rror" in done.stderr:
            raise RuntimeError(f"pvpython: {done.stdout[-2000:]}{done.stderr[-2000:]}")

    def result(self, name):
        file = self.h5py.File(self.folder / name / "result.h5")
        self.addCleanup(file.close)
        return file

    def rows(self, name, seen):
        """Returns a row of the table for each frame."""
        table = {column: values[:] for column, values in self.result(name)["table"].items()}
        at = [int(np.flatnonzero(table["time"] == time)[0]) for time in seen.times]
        self.assertTrue((np.diff(seen.times) > 0).all())
        return [{column: values[row] for column, values in table.items()} for row in at]

    def test_both_readers_show_the_same(self):
        for path in sorted(self.folder.glob("*/*.xdmf")):
            first, second = (Seen(path.parent, path.stem, reader) for reader in (FIRST_READER, SECOND_READER))
            self.assertEqual(sorted(first.arrays.files), sorted(second.arrays.files), path)
            for name in first.arrays.files:
                np.testing.assert_allclose(first.arrays[name], second.arrays[name], rtol=1e-6, atol=1e-9, err_msg=f"{path} {name}")

    def test_lever_turns_on_its_pivot_and_the_cylinder_is_at_x(self):
        seen = Seen(self.folder / "lever", "fields")
        for number, row in enumerate(self.rows("lever", seen)):
            part, lever, now = seen.values_at(number, "part"), seen.values_at(number, "lever"), seen.now(number)
            rim = now[lever == 0][1:]
            np.testing.assert_allclose(now[lever == 0][0], (row["x"], 0), atol=1e-5)
            np.testing.assert_allclose(np.hypot(*(rim - (row["x"], 0)).T), RADIUS, atol=1e-4)
            elastic = seen.values_at(number, "elastic_displacement [mm]")[:, :2]
            body = lever == 1
            rigid = turned(seen.rest()[body], (DISTANCE, 0), row["theta"])
            np.testing.assert_allclose(now[body] - elastic[body], rigid, atol=1e-4)
            self.assertEqual(set(part[body]), {LEVER, LAYER, HUB})
            self.assertLess(np.abs(elastic).max(), 0.5)

    def test_bodies_touch_where_they_press(self):
        seen = Seen(self.folder / "lever", "face")
        file = self.result("lever")
        for number, row in enumerate(self.rows("lever", seen)):
            pressure = seen.values_at(number, "pressure [MPa]")
            written = file["face/pressure"][int(np.flatnonzero(file["face/time"][:] == row["time"])[0])]
            np.testing.assert_allclose(pressure, written, rtol=1e-6)
            if not row["P"] > 1:
                continue
            away = np.hypot(*(seen.now(number) - (row["x"], 0)).T) - RADIUS
            self.assertAlmostEqual(away.min(), -row["penetration"], delta=1e-4)
            self.assertLess(np.abs(away[pressure > 0]).max(), 2 * row["penetration"] + 1e-4)
            traction = seen.values_at(number, "traction [MPa]")[:, :2]
            force = (0.5 * (traction[1:] + traction[:-1]) * np.hypot(*np.diff(seen.rest(number), axis=0).T)[:, None]).sum(axis=0)
            self.assertAlmostEqual(40 * force[0], row["Q"], delta=0.02 * abs(row["Q"]))

    def test_stress_of_frames_is_the_peak_told(self):
        table = self.result("lever")["table"]
        for name in ("P", "x"):
            self.assertIn(table["time"][int(np.argmax(table[name][:]))], Seen(self.folder / "lever", "fields").times)
        seen = Seen(self.folder / "lever", "fields")
        largest = self.result("lever")["summary/largest_layer_stress"][()]
        layer = max(seen.values_at(i, "von_mises_stress [MPa]")[seen.values_at(i, "part") == LAYER].max() for i in range(len(seen.times)))
        self.assertAlmostEqual(layer, largest, delta=1e-2 * layer)
        whole = [number for number in range(len(seen.times)) if f"{number} stress [MPa]" in seen.arrays]
        self.assertGreaterEqual(len(whole), 3)  # frames of intervals have von Mises' stress alone
        for number in whole:
            s = seen.values_at(number, "stress [MPa]").reshape(-1, 3, 3)
            np.testing.assert_allclose(s, s.transpose(0, 2, 1))
            deviator = s - np.trace(s, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
            mises = np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2)))
            np.testing.assert_allclose(mises, seen.values_at(number, "von_mises_stress [MPa]"), rtol=1e-4, atol=1e-5)

    def test_default_frames_are_the_turn_the_state_behind_it_and_the_largest_force(self):
        table = {name: values[:] for name, values in self.result("pair")["table"].items()}
        rows = self.rows("pair", Seen(self.folder / "pair", "fields"))
        turn = table["time"][table["x"].argmax()]
        self.assertEqual(rows[0]["time"], turn)
        self.assertGreater(rows[0]["Q"], 0)
        self.assertTrue(any(row["friction_resultant"] <= -0.99 * row["mu"] * row["normal_resultant"] for row in rows[1:]))
        self.assertIn(np.maximum(table["P"], table["P_2"]).max(), [max(row["P"], row["P_2"]) for row in rows])
        self.assertTrue(all(row["P"] > 1 for row in rows))

    def test_second_lever_is_the_mirror_image_and_leaf_springs_hang_on_the_hubs(self):
        seen = Seen(self.folder / "pair", "fields")
        for number, row in enumerate(self.rows("pair", seen)):
            lever, part, now = seen.values_at(number, "lever"), seen.values_at(number, "part"), seen.now(number)
            mirrored = now[lever == 1] * (1, -1)
            np.testing.assert_allclose(now[lever == 2], mirrored, atol=2e-4)
            self.assertGreater(now[(lever == 1) & (part == LAYER)][:, 1].min(), 0)
            stress = seen.values_at(number, "von_mises_stress [MPa]")
            np.testing.assert_allclose(stress[lever == 1], stress[lever == 2], rtol=1e-2, atol=1e-2)
            leaf = (part == LEAF) & (lever == 1)
            from_pivot = np.hypot(*(seen.rest()[leaf] - (DISTANCE, 0)).T)
            clamped = from_pivot < 0.71  # half the thickness
            np.testing.assert_allclose(
                now[leaf][clamped], turned(seen.rest()[leaf][clamped], (DISTANCE, 0), row["theta"]), atol=1e-3
            )

    def test_solid_lever_turns_on_its_pivot_before_a_cylinder_out_of_true(self):
        seen = Seen(self.folder / "solid", "fields")
        axis = np.array((2e-3, 1e-3, 1)) / np.linalg.norm((2e-3, 1e-3, 1))
        for number, row in enumerate(self.rows("solid", seen)):
            part, lever = seen.values_at(number, "part"), seen.values_at(number, "lever")
            points, elastic = seen.rest_in_space(number), seen.values_at(number, "elastic_displacement [mm]")
            now = seen.values_at(number, "points")
            body = lever == 1
            self.assertEqual(set(part[body]), {LEVER, LAYER, HUB})
            self.assertAlmostEqual(np.ptp(points[body, 2]), WIDTH)
            rigid = np.column_stack((turned(points[body, :2], (DISTANCE, 0), row["theta"]), points[body, 2]))
            np.testing.assert_allclose(now[body] - elastic[body], rigid, atol=1e-4)
            self.assertLess(np.abs(elastic).max(), 0.5)
            along, away = from_axis(now[~body], (row["x"], 0, 4), axis)
            self.assertAlmostEqual(along.max(), 15, delta=1e-4)
            self.assertAlmostEqual(along.min(), -15, delta=1e-4)
            np.testing.assert_allclose(away[away > 1], RADIUS, atol=1e-4)

    def test_solid_face_touches_the_cylinder_and_carries_its_forces(self):
        for name, slopes, position, half_length in (("solid", (2e-3, 1e-3, 1), 4, 15), ("reversal", (0, 1e-3, 1), 0, np.inf)):
            seen = Seen(self.folder / name, "face")
            file = self.result(name)
            axis = np.array(slopes) / np.linalg.norm(slopes)
            for number, row in enumerate(self.rows(name, seen)):
                pressure = seen.values_at(number, "pressure [MPa]")
                for step in np.flatnonzero(file["face/time"][:] == row["time"]):
                    np.testing.assert_allclose(pressure, file["face/pressure"][step], rtol=1e-6)
                np.testing.assert_allclose(seen.values_at(number, "zeta [mm]"), file["face/zeta"][:], atol=1e-5)
                if not row["P"] > 1:
                    continue
                now = seen.values_at(number, "points")
                along, away = from_axis(now, (row["x"], 0, position), axis)
                over = np.abs(along) < half_length
                # A point is the mean over half a millimetre, over which the circle falls by 1/2 (1/4)^2/56.
                self.assertAlmostEqual((away - RADIUS)[over].min(), -row["penetration"], delta=6e-4)
                # One at the end of the contact may have most of its half millimetre outside, where the circle falls by x/R.
                outside = 0.5 * row["contact_width"] + 0.5
                self.assertLess((away - RADIUS)[pressure > 0].max(), 0.5 * 0.5 * outside / RADIUS)
                self.assertLess(np.abs(along[pressure > 0]).max(), half_length + 0.01)
                force = file["face/weight"][:] @ seen.values_at(number, "traction [MPa]")
                # Pressure is shown along the lever's normal; the cylinder's is off by the centre's offset over R.
                self.assertAlmostEqual(force[0], row["Q"], delta=2 * (1e-3 + abs(row["centre_offset"]) / RADIUS) * abs(row["Q"]))
                self.assertAlmostEqual(force[2], row["F_across"], delta=1e-4 * row["P"])

    def test_half_that_is_solved_is_there_with_its_mirror_image(self):
        for index, names in (("fields", ("displacement [mm]", "stress [MPa]", "von_mises_stress [MPa]")), ("face", ("displacement [mm]", "traction [MPa]"))):
            seen = Seen(self.folder / "half", index)
            last = len(seen.times) - 1
            first, second = np.array_split(np.flatnonzero(seen.values_at(last, "lever") == 1), 2)
            mirror = np.array((1, 1, -1))
            points = seen.rest_in_space(last)
            np.testing.assert_allclose(points[second], points[first] * mirror, atol=1e-4)
            self.assertGreater(points[first, 2].max(), 0.4 * WIDTH)
            self.assertGreater(points[first, 2].min(), -1e-4)
            for name in names:
                values = seen.values_at(last, name)
                signs = {1: 1, 3: mirror, 9: np.outer(mirror, mirror).ravel()}[1 if values.ndim == 1 else values.shape[1]]
                self.assertGreater(np.abs(values[first]).max(), 1e-3, name)
                np.testing.assert_allclose(values[second], values[first] * signs, atol=1e-6 * np.abs(values).max(), err_msg=name)
            self.assertAlmostEqual(np.abs(seen.values_at(last, names[0])[first][:, 2]).max(), 0, delta=0.1)

    def test_mode_swings_for_one_period(self):
        modes = {name: values[:] for name, values in self.result("mode")["modes"].items()}
        for number in range(len(modes["frequency"])):
            seen = Seen(self.folder / "mode", f"mode-{number + 1:02}")
            frequency = modes["frequency"][number]
            np.testing.assert_allclose(seen.times, np.arange(1, 25) / (24 * frequency), rtol=1e-9)
            real, imaginary = (seen.values_at(0, f"displacement_{name} [mm]") for name in ("real", "imaginary"))
            largest = np.hypot(np.linalg.norm(real, axis=1), np.linalg.norm(imaginary, axis=1)).max()
            self.assertAlmostEqual(largest, 0.05 * 210, delta=1e-4)
            for k in range(24):
                expected = np.cos(np.pi * (k + 1) / 12) * real - np.sin(np.pi * (k + 1) / 12) * imaginary
                np.testing.assert_allclose(seen.values_at(k, "displacement [mm]"), expected, atol=1e-5)
                self.assertAlmostEqual(seen.values_at(k, "frequency [Hz]")[0], frequency, delta=1e-6 * frequency)
                self.assertAlmostEqual(seen.values_at(k, "growth_rate [1/s]")[0], modes["growth_rate"][number], delta=1e-6 * frequency)
            # A hub turns about its pivot: (x, y) moves by its rotation times (y, -x).
            rotation = seen.values_at(0, "hub_rotation_real [rad]")[0]
            body = seen.values_at(0, "lever") == 1
            away = seen.rest()[body] - (DISTANCE, 0)
            rigid = (real - seen.values_at(0, "elastic_real [mm]"))[body][:, :2]
            np.testing.assert_allclose(rigid, rotation * np.column_stack((away[:, 1], -away[:, 0])), atol=1e-4)
            expected_ratio = modes["rotation_imaginary"][number] / modes["rotation_real"][number]
            self.assertAlmostEqual(seen.values_at(0, "hub_rotation_imaginary [rad]")[0] / rotation, expected_ratio, delta=1e-4)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--look"]:
        for name in sys.argv[2:]:
            look(Path(name))
        # Readers that are torn down at the end of the program have been seen to fail there.
        sys.stdout.flush()
        os._exit(0)
    unittest.main()
