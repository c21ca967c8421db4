# SPDX-License-Identifier: GPL-3.0-only
"""export.py on small files of the shape sprag writes, read back as others would; run with /usr/bin/python3."""

import csv
import json
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import PictureTest, draw  # noqa: E402
import test_map  # noqa: E402
import test_plot  # noqa: E402
import test_study  # noqa: E402
import test_vibration  # noqa: E402


def read_rows(path, delimiter=","):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file, delimiter=delimiter))


class ExportTest(PictureTest):
    def export(self, *arguments):
        done = draw("export.py", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [Path(line) for line in done.stdout.splitlines()]

    def make_run(self):
        folder = self.folder / "a"
        file = test_plot.new_file(folder)
        test_plot.fill_run(file, np.concatenate((np.arange(0.0, 11) / 3, [np.nan])))
        test_plot.put(file["table"], "theta", np.full(12, -0.0), "rad")
        test_plot.put(file.require_group("summary"), "status", "completed", "")
        test_plot.finish(file, slope_forward=0.1 / 3, slope_backward=np.nan)
        return folder

    def test_table_holds_every_number_to_the_last_digit(self):
        folder = self.make_run()
        self.assertEqual([path.name for path in self.export(folder)], ["table.csv", "summary.csv", "summary.json"])
        names, *rows = read_rows(folder / "table.csv")
        self.assertEqual(names[:5], ["time [s]", "x [mm]", "theta [rad]", "P [N]", "Q [N]"])
        with h5py.File(folder / "result.h5") as file:
            self.assertEqual(sorted(name.split(" [")[0] for name in names), sorted(file["table"]))
            for column, name in enumerate(names):
                cells = [row[column] for row in rows]
                data = file["table"][name.split(" [")[0]]
                self.assertEqual(name, f"{name.split(' [')[0]} [{data.attrs['unit']}]")
                np.testing.assert_array_equal([float(cell or "nan") for cell in cells], data[:])
                self.assertFalse(any("-0" == cell for cell in cells))

    def test_decimal_comma(self):
        folder = self.make_run()
        self.export(folder, "--decimal-comma", "--format", "csv", "-o", self.pictures)
        names, _, second, *_ = read_rows(self.pictures / "table.csv", ";")
        self.assertEqual(second[names.index("x [mm]")], repr(1 / 3).replace(".", ","))
        self.assertFalse((self.pictures / "summary.json").exists())

    def test_summary(self):
        folder = self.make_run()
        self.export(folder)
        rows = {row[0]: row[1:] for row in read_rows(folder / "summary.csv")}
        self.assertEqual(rows["name"], ["value", "unit", "description"])
        self.assertEqual(rows["slope_forward"], [repr(0.1 / 3), "N/mm", "slope_forward of a test"])
        self.assertEqual(rows["slope_backward"][0], "")
        self.assertEqual(rows["status"][0], "completed")

    def test_json(self):
        folder = self.make_run()
        self.export(folder, "--only", "summary", "--format", "json")
        entries = json.loads((folder / "summary.json").read_text(), parse_constant=self.fail)
        self.assertEqual(entries["summary"]["slope_forward"]["value"], 0.1 / 3)
        self.assertIsNone(entries["summary"]["slope_backward"]["value"])
        self.assertEqual(entries["parameters"]["Drive/Speed"]["value"], 112)
        self.assertFalse((folder / "table.csv").exists())

    def test_face(self):
        folder = self.make_run()
        self.export(folder, "--only", "face", "--format", "csv")
        names, *rows = read_rows(folder / "face.csv")
        self.assertEqual(names, ["time [s]", "x [mm]", "xi [mm]", "pressure [MPa]", "traction [MPa]"])
        self.assertTrue(rows)
        for row in rows:
            time, x, xi, pressure, _ = map(float, row)
            self.assertAlmostEqual(pressure, 1.5 - abs(xi - x), 12)

    def test_study_has_words_for_words(self):
        folder = test_study.make_study(self.folder / "study")
        with h5py.File(folder / "result.h5", "a") as file:
            number = len(file["table/run"])
            test_study.put(file["table"], "contact_enforcement", np.zeros(number))
            test_study.put(file["runs"], "contact_enforcement", ["penalty"] * number, "")
            test_study.put(file["runs"], "reason", [""] * (number - 1) + ["too large, it said"], "")
        self.export(folder)
        names, *rows = read_rows(folder / "table.csv")
        last = dict(zip(names, rows[-1]))
        self.assertEqual(names[0], "run [1]")
        self.assertEqual(last["contact_enforcement"], "penalty")
        self.assertEqual(last["reason"], "too large, it said")
        self.assertEqual((last["mesh_face_size [mm]"], last["outcome [1]"]), ("2", "2"))

    def test_map_has_a_row_for_each_point(self):
        folder = test_map.make_map(self.folder / "map")
        self.export(folder)
        names, *rows = read_rows(folder / "map.csv")
        self.assertEqual(names[:2], ["Friction/Factor [1]", "Lever/Depth [mm]"])
        self.assertEqual(len(rows), test_map.N_FIRST * test_map.N_SECOND)
        column = names.index("growth_rate_forward [1/s]")
        for row in rows[:-1]:
            i = (float(row[0]) - 0.5) / 0.25
            self.assertAlmostEqual(float(row[column]), 40 * (i - 2.25), 12)
        self.assertEqual(rows[-1][column], "")
        self.assertEqual(read_rows(folder / "table.csv")[0][:2], ["Friction/Factor [1]", "Lever/Depth [1]"])

    def test_modes_and_their_shapes(self):
        folder = test_vibration.make_stability(self.folder / "a", **test_vibration.FLUTTER)
        written = self.export(folder)
        self.assertEqual([path.name for path in written], ["modes.csv", "mode-shapes.csv", "summary.csv", "summary.json"])
        names, *rows = read_rows(folder / "modes.csv")
        self.assertEqual(names[:3], ["mode [1]", "frequency [1]", "growth_rate [1]"])
        self.assertEqual([float(row[2]) for row in rows], [value.real for value in test_vibration.GROWING])
        names, *rows = read_rows(folder / "mode-shapes.csv")
        shape = {float(row[1]): float(row[names.index("across_real [1]")]) for row in rows if row[0] == "1"}
        self.assertAlmostEqual(shape[50.0], np.sin(np.pi / 4), 12)

    def test_several_results_have_folders_of_their_own(self):
        written = self.export(self.make_run(), test_map.make_map(self.folder / "map"), "-o", self.pictures)
        self.assertEqual({path.parent for path in written}, {self.pictures / "a", self.pictures / "map"})

    def test_run_going_on(self):
        with test_plot.new_file(self.folder / "a", libver="latest") as file:
            test_plot.fill_run(file, np.arange(0.0, 11))
            file["table/P"].resize((10,))
            file.swmr_mode = True
            self.assertEqual(self.export(self.folder / "a", "--format", "csv"), [self.folder / "a" / "table.csv"])
        self.assertEqual(len(read_rows(self.folder / "a" / "table.csv")), 11)

    def test_refusals(self):
        folder = self.make_run()
        self.expect_refusal(draw("export.py", folder, "--only", "map"), "no map", "table, summary, face")
        self.expect_refusal(draw("export.py", self.folder), "no result.h5")


if __name__ == "__main__":
    unittest.main()
