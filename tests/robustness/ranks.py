# SPDX-License-Identifier: GPL-3.0-only
"""Runs in three dimensions by several processes of MPI: the same results, tables written once and fields together; what they cannot
help refuses them."""

import os
import re
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from runs import SOURCE, SPRAG, TIMEOUT, RunTest

MESH = {"Analysis/Dimension": "3", "Mesh/Face size": "3", "Mesh/Faces in contact": "0", "Mesh/Elements across": "3"}
SETTINGS = {**MESH, "Cylinder/Tilt": "1e-4", "Drive/Stroke": "5", "Analysis/Step": "2.5"}
PARTS = {"Friction plate/Type": "on sensors", "Friction plate/Sensors": "105, 195", "Rotational spring/Type": "leaf"}
HELD = {**MESH, "Analysis/Model": "condensed", "Condensed/Modes": "6", "Output/Fields": "none"}
ALONE = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
NUMBERS_IN_INDEX = re.compile('(?<=Time Value=")[^"]+|(?<=Format="XML">)[^<]+')


def command(folder, changes):
    sets = [part for name, value in changes.items() for part in ("--set", f"{name}={value}")]
    return list(map(str, [SPRAG, SOURCE / "params" / "model-a.prm", "--output", folder, *sets]))


def run(ranks, folder, changes):
    mpi = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    return finished([*mpi, *command(folder, changes)])


def finished(words, **options):
    return subprocess.run(words, capture_output=True, text=True, check=False, timeout=TIMEOUT, env=ALONE, **options)


def read_fields(folder):
    """All datasets of all files with fields, attributes with numbers, and the text that each has beside numbers."""
    found = {}
    for path in sorted(folder.glob("*.xdmf")):
        text = path.read_text(encoding="utf-8")
        found[path.name] = NUMBERS_IN_INDEX.sub("", text)
        found[f"{path.name} numbers"] = np.array(NUMBERS_IN_INDEX.findall(text), dtype=float)
    for path in sorted({*folder.glob("fields-*.h5"), *folder.glob("mode-*.h5")}):

        def note(name, entry, place=path.name):
            if isinstance(entry, h5py.Dataset):
                found[f"{place} {name}"] = entry[:]
                found[f"{place} {name} stored"] = f"{entry.dtype} {entry.chunks} {entry.compression}"
            for attribute, value in entry.attrs.items():
                found[f"{place} {name} {attribute}"] = value if isinstance(value, str) else np.array([value])

        with h5py.File(path) as file:
            note("", file)
            file.visititems(note)
    return found


@unittest.skipUnless(shutil.which("mpirun"), "needs mpirun")
class RanksTest(RunTest):
    def expect_alike(self, fields, alone):
        """But for round-off in single precision, and the sign that a mode happens to have."""
        self.assertEqual(list(fields), list(alone))
        for name, values in alone.items():
            if isinstance(values, str):
                self.assertEqual(fields[name], values, name)
                continue
            self.assertEqual(fields[name].shape, values.shape, name)
            apart, size = np.abs(fields[name].astype(float) - values), np.abs(values).max(initial=0)
            if name.startswith("mode-"):
                apart = np.minimum(apart, np.abs(fields[name].astype(float) + values))
                size = max(size, 10.5)  # its largest displacement [mm], whatever the phase of a frame
            self.assertLessEqual(apart.max(initial=0), 2e-6 * size, name)

    def expect_same_data(self, analysis, changes, group, names, tolerance):
        """Compares the results of one process and of two."""
        alone, shared = (self.read_data(ranks, {**HELD, "Analysis/Type": analysis, **changes}, group, names) for ranks in (1, 2))
        for name, values in alone.items():
            np.testing.assert_allclose(shared[name], values, rtol=0, atol=tolerance * np.nanmax(np.abs(values)), err_msg=name)

    def read_data(self, ranks, changes, group, names):
        folder = self.folder / f"{changes['Analysis/Type']}-{ranks}"
        self.succeeded(run(ranks, folder, changes))
        with h5py.File(folder / "result.h5") as file:
            return {name: file[group][name][:] for name in names}

    def ranks_apart(self, *places):
        """A study by two ranks, each with a working directory and an --output of its own."""
        changes = {"Analysis/Type": "study", "Study/Type": "stability", "Analysis/Model": "beam", "Stability/Roles": "off"}
        changes["Study/Vary"] = "Friction/Factor = 0.5 ... 1.5 : 200"
        words = []
        for place, output in places:
            (self.folder / place).mkdir(exist_ok=True)
            words += [":", "-n", "1", "-wdir", str(self.folder / place), *command(output, changes)]
        return finished(["mpirun", *words[1:]])


class Ranks(RanksTest):
    def test_do_not_change_motions(self):
        changes = {"Drive/Stroke": "4.5", "Drive/Start": "4", **PARTS}
        # The contact opens, and in time round-off of the gap meets its stiffness: friction factors that differ by 3e-12 to 2e-11 change P
        # by 2e-8 to 7e-7 of its peak.
        self.expect_same_data("transient", changes, "table", ("P", "Q", "theta", "sensor_1_left", "sensor_2_right"), 5e-6)

    def test_do_not_change_what_is_found(self):
        tables, fields = {}, {}
        for ranks in (1, 2):
            folder = self.folder / str(ranks)
            done = self.succeeded(run(ranks, folder, {**SETTINGS, "Mirrored pair/Type": "full"}))
            self.assertEqual(done.stdout.count("largest P"), 1, done.stdout)
            self.assertEqual(done.stdout.count("Processes:    2, which share"), ranks - 1, done.stdout)
            with h5py.File(folder / "result.h5") as file:
                tables[ranks] = {name: file["table"][name][:] for name in ("P", "Q", "theta", "P_2", "centre_across", "centre_across_2")}
            fields[ranks] = read_fields(folder)
        # More rows than one process writes together, see hdf5::rows_together.
        self.assertGreater(len(fields[1]["fields-0000.h5 fields/von_mises_stress"]), 8192)
        self.assertGreater(len(fields[1]["fields.xdmf numbers"]), 2)
        # Without the elastic part a face stays a plane.
        frame = {name: fields[1][f"fields-0000.h5 face/{name}"] for name in ("displacement", "elastic_displacement")}
        mesh = {name: fields[1][f"fields-mesh.h5 face/{name}"] for name in ("nodes", "lever")}
        turned = (mesh["nodes"] + frame["displacement"] - frame["elastic_displacement"])[mesh["lever"] == 1]
        apart = np.linalg.svd(turned - turned.mean(axis=0), compute_uv=False)[2] / np.sqrt(len(turned))
        self.assertLess(apart, 1e-5)
        for name, alone in tables[1].items():
            self.assertEqual(len(alone), len(tables[2][name]))
            apart = np.nanmax(np.abs(alone - tables[2][name])) / np.nanmax(np.abs(alone))
            self.assertLess(apart, 1e-5 if name.startswith("centre_across") else 1e-8, name)
        self.expect_alike(fields[2], fields[1])

    def test_of_another_output_are_refused(self):
        done = self.ranks_apart(("here", "one"), ("here", "two"))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("or to another --output"), 1, done.stderr)
        self.assertEqual(list((self.folder / "here").iterdir()), [])

    def test_that_cannot_help_are_refused(self):
        for changes, reason in (({}, "run in several processes"), ({**MESH, "Mesh/Face size": "8"}, "displacements are too few for 2")):
            done = run(2, self.output, changes)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count(reason), 1, done.stderr)
            self.assertEqual(done.stderr.count("leave out mpirun"), 1, done.stderr)
            self.assertFalse(self.output.exists())
