# SPDX-License-Identifier: GPL-3.0-only
"""export.py on results of short runs, read back as others would."""

import csv
import json
from pathlib import Path

import numpy as np

from pictures import PictureTest, draw
from real_results import real_result, run_once


def read_rows(path, delimiter=","):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file, delimiter=delimiter))


def numbers(rows, column):
    return [float(row[column] or "nan") for row in rows]


class ExportTest(PictureTest):
    def export(self, name, *options):
        """The result and the folder of its tables."""
        self.written = draw("export.py", run_once(name), "-o", self.pictures, *options)
        self.assertEqual((self.written.returncode, self.written.stderr), (0, ""))
        return real_result(name), self.pictures

    def names(self):
        return [Path(line).name for line in self.written.stdout.splitlines()]

    def test_table_holds_every_number_to_the_last_digit(self):
        result, folder = self.export("closed-form-a")
        self.assertEqual(self.names(), ["table.csv", "answer.csv", "summary.csv", "summary.json"])
        header, *rows = read_rows(folder / "table.csv")
        self.assertEqual(header[:2], ["time [s]", "x [mm]"])
        self.assertEqual(sorted(name.split(" [")[0] for name in header), sorted(result.table))
        for column, name in enumerate(header):
            np.testing.assert_array_equal(numbers(rows, column), result.table[name.split(" [")[0]], name)
        self.assertFalse(any(cell == "-0" for row in rows for cell in row))
        self.export("closed-form-a", "--decimal-comma", "--format", "csv", "--only", "table")
        names, *others = read_rows(folder / "table.csv", ";")
        self.assertEqual([[cell.replace(",", ".") for cell in row] for row in others], rows)
        self.assertFalse(any("." in cell for row in others for cell in row))

    def test_summary_in_both_formats(self):
        result, folder = self.export("closed-form-a")
        rows = {row[0]: row[1:] for row in read_rows(folder / "summary.csv")}
        self.assertEqual(rows["name"], ["value", "unit", "description"])
        self.assertEqual(rows["loop_area"][:2], [repr(float(result.summary["loop_area"])), "N mm"])
        self.assertEqual(rows["status"][0], "completed")
        entries = json.loads((folder / "summary.json").read_text(), parse_constant=self.fail)
        self.assertEqual(entries["summary"]["loop_area"]["value"], result.summary["loop_area"])
        self.assertEqual(entries["parameters"]["Drive/Speed"]["value"], 112)
        unknown = [name for name, value in result.summary.items() if isinstance(value, float) and np.isnan(value)]
        self.assertTrue(all(rows[name][0] == "" and entries["summary"][name]["value"] is None for name in unknown))

    def test_study_has_words_for_words(self):
        _, folder = self.export("refused in part")
        header, first, last = read_rows(folder / "table.csv")
        self.assertEqual(header[0], "run [1]")
        self.assertEqual([row[header.index("friction_law")] for row in (first, last)], ["Coulomb", "table"])
        self.assertEqual(last[header.index("outcome")], "refused")
        self.assertIn("Friction/Table", last[header.index("reason")])

    def test_map_has_a_row_for_each_point(self):
        result, folder = self.export("map-friction-depth-a")
        points = result.groups["map"]
        header, *rows = read_rows(folder / "map.csv")
        self.assertEqual(header[:2], ["Friction/Coefficient [1]", "Lever/Depth [mm]"])
        np.testing.assert_array_equal(numbers(rows, 0), np.repeat(points["first"], len(points["second"])))
        np.testing.assert_array_equal(numbers(rows, header.index("growth_rate_forward [1/s]")), points["growth_rate_forward"].ravel())

    def test_modes_and_their_shapes(self):
        result, folder = self.export("stability-a")
        modes = result.groups["modes"]
        self.assertLessEqual({"modes.csv", "mode-shapes.csv", "critical_lever_depth.csv"}, set(self.names()))
        _, *rows = read_rows(folder / "modes.csv")
        np.testing.assert_array_equal(numbers(rows, 2), modes["growth_rate"])
        header, *rows = read_rows(folder / "mode-shapes.csv")
        first = [row for row in rows if row[0] == "1"]
        np.testing.assert_array_equal(numbers(first, header.index("across_real [mm]")), modes["across_real"][0])

    def test_refusals(self):
        self.expect_refusal(draw("export.py", run_once("closed-form-a"), "--only", "map"), "no map", "table, answer, summary")
        self.expect_refusal(draw("export.py", self.folder), "no result.h5")
