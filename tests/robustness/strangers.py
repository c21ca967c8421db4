# SPDX-License-Identifier: GPL-3.0-only
"""Files of strangers: what a mesh cannot do to whoever opens it, results and links in the folder that are not ours, inputs without an
end."""

import os
import shutil
import unittest

import h5py
import numpy as np

from runs import SOURCE, RunTest, sets, sprag
from strip import MESH_22, SCRIPT
from system_calls import CAN_FILTER, without_confinement, without_landlock

CALL = "SystemCall \"touch 'MARK'\";\n"
# The scripts that surround the mesh, with MARK for a file outside.
ACTS = {
    "starts a program": CALL + SCRIPT,
    "prints into a file": 'Printf("x") > "MARK";\n' + SCRIPT,
    "saves": SCRIPT + 'Mesh 2;\nSave "MARK.msh";\n',
    "adds to a file": 'Printf("x") >> "MARK";\n' + SCRIPT,
    "makes a folder": 'CreateDir "MARK";\n' + SCRIPT,
    "starts a solver": 'OnelabRun("x", "touch MARK");\n' + SCRIPT,
}
CLOSED_FORM = "subsection Analysis\n  set Model = closed form\nend\n"


class StrangerTest(RunTest):
    def scene(self, text=CLOSED_FORM):
        path = self.folder / "scene.prm"
        path.write_text(text)
        return path

    def run_scene(self, *options, **settings):
        return sprag(self.folder / "scene.prm", *options, "--output", self.output, **settings)


class Meshes(StrangerTest):
    def setUp(self):
        super().setUp()
        self.mark = self.folder / "mark"
        self.place = self.folder / "place"
        self.place.mkdir()

    def validate(self, name, *options, **settings):
        (self.place / "scene.prm").write_text(f"subsection Mesh\n  set File = {name}\nend\n")
        return sprag(self.place / "scene.prm", "--validate", "--quiet", *options, **settings)

    def write(self, name, text):
        (self.place / name).write_text(text.replace("MARK", str(self.mark)))

    def marks(self):
        return list(self.folder.glob("mark*"))

    def test_scripts_start_and_write_nothing(self):
        for what, text in ACTS.items():
            with self.subTest(what):
                self.write("own.geo", text)
                self.validate("own.geo")
                self.assertEqual(self.marks(), [])

    def test_scripts_change_no_file_of_their_folder(self):
        self.write("own.geo", SCRIPT + 'Printf("x") > "other.txt"; SystemCall "rm other.geo";\n')
        self.write("other.geo", "")
        self.validate("own.geo")
        self.assertEqual(sorted(path.name for path in self.place.iterdir()), ["other.geo", "own.geo", "scene.prm"])

    def test_scripts_read_their_folder_and_ours_alone(self):
        self.write("part.geo", SCRIPT)
        self.write("own.geo", 'Include "part.geo";\n')
        self.assertEqual(self.validate("own.geo").returncode, 0)
        (self.folder / "part.geo").write_text(SCRIPT)
        self.write("own.geo", 'Include "../part.geo";\n')
        self.assertEqual(self.validate("own.geo").returncode, 2)
        self.assertEqual(self.validate("own.geo", "--trust-scripts").returncode, 0)

    def test_what_a_script_tries_is_told(self):
        for text, says in (("Exit;", "gmsh ends on it"), (CALL, "--trust-scripts"), ('Merge "/etc/hostname";', "--trust-scripts")):
            self.write("own.geo", text)
            self.expect_refused(self.validate("own.geo"), "own.geo", says)

    def test_scripts_without_an_end_are_ended(self):
        self.write("own.geo", "For i In {1:1e9}\n  Sleep 0.01;\nEndFor\n")
        done = self.validate("own.geo", env={**os.environ, "SPRAG_SCRIPT_SECONDS": "1"}, timeout=60)
        self.expect_refused(done, "own.geo", "does not come to an end", "--trust-scripts")

    def test_a_mesh_is_no_script(self):
        self.write("own.msh", CALL + SCRIPT)
        self.expect_refused(self.validate("own.msh"), "own.msh", "must begin with $MeshFormat")
        self.assertEqual(self.marks(), [])

    def test_nothing_beside_a_mesh_counts(self):
        self.write("own.msh", MESH_22)
        self.write("own.msh.opt", CALL)
        self.silent(self.validate("own.msh"))
        self.assertEqual(self.marks(), [])

    def test_trusted_scripts_do_as_they_say(self):
        self.write("own.geo", ACTS["prints into a file"])
        self.assertEqual(self.validate("own.geo", "--trust-scripts").returncode, 0)
        self.assertEqual(self.marks(), [self.mark])

    @unittest.skipUnless(CAN_FILTER, "knows the system calls of x86_64")
    def test_scripts_are_refused_where_they_cannot_be_confined(self):
        self.write("own.geo", SCRIPT)
        for lacking in (without_confinement(), without_landlock()):
            self.expect_refused(self.validate("own.geo", preexec_fn=lacking), "own.geo", "is a script", "--trust-scripts")
        self.assertEqual(self.validate("own.geo", "--trust-scripts", preexec_fn=without_confinement()).returncode, 0)
        self.write("own.msh", MESH_22)
        self.assertEqual(self.validate("own.msh", preexec_fn=without_confinement()).returncode, 0)
        self.succeeded(sprag(SOURCE / "params" / "model-a.prm", "--validate", "--quiet", preexec_fn=without_confinement()))

    def test_no_temporary_file_is_made(self):
        for folder in ("/proc", ""):
            with self.subTest(TMPDIR=folder):
                self.write("own.geo", SCRIPT)
                self.silent(self.validate("own.geo", env={**os.environ, "TMPDIR": folder}))


class Results(StrangerTest):
    def setUp(self):
        super().setUp()
        self.scene()
        self.output.mkdir()
        self.result = self.output / "result.h5"

    def test_of_other_programs_stay(self):
        def measured():
            with h5py.File(self.result, "w") as file:
                file["measurement"], file["parameters"] = [1.0, 2.0], "mine"

        for make in (measured, lambda: self.result.write_text("a measurement\n")):
            shutil.rmtree(self.output)
            self.output.mkdir()
            make()
            before = self.result.read_bytes()
            self.expect_refused(self.run_scene(), "result.h5", "no result of sprag's", "--overwrite")
            self.assertEqual([path.name for path in self.output.iterdir()], ["result.h5"])
            self.assertEqual(self.result.read_bytes(), before)
            self.assertEqual(self.run_scene("--overwrite").returncode, 0)

    def test_links_are_not_followed(self):
        victim = self.folder / "victim"
        victim.write_text("mine")
        for name in ("run.log", "result.h5", "run.checkpoint.new", "map.journal", "fields.xdmf", "fields-mesh.h5"):
            with self.subTest(name):
                (self.output / name).symlink_to(victim)
                self.expect_refused(self.run_scene(), f"{name} is a link there")
                self.assertEqual(victim.read_text(), "mine")
                (self.output / name).unlink()

    def test_progress_of_another_analysis_is_none(self):
        self.output.mkdir(exist_ok=True)
        self.result.write_text("damaged")
        for name in ("map.journal", "study.journal", "run.checkpoint", "run.journal"):
            with self.subTest(name):
                (self.output / name).write_text("sprag 0 map, scene 0123456789abcdef\n")
                self.expect_refused(self.run_scene(), "result.h5", "--overwrite")
                (self.output / name).unlink()
        (self.output / "fields.xdmf").write_text("of an earlier lever")
        (self.output / "map.journal").write_text("sprag 0 map, scene 0123456789abcdef\n")
        self.assertEqual(self.run_scene("--overwrite").returncode, 0)
        self.assertFalse((self.output / "fields.xdmf").exists())

    def test_earlier_fields_go_with_their_result(self):
        coarse = sets(("Mesh/Face size=4", "Analysis/Step=5", "Drive/Stroke=20"))
        self.assertEqual(self.run_scene(*coarse, "--set", "Analysis/Model=finite element").returncode, 0)
        self.assertTrue((self.output / "fields.xdmf").exists())
        shutil.copytree(self.output, self.folder / "earlier")
        for changes in (("Analysis/Model=closed form",), ("Analysis/Model=finite element", "Output/Fields=none"), ("Analysis/Type=slope",)):
            with self.subTest(changes):
                shutil.rmtree(self.output)
                shutil.copytree(self.folder / "earlier", self.output)
                self.assertEqual(self.run_scene(*coarse, *sets(changes), "--overwrite").returncode, 0)
                self.assertEqual([path.name for path in self.output.glob("f*")], [])


class Caches(StrangerTest):
    def test_hold_files_of_others(self):
        """In a folder of bases that is somebody else's, only bases are counted and removed."""
        cache = self.folder / "cache"
        cache.mkdir()
        names = ("basis-notes.bin.txt", "basis-0123456789abcdef.bin.bak", "basis-0123456789abcdef.bin", "basis-1.bin.2", "notes.bin")
        for name in names:
            (cache / name).write_text("mine")
        (cache / "basis-fedcba9876543210.bin").symlink_to("notes.bin")
        for path in cache.iterdir():
            os.utime(path, (0, 0), follow_symlinks=False)
        with open(cache / "basis-0123456789abcdef.bin", "ab") as file:
            file.truncate(2 << 30)  # more than the bases may have
        before = {path.name: os.lstat(path).st_mtime for path in cache.iterdir()}
        self.scene("subsection Condensed\n  set Cache = cache\n  set Modes = 4\nend\nsubsection Mesh\n  set Face size = 6\nend\n")
        self.succeeded(self.run_scene("--set", "Analysis/Type=modal", "--set", "Analysis/Model=condensed", "--set", "Output/Fields=none"))
        after = {path.name: os.lstat(path).st_mtime for path in cache.iterdir()}
        self.assertEqual({name: after.get(name) for name in before}, before)
        self.assertEqual(len(after), len(before) + 1)


class Inputs(StrangerTest):
    def test_tables_lead_to_no_other_file(self):
        times = np.linspace(0, 1, 21)
        with h5py.File(self.folder / "other.h5", "w") as file:
            file["x"] = 20 * times
        (self.folder / "raw").write_bytes((20 * times).tobytes())

        def link(file):
            file["x"] = h5py.ExternalLink("other.h5", "/x")

        def storage(file):
            file.create_dataset("x", (21,), "f8", external=[(str(self.folder / "raw"), 0, 168)])

        def virtual(file):
            layout = h5py.VirtualLayout((21,), "f8")
            layout[:] = h5py.VirtualSource("other.h5", "x", (21,))
            file.create_virtual_dataset("x", layout)

        self.scene(CLOSED_FORM + "subsection Drive\n  set Profile = table\n  set Table = own.h5\nend\n")
        for make in (link, storage, virtual):
            with self.subTest(make.__name__):
                with h5py.File(self.folder / "own.h5", "w") as file:
                    file["time"] = times
                    make(file)
                self.expect_refused(self.run_scene(), "own.h5", "dataset 'x'")

    def test_units_of_datasets_count_or_are_refused(self):
        times = np.linspace(0, 1, 21)
        self.scene(CLOSED_FORM + "subsection Drive\n  set Profile = table\n  set Table = own.h5\nend\n")
        for attribute, unit, says in (("UNIT", "m", ""), ("Units", b"m", ""), ("unit", 5.0, "must be a text"), ("Unit", "N", "must be in mm")):
            with self.subTest(attribute=attribute, unit=unit):
                with h5py.File(self.folder / "own.h5", "w") as file:
                    file["time"], file["x"] = times, 0.02 * times
                    file["x"].attrs[attribute] = unit
                if says:
                    self.expect_refused(self.run_scene("--validate"), "own.h5", "'x'", says)
                else:
                    self.assertEqual(self.run_scene("--quiet", "--overwrite").returncode, 0)
                    with h5py.File(self.output / "result.h5") as file:
                        self.assertAlmostEqual(file["table/x"][-1], 20.0)

    def test_without_an_end(self):
        os.mkfifo(self.folder / "scene.prm")
        self.expect_refused(self.run_scene(), "scene.prm", "no pipe or device")
        (self.folder / "scene.prm").unlink()
        self.scene()
        os.mkfifo(self.folder / "pipe.msh")
        self.expect_refused(self.run_scene("--set", "Analysis/Model=finite element", "--set", "Mesh/File=pipe.msh"), "pipe.msh", "no pipe or device")
        os.mkfifo(self.folder / "pipe.csv")
        with open(self.folder / "huge.csv", "wb") as file:
            file.truncate(1 << 40)
        for table in ("pipe.csv", "/dev/zero", "huge.csv"):
            text = "1048576 MB: must have at most" if table == "huge.csv" else "no pipe or device"
            done = self.run_scene("--set", "Friction/Law=table", "--set", f"Friction/Table={table}")
            self.expect_refused(done, table, text)

    def test_that_cannot_be_read_to_the_end(self):
        self.expect_refused(sprag("/proc/self/mem", "--validate"), "/proc/self/mem: cannot be read: Input/output error")

    def test_messages_are_short_and_plain(self):
        self.scene("subsection Geometry\n  set Cylinder radius = \x1b]0;title\x07\x1b[31m\nend\n")
        self.expect_refused(self.run_scene(), "\\x1b]0;title\\x07")
        self.scene("subsection Geometry\n" + "  set Cylinder radius = 1\n" * 9999 + "end\n")
        done = self.run_scene()
        self.assertLess(len(done.stderr), 20000)
        self.assertIn("more", done.stderr.splitlines()[-1])
