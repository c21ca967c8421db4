"""plot.py on small files of the shape sprag writes; run with /usr/bin/python3."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

FOLDER = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(FOLDER))

import results  # noqa: E402


def put(group, name, values, unit):
    data = group.create_dataset(name, data=values, maxshape=None if np.isscalar(values) else (None,) * np.ndim(values))
    data.attrs["unit"] = unit
    data.attrs["description"] = f"{name} of a test"


def new_file(folder, **arguments):
    folder.mkdir()
    file = h5py.File(folder / "result.h5", "w", **arguments)
    file.attrs["format"] = "sprag result"
    file["parameters"] = "subsection Drive\n  set Speed = 112 # mm/s\nend\nsubsection Friction\n  set Coefficient = 0.73\nend\n"
    return file


def fill_run(file, x):
    """Forces proportional to x; a contact of three points travelling along a face of 21."""
    table = file.create_group("table")
    forward = np.diff(x, prepend=-1) > 0
    for name, values, unit in (
        ("time", np.arange(len(x)) / 10, "s"),
        ("x", x, "mm"),
        ("P", x * np.where(forward, 1, 2), "N"),
        ("Q", x * np.where(forward, 1, -1), "N"),
        ("P_closed_form", x * np.where(forward, 1, 2), "N"),
        ("Q_closed_form", np.full(len(x), np.nan), "N"),
        ("contact_width", x / 10, "mm"),
        ("penetration", x * 1e-6, "mm"),
        ("indentation", x * 1e-3, "mm"),
    ):
        put(table, name, values, unit)
    face = file.create_group("face")
    xi = np.arange(21.0)
    put(face, "xi", xi, "mm")
    put(face, "weight", np.ones(21), "mm^2")
    put(face, "time", table["time"][:], "s")
    put(face, "x", x, "mm")
    pressure = np.maximum(0, 1.5 - np.abs(xi - x[:, None])) * (x[:, None] > 0)
    put(face, "pressure", pressure, "MPa")
    put(face, "traction", 0.73 * pressure, "MPa")


def finish(file, **summary):
    for name, value in summary.items():
        put(file.require_group("summary"), name, value, "N/mm")
    file.require_group("summary")
    file.require_group("meta")
    file.close()


def make_run(folder):
    file = new_file(folder)
    fill_run(file, np.concatenate((np.arange(0.0, 11), np.arange(10.0, -1, -1))))
    finish(file, slope_forward=0.08)


def make_sweep(folder, columns):
    file = new_file(folder)
    table = file.create_group("table")
    for name, values in columns.items():
        put(table, name, values, "1")
    finish(file)


class PlotTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        self.pictures = self.folder / "pictures"

    def plot(self, *arguments):
        return subprocess.run(
            ["/usr/bin/python3", FOLDER / "plot.py", *arguments, "--output", self.pictures],
            capture_output=True,
            text=True,
            check=False,
        )

    def expect_pictures(self, done, names):
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(path.name for path in self.pictures.iterdir()), sorted(names))
        for path in self.pictures.iterdir():
            self.assertGreater(path.stat().st_size, 5000)

    def expect_refusal(self, done, *words):
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_one_run_in_two_formats(self):
        make_run(self.folder / "a")
        names = [f"{name}.{ending}" for name in ("forces-over-time", "forces-over-x", "contact") for ending in ("png", "pdf")]
        self.expect_pictures(self.plot(self.folder / "a", "--format", "png,pdf"), names)

    def test_several_runs_share_pictures(self):
        make_run(self.folder / "a")
        make_run(self.folder / "b")
        done = self.plot(self.folder / "a", self.folder / "b")
        self.expect_pictures(done, ["forces-over-time.png", "forces-over-x.png"])

    def test_sweep_over_coefficient(self):
        mu = np.linspace(0, 1.2, 5)
        make_sweep(self.folder / "a", {"mu": mu, "dimensionless_forward": mu, "dimensionless_backward": -mu})
        self.expect_pictures(self.plot(self.folder / "a"), ["slope.png"])

    def test_sweep_over_inclination(self):
        theta0 = np.tile(np.linspace(0, 1, 5), 2)
        columns = {"theta0": theta0, "offset_ratio": np.repeat((0, 0.2), 5)}
        make_sweep(self.folder / "a", {**columns, "dimensionless_forward": theta0, "dimensionless_backward": -theta0})
        self.expect_pictures(self.plot(self.folder / "a"), ["slope.png"])

    def test_run_going_on(self):
        file = new_file(self.folder / "a", libver="latest")
        fill_run(file, np.arange(0.0, 11))
        file["table/P"].resize((10,))  # the last row is on its way
        file.swmr_mode = True
        self.addCleanup(file.close)
        names = ["forces-over-time.png", "forces-over-x.png", "contact.png"]
        self.expect_pictures(self.plot(self.folder / "a"), names)

    def test_run_without_steps(self):
        file = new_file(self.folder / "a")
        fill_run(file, np.empty(0))
        finish(file)
        self.expect_refusal(self.plot(self.folder / "a"), "no step")

    def test_folder_without_result(self):
        self.expect_refusal(self.plot(self.folder), str(self.folder), "no result.h5")

    def test_not_hdf5(self):
        (self.folder / "result.h5").write_text("something else")
        self.expect_refusal(self.plot(self.folder), "result.h5")

    def test_somebody_elses_hdf5(self):
        h5py.File(self.folder / "result.h5", "w").close()
        self.expect_refusal(self.plot(self.folder), "not a result of sprag")

    def test_parameters_as_used(self):
        make_run(self.folder / "a")
        result = results.read_result(self.folder / "a")
        self.assertEqual(result.parameter("Drive", "Speed"), "112")
        self.assertEqual(result.parameter("Friction", "Coefficient"), "0.73")
        with self.assertRaises(KeyError):
            result.parameter("Drive", "Coefficient")


if __name__ == "__main__":
    unittest.main()
