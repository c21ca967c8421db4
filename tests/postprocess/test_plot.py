# SPDX-License-Identifier: GPL-3.0-only
"""plot.py on small files of the shape sprag writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest  # noqa: E402
import forces  # noqa: E402
import isolation  # noqa: E402
from sprag import results  # noqa: E402
import transient  # noqa: E402


def put(group, name, values, unit="1", description=None):
    data = group.create_dataset(name, data=values, maxshape=None if np.isscalar(values) else (None,) * np.ndim(values))
    data.attrs["unit"] = unit
    data.attrs["description"] = f"{name} of a test" if description is None else description


def new_file(folder, kind="quasi-static", **arguments):
    folder.mkdir()
    file = h5py.File(folder / "result.h5", "w", **arguments)
    file.attrs["format"] = "sprag result"
    file["parameters"] = f"subsection Analysis\n  set Type = {kind}\nend\nsubsection Drive\n  set Speed = 112 # mm/s\nend\nsubsection Friction\n  set Coefficient = 0.73\nend\n"
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
        file["summary"][name].attrs["headline"] = "yes"
    file.require_group("summary")
    file.require_group("meta")
    file.close()


def make_run(folder):
    file = new_file(folder)
    fill_run(file, np.concatenate((np.arange(0.0, 11), np.arange(10.0, -1, -1))))
    finish(file, slope_forward=0.08)


def make_sweep(folder, columns):
    file = new_file(folder, "slope")
    table = file.create_group("table")
    for name, values in columns.items():
        put(table, name, values, "1")
    finish(file)


class Spectra(unittest.TestCase):
    def test_a_record_counts_to_its_end(self):
        # A sine of 300 Hz at 1 kHz for 2 s of 20: its velocity is a/w. The window lets 1e-3 of it into the other bands.
        time = np.arange(0, 20, 1e-3)
        base = np.where(time <= 2, np.sin(2 * np.pi * 300 * time), 0.0)
        rows = isolation.rows_that_shake(base)
        centres, velocity = isolation.third_octaves(time[rows], base[rows])
        expected = np.sqrt(0.5) / (2 * np.pi * 300)
        at_300 = np.argmin(np.abs(centres - 316))
        self.assertAlmostEqual(velocity[at_300], expected, delta=1e-3 * expected)
        self.assertLess(np.max(np.delete(velocity, at_300)), 1e-2 * expected)


class Oscillator:
    """P on a contact spring about the value without inertia, which jumps at the reversal; open contact flies freely."""

    duration = 5e-3  # of the reversal
    speed, stroke = 112.0, 20.0
    frequency = 290.0

    def __init__(self, growth, step=1e-4):
        self.turn = self.stroke / self.speed
        self.growth = growth
        self.step = step

    def quasi_static(self, time):
        """x, v, P and Q; v as of a straight ramp of the speed in the reversal."""
        since = np.clip((time - self.turn) / self.duration, -0.5, 0.5)
        v = -2 * self.speed * since
        x = self.stroke - self.speed * np.abs(time - self.turn)
        forward = time <= self.turn
        return x, v, (4 + x) * np.where(forward, 0.5, 1.0), (4 + x) * np.where(forward, 0.4, -0.65)

    def normal_force(self, time):
        omega, distance, rate = 2 * np.pi * self.frequency, 0.0, 0.0
        steady = self.quasi_static(time)[2]
        forces = steady.copy()
        for i, span in enumerate(np.diff(time), 1):
            distance += steady[i - 1] - steady[i]  # the force of the contact spring stays
            damping = 2 * self.growth if distance > -steady[i] else 0
            rate += span * (damping * rate - omega**2 * max(distance, -steady[i]))
            distance += span * rate
            forces[i] = max(steady[i] + distance, 0)
        return forces

    def table(self):
        end = 2 * self.turn - 0.01
        random = np.random.default_rng(1)
        time = np.cumsum(self.step * (0.5 + random.random(int(end / self.step))))
        time = np.sort(np.append(time[time < end], (0, self.turn)))
        x, v, steady_P, steady_Q = self.quasi_static(time)
        P = self.normal_force(time)
        Q = steady_Q * P / steady_P
        support = np.convolve(Q, np.ones(25) / 25, "same")
        work = np.cumsum(np.abs(Q) * np.abs(np.diff(x, prepend=0)))
        columns = {
            "time": (time, "s"),
            "x": (x, "mm"),
            "v": (v, "mm/s"),
            "P": (P, "N"),
            "Q": (Q, "N"),
            "Q_support": (support, "N"),
            "P_quasi_static": (np.where(v == 0, np.nan, steady_P), "N"),
            "Q_quasi_static": (np.where(v == 0, np.nan, steady_Q), "N"),
            "drive_work": (work, "N mm"),
            "friction_work": (0.9 * work, "N mm"),
            "damping_work": (1e-2 * work, "N mm"),
            "algorithmic_work": (1e-4 * work, "N mm"),
            "spring_energy": (0.089 * work, "N mm"),
            "elastic_energy": (9e-4 * work, "N mm"),
            "kinetic_energy": (1e-3 * (P - steady_P) ** 2, "N mm"),
            "support_energy": (np.zeros_like(work), "N mm"),
            "contact_energy": (P**2 / 4000, "N mm"),
            "energy_residual": (1e-7 * work * np.sin(time * 90), "N mm"),
        }
        return columns


def make_transient(folder, model="beam", growth=-40.0, rows=None, summary=None, **arguments):
    """The file is left open for `finish`."""
    file = new_file(folder, **arguments)
    del file["parameters"]
    file["parameters"] = (
        f"subsection Analysis\n  set Type = transient\n  set Model = {model}\n  set Maximum energy residual = 1e-3\nend\n"
        "subsection Drive\n  set Profile = triangle\n  set Reversal duration = 5e-3\nend\n"
    )
    table = file.create_group("table")
    for name, (values, unit) in Oscillator(growth).table().items():
        put(table, name, values[:rows], unit)
    for name, value in (summary or {}).items():
        put(file.require_group("summary"), name, value, "Hz")
    return file


TRANSIENT = ["forces-over-time.png", "forces-over-x.png", "reversal.png", "energy.png"]


class PlotTest(PictureTest):
    def test_one_run_in_two_formats_in_place_of_those_of_an_earlier_run(self):
        make_run(self.folder / "a")
        self.pictures = self.folder / "a"
        for name in ("fields.png", "mine.png"):
            (self.folder / "a" / name).write_text("older")
        names = [f"{name}.{ending}" for name in ("forces-over-x", "contact") for ending in ("png", "pdf")]
        done = self.plot(self.folder / "a", "--format", "png,pdf")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(Path(line).name for line in done.stdout.splitlines()), sorted(names))
        self.assertEqual({path.name for path in self.pictures.iterdir()}, {*names, "result.h5", "mine.png"})

    def test_several_runs_share_pictures(self):
        make_run(self.folder / "a")
        make_run(self.folder / "b")
        done = self.plot(self.folder / "a", self.folder / "b")
        self.expect_pictures(done, ["comparison.png", "forces-over-x.png", "pressure.png"])

    def test_line_of_the_slope_only_where_there_is_one(self):
        for name, slope, lines in (("constant", 0.08, 1), ("changing", np.nan, 0)):
            with self.subTest(name):
                file = new_file(self.folder / name)
                fill_run(file, np.arange(0.0, 11))
                finish(file, slope_forward=slope)
                figure, axes = forces.plt.subplots()
                forces.draw_slopes(axes, [results.read_result(self.folder / name)])
                self.assertEqual(len(axes.lines), lines)
                forces.plt.close(figure)

    def test_transient_run_that_vibrates(self):
        """One that comes to rest is drawn while it goes on."""
        finish(make_transient(self.folder / "a", growth=25.0, summary={"reversal_1_frequency": 290.1}))
        self.expect_pictures(self.plot(self.folder / "a"), TRANSIENT)

    def test_transient_runs_without_all_there_may_be(self):
        finish(make_transient(self.folder / "calm", growth=-4000.0, summary={"reversal_1_frequency": np.nan}))
        self.expect_layout(transient.reversal(results.read_result(self.folder / "calm")))
        finish(make_transient(self.folder / "three rows", rows=3))
        self.expect_pictures(self.plot(self.folder / "three rows"), ["forces-over-time.png", "forces-over-x.png", "energy.png"])
        file = make_transient(self.folder / "begun", rows=1800)
        for name in ("P_quasi_static", "energy_residual", "drive_work", "kinetic_energy"):
            file[f"table/{name}"][:] = np.nan
        finish(file)
        self.pictures = self.folder / "of one just begun"
        self.expect_pictures(self.plot(self.folder / "begun"), TRANSIENT[:2])

    def test_transient_run_going_on(self):
        with make_transient(self.folder / "a", rows=1800, libver="latest") as file:
            file.swmr_mode = True
            self.expect_pictures(self.plot(self.folder / "a", own_process=True), TRANSIENT)

    def test_levels_in_one_picture(self):
        make_run(self.folder / "no model named")
        for model, growth in (("rigid", -30.0), ("finite element", -40.0), ("beam", 20.0)):
            finish(make_transient(self.folder / model, model, growth))
        finish(make_transient(self.folder / "another", "beam"))
        done = self.plot(*(path for path in self.folder.iterdir()))
        self.expect_pictures(done, ["comparison.png", "forces-over-x.png", "forces-over-time.png"])

    def test_picture_file(self):
        make_run(self.folder / "a")
        done = self.plot(self.folder / "a", "--output", "levels.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("comparison.py", done.stderr)

    def test_sweeps(self):
        mu, theta0 = np.linspace(0, 1.2, 5), np.tile(np.linspace(0, 1, 5), 2)
        sweeps = {
            "coefficient": {"mu": mu, "dimensionless_forward": mu, "dimensionless_backward": -mu},
            "inclination": {"theta0": theta0, "offset_ratio": np.repeat((0, 0.2), 5), "dimensionless_forward": theta0, "dimensionless_backward": -theta0},
        }
        for name, columns in sweeps.items():
            with self.subTest(name):
                make_sweep(self.folder / name, columns)
                self.expect_pictures(self.plot(self.folder / name), ["slope.png"])
        make_run(self.folder / "a")
        self.expect_refusal(self.plot(self.folder / "a", self.folder / "coefficient"), "nothing in common")

    def test_run_going_on(self):
        file = new_file(self.folder / "a", libver="latest")
        fill_run(file, np.arange(0.0, 11))
        file["table/P"].resize((10,))  # the last row is on its way
        file.swmr_mode = True
        self.addCleanup(file.close)
        names = ["forces-over-x.png", "contact.png"]
        self.expect_pictures(self.plot(self.folder / "a", own_process=True), names)

    def test_what_is_no_result(self):
        self.expect_refusal(self.plot(self.folder), str(self.folder), "no result.h5")
        (self.folder / "result.h5").write_text("something else")
        self.expect_refusal(self.plot(self.folder), "result.h5")
        h5py.File(self.folder / "result.h5", "w").close()
        self.expect_refusal(self.plot(self.folder), "not a result of sprag")
        file = new_file(self.folder / "a")
        fill_run(file, np.empty(0))
        finish(file)
        self.expect_refusal(self.plot(self.folder / "a"), "no step")
        (self.folder / "b").mkdir()
        (self.folder / "b/map.journal").write_text("sprag map 1\n")
        self.expect_refusal(self.plot(self.folder / "b"), "a map that was cut short", "takes it up")

    def test_damaged_results(self):
        for name in ("table/P", "table/x", "parameters", "face/xi", "meta"):
            with self.subTest(name):
                folder = self.folder / name.replace("/", "-")
                make_run(folder)
                with h5py.File(folder / "result.h5", "a") as file:
                    del file[name]
                    if name == "table/x":
                        file[name] = "a text"
                self.expect_refusal(self.plot(folder), "damaged or of another version")

    def test_parameters_as_used(self):
        make_run(self.folder / "a")
        result = results.read_result(self.folder / "a")
        self.assertEqual(result.parameter("Drive", "Speed"), "112")
        self.assertEqual(result.parameter("Friction", "Coefficient"), "0.73")
        with self.assertRaises(KeyError):
            result.parameter("Drive", "Coefficient")


if __name__ == "__main__":
    unittest.main()
