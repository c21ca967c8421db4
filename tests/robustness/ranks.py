"""Runs in three dimensions by several processes of MPI: the same results, written once; what they cannot help refuses them."""

import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, SPRAG, TIMEOUT, RunTest  # noqa: E402

MESH = {"Analysis/Dimension": "3", "Mesh/Face size": "3", "Mesh/Faces in contact": "0", "Mesh/Elements across": "3"}
SETTINGS = {**MESH, "Cylinder/Tilt": "1e-4", "Drive/Stroke": "15"}
PARTS = {"Friction plate/Type": "on sensors", "Friction plate/Sensors": "105, 195", "Rotational spring/Type": "leaf"}
HELD = {**MESH, "Analysis/Model": "condensed", "Condensed/Modes": "8", "Output/Fields": "none"}
ALONE = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def run(ranks, folder, changes):
    sets = [part for name, value in changes.items() for part in ("--set", f"{name}={value}")]
    mpi = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    command = [*mpi, SPRAG, SOURCE / "params" / "model-a.prm", "--output", folder, *sets]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=TIMEOUT, env=ALONE)


def fields_of(path):
    """Of one file, by group and name."""
    with h5py.File(path) as file:
        return {f"{group}/{name}": data[:] for group, of_group in file.items() for name, data in of_group.items()}


@unittest.skipUnless(shutil.which("mpirun"), "needs mpirun")
class Ranks(RunTest):
    def test_do_not_change_what_is_found(self):
        tables, fields = [], []
        for ranks in (1, 2):
            folder = self.folder / str(ranks)
            done = run(ranks, folder, SETTINGS)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("largest P"), 1, done.stdout)
            with h5py.File(folder / "result.h5") as file:
                tables.append({name: file["table"][name][:] for name in ("P", "Q", "theta", "centre_across")})
            fields.append({path.name: fields_of(path) for path in sorted(folder.glob("fields-*.h5"))})
            times = re.findall('Time Value="([^"]+)"', (folder / "fields.xdmf").read_text(encoding="utf-8"))
            fields[-1]["index"] = {"times": np.array(times, dtype=float)}
        for name, alone in tables[0].items():
            self.assertEqual(len(alone), len(tables[1][name]))
            apart = np.nanmax(np.abs(alone - tables[1][name])) / np.nanmax(np.abs(alone))
            self.assertLess(apart, 1e-8 if name != "centre_across" else 1e-5, name)
        self.assertEqual(list(fields[0]), list(fields[1]))
        self.assertGreater(len(fields[0]), 2)
        for name, alone in fields[0].items():
            self.assertEqual(list(alone), list(fields[1][name]))
            for data, values in alone.items():  # written in single precision
                np.testing.assert_allclose(fields[1][name][data], values, rtol=0, atol=2e-6 * np.abs(values).max(initial=0), err_msg=data)

    def test_do_not_change_slides_and_motions(self):
        tables = {
            "stability": ("modes", ("frequency", "growth_rate")),
            "modal": ("modes", ("frequency", "across_real", "sideways_real")),
            "transient": ("table", ("P", "Q", "theta", "sensor_1_left", "sensor_2_right")),
        }
        for analysis, (group, names) in tables.items():
            changes = {**HELD, "Analysis/Type": analysis}
            if analysis == "stability":
                changes.update({"Stability/Critical": "none", "Stability/Roles": "off"})
            elif analysis == "transient":
                changes.update({"Drive/Stroke": "6", "Drive/Start": "4", **PARTS})
            with self.subTest(analysis):
                alone, shared = (self.data_of(ranks, analysis, changes, group, names) for ranks in (1, 2))
                # In time round-off of the gap meets the contact's stiffness.
                tolerance = 1e-6 if analysis == "transient" else 1e-8
                for name, values in alone.items():
                    np.testing.assert_allclose(shared[name], values, rtol=0, atol=tolerance * np.nanmax(np.abs(values)), err_msg=name)

    def test_are_told_what_they_do(self):
        in_space = run(2, self.folder / "space", {**SETTINGS, "Drive/Stroke": "2"})
        self.assertEqual(in_space.stdout.count("Processes:    2, which share"), 1, in_space.stdout + in_space.stderr)
        chosen = {"Analysis/Dimension": "auto", "Accuracy/Quantity": "P", "Mesh/Face size": "3", "Mesh/Faces in contact": "0"}
        in_plane = run(2, self.folder / "plane", {**chosen, "Drive/Stroke": "15"})
        self.assertEqual(in_plane.returncode, 0, in_plane.stderr)
        self.assertIn("Processes:    2, of which a lever in a plane needs the first alone", in_plane.stdout)

    def data_of(self, ranks, analysis, changes, group, names):
        folder = self.folder / f"{analysis}-{ranks}"
        done = run(ranks, folder, changes)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(folder / "result.h5") as file:
            return {name: file[group][name][:] for name in names}

    def test_of_another_program_are_refused(self):
        program = Path(SPRAG).resolve().with_name("sprag-models")
        other = self.folder / "sprag-models"
        shutil.copy(program, other)
        with open(other, "ab") as file:
            file.write(b"another version")
        scene = SOURCE / "params" / "model-a.prm"
        sets = [part for name, value in SETTINGS.items() for part in ("--set", f"{name}={value}")]
        each = [scene, "--output", self.output, *sets]
        command = ["mpirun", "-n", "1", program, *each, ":", "-n", "1", other, *each]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=TIMEOUT, env=ALONE)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("process 1 of mpirun runs another program"), 1, done.stderr)
        self.assertFalse(self.output.exists())

    def test_that_cannot_help_are_refused(self):
        for changes, reason in (({}, "run in several processes"), ({**MESH, "Mesh/Face size": "8"}, "displacements are too few for 2")):
            done = run(2, self.output, changes)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count(reason), 1, done.stderr)
            self.assertEqual(done.stderr.count("leave out mpirun"), 1, done.stderr)
            self.assertFalse(self.output.exists())


if __name__ == "__main__":
    unittest.main()
