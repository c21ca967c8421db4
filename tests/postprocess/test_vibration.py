# SPDX-License-Identifier: GPL-3.0-only
"""Pictures of modes, stability and sprag slip on small files of the shape sprag writes; run with /usr/bin/python3."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest  # noqa: E402
from sprag import results  # noqa: E402
import sprag_slip  # noqa: E402
import vibration  # noqa: E402
from style import plt  # noqa: E402
from test_plot import finish, new_file, put  # noqa: E402

FEEDS = [f"growth_by_{name}" for name, _ in vibration.FEEDS]

def fill_modes(file, eigenvalues, xi):
    """Standing waves of growing number of nodes, the rotation turning the lever about its pivot; the lever's points in disorder."""
    modes = file.create_group("modes")
    eigenvalues = np.asarray(eigenvalues, dtype=complex)
    number = len(eigenvalues)
    put(modes, "frequency", eigenvalues.imag / (2 * np.pi))
    put(modes, "growth_rate", eigenvalues.real)
    put(modes, "kind", np.where(eigenvalues.real > 0, np.where(eigenvalues.imag > 0, 1.0, 2.0), 0.0))
    for name in FEEDS:
        put(modes, name, eigenvalues.real / len(FEEDS))
    if number == 0:
        return
    put(modes, "xi", xi)
    wave = np.sin(np.pi * np.arange(1, number + 1)[:, None] * xi / 200)
    for part, factor in (("real", 1.0), ("imaginary", 0.2)):
        put(modes, f"across_{part}", factor * wave)
        put(modes, f"rotation_{part}", np.full(number, factor * 0.01))


FACE = np.array((200.0, 0.0, 100.0, 50.0, 150.0))
GROWING = (-180 + 1047j, 78 + 1162j, -110 + 4467j, -300 + 7700j, -400 + 15000j)


def make_stability(folder, eigenvalues=GROWING, xi=FACE, kind="stability", searched=(), **summary):
    file = new_file(folder, kind)
    file.create_group("table")
    fill_modes(file, eigenvalues, xi)
    for name, values in searched:
        put(file.require_group("critical_lever_depth"), name, values)
    finish(file, **summary)
    return folder


def role(name, verdict, rate):
    return {f"without_{name}_verdict": verdict, f"without_{name}_growth_rate": rate, f"without_{name}_frequency": np.nan}


FLUTTER = {"verdict": "flutter", "growth_rate": 78.0, **role("damping", "flutter", 87.0), **role("flexure", "stable", -81.0)}
SEARCHED = (("value", np.array((2.0, 12.0, 4.0, 3.0))), ("growth_rate", np.array((80.0, -9.0, np.nan, 20.0))))
FOUND = {"critical_lever_depth_1": 4.3, "critical_lever_depth_verdicts": "Lever/Depth from 2 to 12 mm: flutter, stable from 4.3 mm"}
JAMMED = {"verdict": "jammed", **role("damping", "jammed", np.nan), **role("inertia", "jammed", np.nan)}


class SpragSlipRun:
    """Growth at a rate until P reaches zero, then a vibration out of contact half of the time."""

    rate, frequency, steady, turn = 100.0, 180.0, 24.0, 0.14

    def table(self, end=0.3):
        time = np.arange(0, end, 2e-4)
        swing = np.exp(self.rate * np.minimum(time - 0.13, 0)) * np.sin(2 * np.pi * self.frequency * time)
        P = np.maximum(self.steady * (1 + np.where(time > self.turn, 2, 1) * swing), 0)
        columns = {"time": time, "P": P, "indentation": P / 1500, "theta": 0.05 + 1e-3 * swing, "theta_rate": swing}
        return {**columns, "P_quasi_static": np.full(len(time), self.steady), "x": np.full(len(time), 65.0), "Q": P / 2}

    def fill_growth(self, file):
        time = np.arange(0.01, 0.07, 1 / 180)
        for name, values in {"time": time, "amplitude": 1e-6 * np.exp(self.rate * time)}.items():
            put(file.require_group("growth"), name, values)
        put(file["growth"], "predicted", 1e-6 * np.exp(1.01 * self.rate * time))

    def fill_continuation(self, file, x, kind_away, kind_back):
        group = file.create_group("continuation")
        put(group, "x", x)
        put(group, "growth_rate", 10.0 * (x - 62))
        for way, kinds in (("away", kind_away), ("back", kind_back)):
            put(group, f"kind_{way}", kinds)
            put(group, f"amplitude_P_{way}", 40.0 + 0.0 * x)

    summary = {
        "slide": "flutter",
        "x": 65.0,
        "P": 24.0,
        "indentation": 0.016,
        "linear_growth_rate": 101.0,
        "linear_frequency": 180.0,
        "measured_growth_rate": 100.0,
        "measured_frequency": 180.0,
    }
    cycle = {"cycle": "cycle", "cycle_begin": 0.2, "cycle_amplitude_P": 40.0, "cycle_frequency": 180.0, "cycle_open_share": 0.5}


def make_sprag_slip(folder, end=0.3, **arguments):
    file = new_file(folder, "sprag slip", **arguments)
    file.create_group("table")
    for name, values in SpragSlipRun().table(end).items():
        put(file["table"], name, values)
    return file


class ModePictureTest(PictureTest):
    def expect_png(self, done, names):
        self.expect_pictures(done, [f"{name}.png" for name in names])


class Vibration(ModePictureTest):
    def modes(self, *arguments, **options):
        return results.read_result(make_stability(self.folder / "a", *arguments, **options)).groups["modes"]

    def test_deflection_turns_with_the_hub(self):
        xi, (shape,) = vibration.deflections(self.modes(), 0)
        np.testing.assert_array_equal(xi, (0, 50, 100, 150, 200))
        expected = np.sin(np.pi * xi / 200) + 0.01 * xi
        np.testing.assert_allclose(shape, expected / expected.max(), rtol=0, atol=1e-12)

    def test_rigid_lever_is_straight(self):
        modes = self.modes((-10 + 600j,), np.array((0.0,)))
        xi, (shape,) = vibration.deflections(modes, 0)
        np.testing.assert_allclose(shape, xi / xi[-1], rtol=0, atol=1e-15)

    def test_both_levers_of_a_pair_share_a_scale_and_are_named_by_their_motion(self):
        modes = dict(self.modes())
        for name in ("across", "rotation"):
            for part in ("real", "imaginary"):
                modes[f"{name}_2_{part}"] = -0.5 * modes[f"{name}_{part}"]
        modes["mirroring"] = np.full(len(modes["frequency"]), -0.95)
        _, (first, second) = vibration.deflections(modes, 0)
        np.testing.assert_allclose(second, -0.5 * first, rtol=0, atol=1e-15)
        self.assertAlmostEqual(np.abs(first).max(), 1, 12)
        self.assertTrue(vibration.mode_name(modes, 0).endswith(", swinging"))
        modes["mirroring"][:] = 0.95
        self.assertTrue(vibration.mode_name(modes, 0).endswith(", mirroring"))

    def test_growing_modes_are_always_shown(self):
        modes = self.modes((*GROWING[2:], 5 + 90000j))
        self.assertEqual(vibration.shown_modes(modes, 2), [0, 3])
        self.assertEqual(vibration.shown_modes(modes, 10), [0, 1, 2, 3])

    def test_names_of_modes(self):
        modes = self.modes((-1234 + 2000j * np.pi, 0.5 + 200j * np.pi, 40 + 0j))
        names = [vibration.mode_name(modes, mode) for mode in range(3)]
        minus = "\N{MINUS SIGN}"
        self.assertEqual(names, [f"1000 Hz, {minus}1234 1/s", "100 Hz, +0.5 1/s, flutter", "0 Hz, +40 1/s, divergence"])

    def test_bars_of_roles(self):
        """Growth as bars, in the order given; without a rate the verdict alone."""
        _, axes = plt.subplots()
        vibration.draw_roles(axes, {**FLUTTER, **role("inertia", "stable", np.nan)})
        self.assertEqual([bar.get_width() for bar in axes.patches], [78, 87, -81])
        self.assertEqual([text.get_text() for text in axes.texts], ["stable"])

    def test_divergence_is_on_the_axis(self):
        _, axes = plt.subplots()
        vibration.draw_eigenvalues(axes, self.modes((40 + 0j, -10 + 600j)))
        low, high = axes.get_ylim()
        self.assertLessEqual(low, 0)
        self.assertGreater(high, 600 / (2 * np.pi))

    def test_pictures(self):
        cases = {
            "flutter": (make_stability(self.folder / "flutter", **FLUTTER), ["modes", "stability"]),
            "modal": (make_stability(self.folder / "modal", 1j * np.imag(GROWING), kind="modal"), ["modes"]),
            "rigid": (make_stability(self.folder / "rigid", GROWING[1:2], np.zeros(1), **FLUTTER), ["modes", "stability"]),
            "roles off": (make_stability(self.folder / "off", verdict="stable", growth_rate=-3.0), ["modes", "stability"]),
            "searched": (make_stability(self.folder / "searched", searched=SEARCHED, **FLUTTER, **FOUND), ["modes", "stability", "critical"]),
            "jammed": (make_stability(self.folder / "jammed", (), **JAMMED), ["stability"]),
        }
        for name, (run, pictures) in cases.items():
            with self.subTest(case=name):
                self.pictures = self.folder / f"pictures of {name}"
                self.expect_png(self.plot(run), pictures)
        self.expect_refusal(self.plot(make_stability(self.folder / "none", (), kind="modal")), "no mode")

    def test_map_shades_where_the_slide_grows(self):
        value, x, way = (grid.ravel() for grid in np.meshgrid(np.linspace(2, 12, 11), np.linspace(0, 60, 7), (1.0, -1.0)))
        places = {"value": value, "x": x, "direction": way, "growth_rate": np.where(way > 0, 30 - 4 * value, -1.0)}
        searched = SEARCHED + tuple((f"place_{name}", values) for name, values in places.items())
        result = results.read_result(make_stability(self.folder / "a", searched=searched, **FLUTTER, **FOUND))
        axes = vibration.vibration_pictures(result)["critical"].axes[1]
        shaded = [path.vertices[:, 0] for shade in axes.collections for path in shade.get_paths() if len(path.vertices) > 2]
        self.assertAlmostEqual(np.concatenate(shaded).max(), 7.5)  # growth is 0 there, forward; backward it is negative
        self.assertIn(4.3, [line.get_xdata()[0] for line in axes.lines])


class SpragSlip(ModePictureTest):
    example = SpragSlipRun()

    def test_all_pictures(self):
        x = np.arange(58.0, 66)
        with make_sprag_slip(self.folder / "a") as file:
            self.example.fill_growth(file)
            self.example.fill_continuation(file, x, np.where(x > 60, 1.0, 0.0), np.where(x > 62, 2.0, 0.0))
            finish(file, coexistence_from=61.0, coexistence_to=62.0, **self.example.summary, **self.example.cycle)
        self.expect_png(self.plot(self.folder / "a"), ["growth", "cycle", "continuation"])

    def test_branches_jump(self):
        """From slide to vibration no line is drawn but dots."""
        x = np.array((3.0, 1, 2, 4, 5))
        points = {"x": x, "kind_away": np.array((1.0, 0, 0, 2, np.nan)), "amplitude_P_away": 10 * x}
        _, axes = plt.subplots()
        sprag_slip.draw_branch(axes, points, "away", "name", "o", 0)
        lines = [(line.get_linestyle(), *line.get_ydata()) for line in axes.get_lines() if len(line.get_xdata()) == 2]
        self.assertEqual(lines, [("-", 0, 0), (":", 0, 30), ("-", 30, 40)])
        hollow = [line for line in axes.get_lines() if line.get_markerfacecolor() == "white"]
        self.assertEqual([list(line.get_ydata()) for line in hollow], [[40]])

    def test_force_until_the_vibration_is_told_apart(self):
        with make_sprag_slip(self.folder / "a") as file:
            finish(file, **self.example.summary, **self.example.cycle)
        result = results.read_result(self.folder / "a")
        _, axes = plt.subplots()
        sprag_slip.draw_force(axes, result, 0.06)
        shown = axes.get_lines()[0].get_xdata()
        lost = result.table["time"][result.table["P"] == 0][0]
        self.assertAlmostEqual(shown[-1] / 1e3, min(lost + 20 / 180, 0.2), delta=2.1e-4)

    def test_runs_without_all_there_may_be(self):
        """A slide that does not oscillate, one stopped before the vibration is told, one stopped at once, one that goes on."""
        cases = {
            "still": (0.3, {**self.example.summary, "linear_frequency": 0.0, "measured_frequency": np.nan}),
            "stopped": (0.3, {**self.example.summary, "cycle_begin": np.nan, "status": "interrupted"}),
            "begun": (0.01, self.example.summary),
        }
        for name, (end, summary) in cases.items():
            with self.subTest(name), make_sprag_slip(self.folder / name, end) as file:
                self.pictures = self.folder / f"pictures of {name}"
                if name == "begun":
                    for column in ("time", "amplitude", "predicted"):
                        put(file.require_group("growth"), column, np.empty(0))
                else:
                    self.example.fill_growth(file)
                finish(file, **summary)
                self.expect_png(self.plot(self.folder / name), ["growth"])
        self.pictures = self.folder / "others"
        with make_sprag_slip(self.folder / "going on", libver="latest") as file:
            file.swmr_mode = True
            self.expect_png(self.plot(self.folder / "going on"), ["growth"])
        with make_sprag_slip(self.folder / "jammed", 0.0) as file:
            finish(file, slide="jammed", status="no slide in contact that could be perturbed")
        self.expect_refusal(self.plot(self.folder / "jammed"), "no step was made: no slide in contact")


if __name__ == "__main__":
    unittest.main()
