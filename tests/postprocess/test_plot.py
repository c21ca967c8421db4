# SPDX-License-Identifier: GPL-3.0-only
"""plot.py on results of short runs, whole, cut short and damaged."""

import shutil
import subprocess
import unittest
from pathlib import Path

import h5py
import numpy as np

from pictures import SOURCE, PictureTest
from real_results import real_result, run_once
import forces
import isolation


def cut(file, rows):
    """Leaves of a result file what a run that goes on has written so far."""
    for group in ("table", "face"):
        for data in file.get(group, {}).values():
            if data.maxshape[0] is None:
                data.resize(min(rows, len(data)), axis=0)
    for name in ("summary", "meta", "accuracy", "answer", "growth", "continuation"):
        if name in file:
            del file[name]


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


class PlotTest(PictureTest):
    def copied(self, name, folder="a"):
        return shutil.copytree(run_once(name), self.folder / folder)

    def changed(self, name, folder="a", mode="r+", **options):
        return h5py.File(self.copied(name, folder) / "result.h5", mode, **options)

    def test_one_run_in_two_formats_in_place_of_those_of_an_earlier_run(self):
        self.pictures = self.copied("model-b")
        before = {path.name for path in self.pictures.iterdir()}
        for name in ("fields.png", "mine.png"):
            (self.pictures / name).write_text("older")
        names = {f"{name}.{ending}" for name in ("forces-over-x", "contact") for ending in ("png", "pdf")}
        done = self.silent(self.plot(self.pictures, "--format", "png,pdf"))
        self.assertEqual({Path(line).name for line in done.stdout.splitlines()}, names)
        self.assertEqual({path.name for path in self.pictures.iterdir()}, {*names, *before, "mine.png"})

    def test_two_processes_draw_what_one_does(self):
        folder = self.copied("reversal-a of 6")
        alone = self.silent(self.plot("--report", folder))
        command = ["/usr/bin/python3", SOURCE / "postprocess" / "plot.py", "--report", "--on-word", folder]
        for word, lines in (("", ""), ("draw\n", alone.stdout.replace(str(self.pictures), str(folder)))):
            done = subprocess.run(command, input=word, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, lines, ""))
        for picture in self.pictures.iterdir():
            self.assertEqual(picture.read_bytes(), (folder / picture.name).read_bytes(), picture)

    def test_several_runs(self):
        done = self.plot(run_once("model-b"), self.copied("model-b"))
        self.expect_pictures(done, ["comparison.png", "forces-over-x.png", "pressure.png"])
        done = self.plot(run_once("model-b"), "--output", "levels.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("comparison.py", done.stderr)
        self.expect_refusal(self.plot(run_once("closed-form-a"), run_once("fig11")), "nothing in common")

    def test_line_of_the_slope_only_where_there_is_one(self):
        result = real_result("closed-form-a")
        result.summary["slope_backward"] = np.nan
        for lines in (1, 0):
            _, axes = forces.plt.subplots()
            forces.draw_slopes(axes, [result])
            self.assertEqual(len(axes.lines), lines)
            result.summary["slope_forward"] = np.nan

    def test_runs_that_go_on(self):
        for name in ("model-b", "reversal-a of 6", "isolation-a", "plate-reversal-a", "pair in time"):
            for rows in (3, 150):
                with self.subTest(name, rows=rows):
                    self.pictures = self.folder / f"pictures of {name} {rows}"
                    with self.changed(name, f"{name} {rows}") as file:
                        cut(file, rows)
                    self.silent(self.plot(self.folder / f"{name} {rows}"))

    def test_run_that_is_written(self):
        with self.changed("model-b", libver="latest") as file:
            cut(file, 60)
            file["table/P"].resize((59,))  # the last row is on its way
            file.swmr_mode = True
            self.expect_pictures(self.plot(self.folder / "a", own_process=True), ["forces-over-x.png", "contact.png"])

    def test_what_is_no_result(self):
        self.expect_refusal(self.plot(self.folder), str(self.folder), "no result.h5")
        (self.folder / "result.h5").write_text("something else")
        self.expect_refusal(self.plot(self.folder), "result.h5")
        h5py.File(self.folder / "result.h5", "w").close()
        self.expect_refusal(self.plot(self.folder), "not a result of sprag")
        with self.changed("closed-form-a") as file:
            cut(file, 0)
        self.expect_refusal(self.plot(self.folder / "a"), "no step")
        (self.folder / "b").mkdir()
        (self.folder / "b/map.journal").write_text("sprag map 1\n")
        self.expect_refusal(self.plot(self.folder / "b"), "a map that was cut short", "takes it up")

    def test_damaged_results(self):
        for name in ("table/P", "table/x", "parameters", "face/xi", "meta"):
            with self.subTest(name):
                with self.changed("model-b", name.replace("/", "-")) as file:
                    del file[name]
                    if name == "table/x":
                        file[name] = "a text"
                self.expect_refusal(self.plot(self.folder / name.replace("/", "-")), "damaged or of another version")
