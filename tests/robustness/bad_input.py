# SPDX-License-Identifier: GPL-3.0-only
"""The program from outside: what it refuses, what a failed or killed run leaves behind, its options."""

import shutil
import signal
import subprocess
from pathlib import Path

import h5py
import numpy as np

from runs import RunTest, sets, sprag

CLOSED_FORM = "subsection Analysis\n  set Model = closed form\nend\n"
COARSE = sets(("Mesh/Face size=4", "Analysis/Step=5"))

# A strip of 210 x 20 mm whose lower side is the friction face of model A.
STRIP = """
Point(1) = {0, 45.6, 0};
line[] = Extrude {210, 0, 0} { Point{1}; Layers{52}; };
area[] = Extrude {0, 20, 0} { Curve{line[1]}; Layers{4}; Recombine; };
"""
LEVER = 'Physical Surface("lever") = {area[1]};\n'
HUB = 'Physical Curve("hub") = {Abs(area[3])};\n'
FACE = 'Physical Curve("friction face") = {line[1]};\n'


def tree(folder):
    """Path -> content of everything below a folder."""
    return {path: path.read_bytes() if path.is_file() else None for path in sorted(folder.rglob("*"))}


class ProgramTest(RunTest):
    def write(self, text, name="scene.prm"):
        path = self.folder / name
        path.write_text(text)
        return path

    def refused(self, scene, *options, says, mistakes=None, older=False):
        """Exit 2, every text of `says` on stderr, no folder made; with `older` nothing written into a folder of results."""
        if older:
            options = (*options, "--overwrite")
            self.output.mkdir()
            (self.output / "result.h5").write_bytes(b"an older result")
            (self.output / "fields-0000.h5").write_bytes(b"an older field")
        before = tree(self.folder)
        done = sprag(scene, *options, "--output", self.output, cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        for text in says:
            self.assertIn(text, done.stderr)
        if mistakes is not None:
            self.assertEqual(len(done.stderr.splitlines()), mistakes, done.stderr)
        self.assertEqual(tree(self.folder), before)
        return done.stderr.splitlines()


class BadScene(ProgramTest):
    """Mistakes that reading the scene finds."""

    def test_a_new_scene_runs_and_replaces_nothing(self):
        new, copy = self.folder / "press.prm", self.folder / "copy.prm"
        self.assertEqual(sprag("--new", new).returncode, 0)
        checked = sprag(new, "--validate")
        self.assertTrue(checked.stdout.endswith("valid, no warnings\n"), checked.stdout + checked.stderr)
        self.assertEqual(sprag("--new", copy, "--from", "model-a").returncode, 0)
        self.assertIn("Model A", copy.read_text().splitlines()[0])
        before = tree(self.folder)
        elsewhere = self.folder / "b.prm"
        refused = (
            (("--new", new), "exists; no file is replaced, name another"),
            (("--new", elsewhere, "--overwrite"), f"--from alone, not with --overwrite: type 'sprag --new {elsewhere}' and then 'sprag {elsewhere}' with"),
            (("--new", elsewhere, "model-a"), "--from alone, not with FILE.prm"),
            (("--new", elsewhere, "--from", "modl-a"), "did you mean 'model-a'?"),
            ((elsewhere, "--out", "folder"), "--out: there is no such option; did you mean '--output'?"),
            ((elsewhere, "--overwrit"), "did you mean '--overwrite'?"),
            (("--new", elsewhere, "--from", "params/model-a.prm"), "no such scene; did you mean 'model-a'?"),
            (("--new", elsewhere, "--from", "../params/model-a"), "no such scene; did you mean 'model-a'?"),
            (("--new", elsewhere, "--from", "solid-rib-a"), "reads files"),
            (("--new", elsewhere, "--from", "identification-a"), "reads files"),
        )
        for words, says in refused:
            done = sprag(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, done.stderr)
        self.assertEqual(tree(self.folder), before)

    def table(self, text, section="Friction", choice="Law", header=""):
        self.write(header + text, "own.csv")
        return self.write(f"subsection {section}\n  set {choice} = table\n  set Table = own.csv\nend\n")

    def test_exchanged_columns(self):
        rows = "0.3,0\n0.4,20\n0.5,60\n0.6,120\n"
        self.refused(self.table(rows), says=["row 4: coefficient 120", "exchanged"], mistakes=1)
        self.refused(self.table("0.3,0\n0.4,1\n0.5,2\n0.6,3\n"), says=["coefficient 3", "exchanged"], mistakes=1)
        fine = "0,0.3\n1,0.4\n2,0.5\n3,0.6\n"
        for header in ("mu,v [mm/s]\n", "friction coefficient;speed\n", "mu speed\n"):
            with self.subTest(header=header):
                self.refused(self.table(fine, header=header), says=["coefficient 3", "exchanged"], mistakes=1)
                self.silent(sprag(self.table(rows, header=header), "--validate", "--quiet"))
        self.silent(sprag(self.table(fine, header="friction speed [mm/s], mu [-]\n"), "--validate", "--quiet"))
        drive = self.table("0,0\n1,0.1\n1,0.2\n3,0.3\n", "Drive", "Profile", header="displacement [mm]; t [m]\n")
        self.refused(drive, says=["column 't'", "must be in s", "'m' has the dimension m"], mistakes=1)


class BadMesh(ProgramTest):
    """Mistakes that show when the mesh is made."""

    def geometry(self, text):
        self.write(text, "own.geo")
        return self.write("subsection Mesh\n  set File = own.geo\nend\n")

    def test_curves_with_a_name_of_their_own_may_overlap(self):
        names = 'Physical Curve("measured") = {line[1], area[2]};\n'
        self.silent(sprag(self.geometry(STRIP + LEVER + HUB + FACE + names), "--validate"))

    def test_elements_without_a_group(self):
        more = "other[] = Extrude {0, 5, 0} { Curve{area[0]}; Layers{2}; Recombine; };\n"
        scene = self.geometry(STRIP + more + LEVER + HUB + FACE)
        self.refused(scene, says=["own.geo: ", "elements are in no physical surface"], mistakes=1, older=True)

    def test_volumes(self):
        solid = STRIP + "solid[] = Extrude {0, 0, 40} { Surface{area[1]}; Layers{4}; Recombine; };\n" + LEVER + HUB + FACE
        self.refused(self.geometry(solid), says=["own.geo", "has volumes", "Lever/Width"], mistakes=1)

    def test_out_of_its_plane(self):
        tilted = STRIP.replace("{0, 20, 0}", "{0, 20, 5}") + LEVER + HUB + FACE
        self.refused(self.geometry(tilted), says=["own.geo", "z = 5 mm", "must be 0"], mistakes=1)


class BadOutput(ProgramTest):
    """A folder that cannot be made or written to. Root may write anywhere, so these are places where nobody can."""

    def test_is_refused(self):
        scene, file = self.write(CLOSED_FORM), self.write("text", "file")
        (self.folder / "a/result.h5").mkdir(parents=True)
        before = tree(self.folder)
        for output in (file / "output", file, "/proc/sprag", "/proc", self.folder / "a"):
            for model in ("closed form", "finite element"):
                with self.subTest(output=output, model=model):
                    done = sprag(scene, *COARSE, "--set", f"Analysis/Model={model}", "--output", output)
                    self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                    self.assertIn(str(output), done.stderr)
                    self.assertEqual(tree(self.folder), before)


class FailedRun(ProgramTest):
    """Exit 1, and every finished step can be read."""

    def finished_steps(self):
        with h5py.File(self.output / "result.h5", "r") as file:
            table = {name: data[:] for name, data in file["table"].items()}
            status = file["summary/status"].asstr()[()]
            self.assertIn("version", file["meta"])
            self.assertEqual(len(file["face/pressure"]), len(table["x"]))
        self.assertEqual({len(values) for values in table.values()}, {len(table["x"])})
        for name in ("x", "P", "F", "Q", "theta"):
            self.assertTrue(np.isfinite(table[name]).all(), name)
        return table, status

    def test_flexible_run_that_locks(self):
        scene = self.write("")
        changes = ("--set", "Friction/Law=Coulomb", "--set", "Friction/Coefficient=3")
        done = sprag(scene, *COARSE, *changes, "--output", self.output)
        self.assertEqual(done.returncode, 1, done.stderr)
        table, status = self.finished_steps()
        last = table["x"][-1]
        self.assertEqual(table["x"].max(), 65)
        self.assertTrue(55 < last < 65, last)
        self.assertTrue((table["P"] >= 0).all())
        self.assertIn(f"x = {last:.6g} mm", done.stderr)
        self.assertIn("locks", done.stderr)
        self.assertIn(f"x = {last:.6g} mm", status)

    def test_solid_layer_crushed_at_first(self):
        scene = self.write("")
        soft = ("Analysis/Dimension=3", "Mesh/Elements across=2", "Mesh/Face size=4", "Drive/Start=40", "Friction layer/Young's modulus=0.005")
        done = sprag(scene, *sets(soft), "--output", self.output, "--quiet")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("half of Young's modulus there", done.stderr)
        self.assertIn("half of Young's modulus there", self.read("summary", "status")["status"])


class RunGoingOn(ProgramTest):
    """The result file while its run goes on and after the run was killed."""

    def test_reading_along_and_killed(self):
        long = ("--set", "Mesh/Face size=4", "--set", "Analysis/Step=0.005", "--set", "Output/Fields=none")
        process = self.start(self.write(""), *long, "--output", self.output, "--quiet")
        first = self.wait_for_rows(process, 3)
        second = self.wait_for_rows(process, len(first) + 50)
        self.assertTrue((second[: len(first)] == first).all())
        process.send_signal(signal.SIGKILL)
        process.wait()

        path = self.output / "result.h5"
        left = self.rows()
        self.assertGreaterEqual(len(left), len(second))
        self.assertTrue((left[: len(second)] == second).all())
        self.assertTrue((np.diff(left) > 0).all())

        # Without swmr the file opens once the mark of its writer is taken off.
        h5clear = shutil.which("h5clear")
        if h5clear:
            subprocess.run([h5clear, "-s", path], check=True, capture_output=True)
            with h5py.File(path, "r") as file:
                self.assertGreaterEqual(len(file["table/x"]), len(left))
                self.assertIn("subsection Drive", file["parameters"].asstr()[()])


class Options(ProgramTest):
    def test_help_and_version(self):
        done = self.silent(sprag("--help"))
        for option in ("FILE.prm", "--set", "--output", "--validate", "--print-parameters", "--quiet", "--version"):
            self.assertIn(option, done.stdout)
        one = sprag("--help", "lever/depth").stdout
        self.assertRegex(one, r"subsection Lever\n(?:  # .*\n)+  set Depth = 20\nend\n")
        self.assertIn(one.partition("set Depth")[0].partition("subsection Lever\n")[2], sprag("Lever", "--help").stdout)
        self.assertEqual(sprag("--help", "depth").stdout, one)
        self.complains(["--help", "Lever/Dept"], "--help Lever/Dept: there is no such section, parameter, result or warning; did you mean 'Lever/Depth'?")
        entry = sprag("--help", "peak_P_backward").stdout
        self.assertTrue(entry.startswith("/summary/peak_P_backward [N]\n"), entry)
        self.assertIn("  meaning: largest normal force while moving backward", entry)
        self.assertIn("  printed: largest P: backward #, a headline\n", entry)
        self.assertIn("column Q [N]\n", sprag("--help", "Q").stdout)
        self.assertIn("remedy: ", sprag("--help", "near_locking").stdout)
        self.complains(["--help", "lop_area"], "did you mean 'loop_area'?")
        done = self.silent(sprag("--version"))
        self.assertRegex(done.stdout, r"^sprag \d+\.\d+")

    def test_names_of_files_and_options(self):
        scene, other, binary = (self.write(CLOSED_FORM, name) for name in ("scene.prm", "other.prm", "binary.prm"))
        binary.write_bytes(bytes(range(256)))
        cases = (
            ([], "FILE.prm"), ([scene, "--set"], "--set"), ([scene, other], "other.prm"), ([scene, "--outputs", self.output], "--outputs"),
            ([scene, "--quiet", "--verbose"], "--verbose"), ([self.folder / "missing.prm"], "missing.prm: cannot be read"), ([self.folder], "is a folder"), ([binary], "binary.prm"),
        )  # fmt: skip
        for arguments, text in cases:
            with self.subTest(text):
                self.complains(arguments, text)

    def complains(self, arguments, text):
        before = tree(self.folder)
        done = sprag(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertIn(text, done.stderr)
        self.assertEqual(tree(self.folder), before)

    def test_defaults_are_input_and_validating_writes_nothing(self):
        defaults = sprag("--print-parameters")
        self.assertEqual((defaults.returncode, defaults.stderr), (0, ""))
        self.assertIn("56", defaults.stdout)
        scene = self.write(defaults.stdout)
        before = tree(self.folder)
        done = self.silent(sprag(scene, "--validate", "--output", self.output, cwd=self.folder))
        self.assertIn("scene.prm", done.stdout)
        self.assertEqual(tree(self.folder), before)

    def test_printed_parameters_are_input(self):
        table = self.write("0,0\n1,1\n2,2\n3,1\n", "table.csv")
        scene = self.write("subsection Drive\n  set Profile = table\n  set Table = table.csv\nend\n" + CLOSED_FORM)
        printed = sprag(scene, "--set", "Geometry/Cylinder radius=55.5", "--print-parameters", "--output", self.output)
        self.assertEqual((printed.returncode, printed.stderr), (0, ""))
        self.assertIn("55.5", printed.stdout)
        self.assertIn(str(table), printed.stdout)
        self.assertFalse(self.output.exists())
        (self.folder / "elsewhere").mkdir()
        copy = self.write(printed.stdout, "elsewhere/copy.prm")
        done = sprag(copy, "--output", self.output, "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        with h5py.File(self.output / "result.h5", "r") as file:
            self.assertEqual(file["parameters"].asstr()[()], printed.stdout.replace("given as table.csv; ", ""))

    def test_a_lever_that_ends_stops_the_table_and_keeps_its_rows(self):
        done = sprag(
            self.write("subsection Analysis\n  set Type = isolation\n  set Model = closed form\nend\n"),
            *("--set", "Isolation/Base amplitude=100", "--set", "Isolation/Base frequency=0.75", "--output", self.output),
        )
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("the cylinder reaches the lever's pivot", done.stderr)
        self.assertIn("Try", done.stderr)
        z, summary = self.read("table", "z")["z"], self.read("summary")
        self.assertGreater(len(z), 20)
        self.assertGreater(np.abs(z).max(), 100)
        self.assertIn("pivot", summary["status"])
        self.assertGreater(summary["turns"], 0)

    def test_default_output_folder(self):
        done = self.succeeded(sprag(self.write(CLOSED_FORM, "first try.prm"), cwd=self.folder))
        self.assertTrue((self.folder / "output" / "first try" / "result.h5").is_file())
        self.assertIn("largest P", done.stdout)
